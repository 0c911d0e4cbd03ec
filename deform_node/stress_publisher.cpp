#include "deform_node/stress_publisher.h"

#include "deform_node/state_blocks.h"

#include <algorithm>
#include <cmath>

namespace omentum::deform {

namespace {

constexpr double kQuestionRate_hz = 10;  // a person who switches a map on does not see a tenth of a second

void fill_block(std::span<const float> from, const StateBlock& place, std::vector<float>& to) {
  if (from.empty()) return to.clear();
  const auto part =
      from.subspan(static_cast<std::size_t>(place.first), static_cast<std::size_t>(place.count));
  to.assign(part.begin(), part.end());
}

}  // namespace

StressPublisher::Organ::Organ(std::uint32_t organ, std::unique_ptr<StrainGauge> of_organ,
                              const ModelSizes& sizes)
    : index(organ),
      gauge(std::move(of_organ)),
      newest({.state = {}, .shape = StrainedShape(sizes)}),
      strain(sizes.values / 3),
      stress_pa(sizes.values / 3) {}

StressPublisher::StressPublisher(transport::Writer<msg::OrganStress>& writer,
                                 const std::vector<ServedOrgan>& organs, std::int32_t nodes_per_block,
                                 double rate_hz, const runtime::StartWork& start)
    : writer_(writer),
      served_(organs),
      nodes_per_block_(nodes_per_block),
      ticks_per_question_(std::max<std::uint64_t>(1, std::lround(rate_hz / kQuestionRate_hz))) {
  for (std::size_t i = 0; i < organs.size(); ++i) {
    std::unique_ptr<StrainGauge> gauge = organs[i].model->strain_gauge();
    if (!gauge) continue;
    organs_.push_back(
        std::make_unique<Organ>(static_cast<std::uint32_t>(i), std::move(gauge), organs[i].model->sizes()));
  }
  writing_ = start([this] { write_newest(); });
}

void StressPublisher::offer(const StateMark& state) noexcept {
  const bool is_read = is_read_.load(std::memory_order_relaxed);
  if (is_read) {
    for (const auto& organ : organs_) {
      Offered& draft = organ->newest.draft();
      draft.state = state;
      draft.shape.take(served_[organ->index].model->view());
      organ->newest.post();
    }
  }
  if (is_read || ticks_ % ticks_per_question_ == 0) writing_->wake();
  ++ticks_;
}

void StressPublisher::write_newest() {
  const bool is_read = writer_.status().matched > 0;
  is_read_.store(is_read, std::memory_order_relaxed);
  for (const auto& organ : organs_)
    if (organ->newest.fetch() && is_read) measure(*organ);
}

void StressPublisher::measure(Organ& organ) {
  const Offered& offered = organ.newest.value();
  const std::size_t count = offered.shape.node_count();
  const std::span<float> strain = std::span(organ.strain).first(count);
  const std::span<float> stress_pa =
      std::span(organ.stress_pa).first(organ.gauge->knows_stress() ? count : 0);
  organ.gauge->measure(offered.shape, strain, stress_pa);
  measured_.fetch_add(1, std::memory_order_relaxed);
  write(offered, strain, stress_pa, organ);
}

void StressPublisher::write(const Offered& offered, std::span<const float> strain,
                            std::span<const float> stress_pa, Organ& organ) {
  const auto count = static_cast<std::int32_t>(strain.size());
  const std::vector<StateBlock> places = split_state(count, nodes_per_block_);
  organ.blocks.resize(places.size());
  for (std::size_t b = 0; b < places.size(); ++b) {
    msg::OrganStress& block = organ.blocks[b];
    block.organ = organ.index;
    block.block = static_cast<std::uint32_t>(b);
    block.block_count = static_cast<std::uint32_t>(places.size());
    block.seq = offered.state.seq;
    block.stamp_ns = offered.state.stamp_ns;
    block.topology_version = offered.shape.state.topology_version;
    block.first = static_cast<std::uint32_t>(places[b].first);
    block.node_count = static_cast<std::uint32_t>(count);
    fill_block(strain, places[b], block.strains);
    fill_block(stress_pa, places[b], block.stresses);
    writer_.write(block);
  }
}

}  // namespace omentum::deform
