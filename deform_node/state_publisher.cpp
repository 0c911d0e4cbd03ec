#include "deform_node/state_publisher.h"

#include "node_common/node_identity.h"

#include <utility>

namespace omentum::deform {

namespace {

TickSnapshot room_for(const std::vector<ServedOrgan>& organs) {
  TickSnapshot tick;
  for (const ServedOrgan& served : organs) tick.organs.emplace_back(served.model->sizes());
  return tick;
}

std::vector<OrganMessages> messages_of(const std::vector<ServedOrgan>& organs, std::int32_t nodes_per_block) {
  std::vector<OrganMessages> messages;
  for (std::size_t i = 0; i < organs.size(); ++i)
    messages.emplace_back(static_cast<std::uint32_t>(i),
                          static_cast<std::uint32_t>(organs[i].source->organ.mesh.tetrahedra.size()),
                          nodes_per_block);
  return messages;
}

}  // namespace

StatePublisher::StatePublisher(const StateWriters& writers, const std::vector<ServedOrgan>& organs,
                               std::int32_t nodes_per_block, msg::SceneInfo info,
                               msg::NodeStatus introduction, const runtime::FaultList& faults,
                               const runtime::StartWork& start)
    : writers_(writers),
      faults_(faults),
      newest_(room_for(organs)),
      messages_(messages_of(organs, nodes_per_block)),
      info_(std::move(info)),
      status_(std::move(introduction)),
      writing_(start([this] { write_newest(); })) {}

void StatePublisher::publish() noexcept {
  newest_.post();
  writing_->wake();
}

void StatePublisher::write_newest() {
  if (!newest_.fetch()) return;
  const TickSnapshot& tick = newest_.value();
  if (writers_.journal != nullptr) writers_.journal->keep(tick.organs);
  if (!scene_told_) scene_told_ = writers_.scene.write(info_);
  for (std::size_t i = 0; i < messages_.size(); ++i) write_organ(messages_[i], tick, tick.organs[i]);
  if (tick.figures.number != status_told_) write_status(tick);
}

void StatePublisher::write_organ(OrganMessages& messages, const TickSnapshot& tick,
                                 const OrganSnapshot& snapshot) {
  if (const msg::Topology* topology = messages.unsettled_topology(snapshot)) {
    if (!writers_.topology.write(*topology)) return;
    messages.settle_topology();
  }
  for (const msg::OrganState& block : messages.blocks_of(tick)) writers_.state.write(block);
}

void StatePublisher::write_status(const TickSnapshot& tick) {
  const LoopFigures& figures = tick.figures;
  status_told_ = figures.number;
  status_.paused = figures.paused;
  status_.newest_order = figures.newest_order;
  status_.ticks = figures.ticks;
  status_.missed = figures.missed;
  status_.period_us = figures.period_us;
  status_.compute_us = figures.compute_us;
  status_.real_time_factor = figures.real_time_factor;
  status_.echoes.assign(tick.echoes.all().begin(), tick.echoes.all().end());
  node::fill_faults(faults_, status_);
  writers_.status.write(status_);
}

}  // namespace omentum::deform
