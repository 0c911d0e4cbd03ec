#include "deform_node/local_publisher.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace omentum::deform {

namespace {

bool offers_local_models(const ServedOrgan& served) {
  return served.model->sizes().local_nodes > 0;
}

}  // namespace

bool offers_local_models(const std::vector<ServedOrgan>& organs) {
  return std::any_of(organs.begin(), organs.end(),
                     [](const ServedOrgan& served) { return offers_local_models(served); });
}

LocalPublisher::LocalPublisher(transport::Writer<msg::LocalModel>& writer,
                               const std::vector<ServedOrgan>& organs, std::size_t most_nodes,
                               const runtime::StartWork& start)
    : writer_(writer), organs_(organs), offered_(organs.size()) {
  for (std::size_t i = 0; i < organs.size(); ++i) {
    if (!offers_local_models(organs[i])) continue;
    StampedPatch room{.organ = static_cast<std::uint32_t>(i), .echoes = {}, .patch = {}};
    const std::size_t nodes = organs[i].model->sizes().local_nodes;
    if (nodes > most_nodes)
      throw std::runtime_error("organ " + organs[i].source->organ.name +
                               ": its model offers local models of " + std::to_string(nodes) +
                               " nodes, expected at most " + std::to_string(most_nodes) + " on this profile");
    room.patch = LocalPatch(nodes);
    for (room.tool = 0; room.tool < msg::MAX_TOOLS; ++room.tool)
      offered_[i].boxes.push_back(std::make_unique<Box>(room));
    offered_[i].begun_anew = organs[i].begun_anew;
  }
  writing_ = start([this] { write_newest(); });
}

void LocalPublisher::offer(std::span<const ToolPlace> tools, std::span<const msg::Echo> echoes,
                           std::int64_t now_ns) noexcept {
  bool any = false;
  for (std::size_t i = 0; i < organs_.size(); ++i)
    if (!offered_[i].boxes.empty())
      for (const ToolPlace& tool : tools) any |= offer(i, tool, echoes, now_ns);
  if (any) writing_->wake();
}

bool LocalPublisher::is_felt(std::size_t organ, std::int64_t now_ns) noexcept {
  OfOrgan& offered = offered_[organ];
  if (std::exchange(offered.begun_anew, organs_[organ].begun_anew) != organs_[organ].begun_anew)
    offered.felt_from_ns = now_ns + static_cast<std::int64_t>(1e9 * kUnfelt_s);
  return now_ns >= offered.felt_from_ns;
}

bool LocalPublisher::fill(std::size_t organ, const ToolPlace& tool, std::int64_t now_ns,
                          LocalPatch& patch) noexcept {
  const OrganModel& model = *organs_[organ].model;
  if (is_felt(organ, now_ns)) return model.local_model(tool.around, patch);
  patch.topology_version = model.view().topology_version;
  patch.node_count = patch.triangle_count = 0;
  return true;
}

bool LocalPublisher::offer(std::size_t organ, const ToolPlace& tool, std::span<const msg::Echo> echoes,
                           std::int64_t now_ns) noexcept {
  Box& box = *offered_[organ].boxes[tool.tool];
  StampedPatch& draft = box.newest.draft();
  if (!fill(organ, tool, now_ns, draft.patch)) return false;
  draft.seq = ++box.seq;
  draft.stamp_ns = now_ns;
  draft.echoes.take(echoes);
  box.newest.post();
  return true;
}

void LocalPublisher::write_newest() {
  for (const OfOrgan& of_organ : offered_)
    for (const auto& box : of_organ.boxes) {
      if (!box->newest.fetch()) continue;
      fill_local_model(box->newest.value(), message_);
      writer_.write(message_);
    }
}

}  // namespace omentum::deform
