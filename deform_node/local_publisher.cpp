#include "deform_node/local_publisher.h"

#include <algorithm>

namespace omentum::deform {

namespace {

bool offers_local_models(const ServedOrgan& served) {
  return served.model->sizes().local_nodes > 0;
}

// The middle of the nodes that a tool presses, where they are now.
Vec3 middle_of(const ToolLoad& load, const std::vector<Vec3>& rest) noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < load.nodes.size(); ++i) sum += rest[load.nodes[i]] + load.displacements[i];
  return sum / static_cast<double>(load.nodes.size());
}

}  // namespace

bool offers_local_models(const std::vector<ServedOrgan>& organs) {
  return std::any_of(organs.begin(), organs.end(),
                     [](const ServedOrgan& served) { return offers_local_models(served); });
}

LocalPublisher::LocalPublisher(transport::Writer<msg::LocalModel>& writer,
                               const std::vector<ServedOrgan>& organs)
    : writer_(writer), organs_(organs), boxes_(organs.size()), thread_([this] { write_newest(); }) {
  for (std::size_t i = 0; i < organs.size(); ++i) {
    if (!offers_local_models(organs[i])) continue;
    StampedPatch room{.organ = static_cast<std::uint32_t>(i), .echoes = {}, .patch = {}};
    room.patch = LocalPatch(organs[i].model->sizes().local_nodes);
    for (room.tool = 0; room.tool < kMaxTools; ++room.tool) boxes_[i].push_back(std::make_unique<Box>(room));
  }
}

void LocalPublisher::offer(ContactBook& book, std::int64_t now_ns) noexcept {
  bool any = false;
  for (std::size_t i = 0; i < organs_.size(); ++i) {
    if (boxes_[i].empty()) continue;
    for (const ToolLoad& load : book.loads(static_cast<std::uint32_t>(i)))
      any |= offer(i, load, book, now_ns);
  }
  if (any) thread_.wake();
}

bool LocalPublisher::offer(std::size_t organ, const ToolLoad& load, ContactBook& book,
                           std::int64_t now_ns) noexcept {
  Box& box = *boxes_[organ][load.tool];
  StampedPatch& draft = box.newest.draft();
  const PatchPlace place{middle_of(load, organs_[organ].source->rest), kPatchRadiusM};
  if (!organs_[organ].model->local_model(place, draft.patch)) return false;
  draft.seq = ++box.seq;
  draft.stamp_ns = now_ns;
  draft.echoes.take(book.echoes());
  box.newest.post();
  return true;
}

void LocalPublisher::write_newest() {
  for (const auto& of_organ : boxes_)
    for (const auto& box : of_organ) {
      if (!box->newest.fetch()) continue;
      fill_local_model(box->newest.value(), message_);
      writer_.write(message_);
    }
}

}  // namespace omentum::deform
