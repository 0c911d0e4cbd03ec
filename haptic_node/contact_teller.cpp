#include "haptic_node/contact_teller.h"

namespace omentum::haptic {
namespace {

// For picture and organ, which are slower; changes are told at once.
constexpr std::int64_t kPeriod_ns = 4'000'000;

// An organ that a tool has left is told so for this long: deform_node lets a contact of which nothing came
// for 0.1 s fade by itself.
constexpr std::int64_t kTellOfNone_ns = 200'000'000;

}  // namespace

ContactTeller::ContactTeller(const HapticModel& model, std::span<const std::uint32_t> tool_ids,
                             const HapticState& state, Bodies& bodies)
    : model_(model), organs_(model.organs.size()), state_(state), bodies_(bodies), grasped_(tool_ids.size()) {
  for (std::size_t t = 0; t < tool_ids.size(); ++t) {
    edges_.emplace_back(model.tools[t].edge);
    for (std::size_t organ = 0; organ < organs_; ++organ)
      contacts_.push_back({make_contact_message(tool_ids[t], static_cast<std::uint32_t>(organ))});
  }
}

void ContactTeller::tell(std::uint64_t tick, std::int64_t now_ns, std::span<const ToolNews> news,
                         std::span<const ToolOutput> outputs,
                         transport::Writer<msg::Contact>& writer) noexcept {
  if (!look(news, outputs) && now_ns < due_ns_) return;
  due_ns_ = now_ns + kPeriod_ns;
  for (std::size_t t = 0; t < news.size(); ++t) {
    for (std::size_t organ = 0; organ < organs_; ++organ) {
      TouchedOrgan& touched = contacts_[t * organs_ + organ];
      if (!is_due(touched, organ == 0, now_ns) || !news[t].served) continue;
      msg::Contact& contact = touched.message;
      ++contact.seq;
      contact.tick = tick;
      contact.cause = news[t].cause;
      fill_contact_message(static_cast<std::int32_t>(t), outputs[t], state_, bodies_, contact);
      edges_[t].fill(contact);
      writer.write(contact);
    }
    edges_[t].told();
    grasped_[t] = outputs[t].grasping;
  }
}

// Whether something began or ended.
bool ContactTeller::look(std::span<const ToolNews> news, std::span<const ToolOutput> outputs) noexcept {
  bool changed = false;
  for (std::size_t t = 0; t < news.size(); ++t) {
    const auto& trocar = model_.tools[t].trocar;
    const ToolFrame& measured = news[t].measured;
    edges_[t].follow(trocar ? through_trocar(measured, *trocar) : measured, state_.tools[t].engaged,
                     news[t].pressed);
    changed |= edges_[t].changed() || grasped_[t] != outputs[t].grasping;
    for (std::size_t organ = 0; organ < organs_; ++organ) {
      TouchedOrgan& touched = contacts_[t * organs_ + organ];
      touched.now =
          edges_[t].cuts() || touches(static_cast<std::int32_t>(t), touched.message.organ, state_, bodies_);
      changed |= touched.now != touched.told;
    }
  }
  return changed;
}

// The first organ hears of every tool, touched or not; the others while they are, and then for so long that
// they cannot miss that it ended.
bool ContactTeller::is_due(TouchedOrgan& touched, bool always, std::int64_t now_ns) noexcept {
  touched.told = touched.now;
  if (touched.now) touched.told_until_ns = now_ns + kTellOfNone_ns;
  return always || now_ns < touched.told_until_ns;
}

}  // namespace omentum::haptic
