#include "deform_node/touch_publisher.h"

#include <algorithm>
#include <cmath>

namespace omentum::deform {

namespace {

// Marks that jump ten times a second are seen to jump; more often than a picture comes is of no use.
constexpr double kTouchRate_hz = 20;
// Of a moment, before the hardest pushed are chosen. A gut of two metres that lies on itself has some
// hundred.
constexpr std::size_t kMostParts = 4 * std::size_t{msg::MAX_TOUCHING_PAIRS};

}  // namespace

TouchPublisher::TouchPublisher(transport::Writer<msg::TouchingPairs>& writer, const OrganGroup& organs,
                               std::size_t pairs_per_block, double rate_hz, const runtime::StartWork& start)
    : writer_(writer),
      organs_(organs),
      pairs_per_block_(pairs_per_block),
      ticks_per_moment_(std::max<std::uint64_t>(1, std::lround(rate_hz / kTouchRate_hz))),
      newest_({.state = {}, .parts = TouchingParts(kMostParts)}) {
  writing_ = start([this] { write_newest(); });
}

void TouchPublisher::offer(const StateMark& state) noexcept {
  const bool is_read = is_read_.load(std::memory_order_relaxed);
  if (ticks_++ % ticks_per_moment_ != 0) return;
  if (is_read) {
    Offered& draft = newest_.draft();
    draft.state = state;
    draft.parts.take(organs_);
    newest_.post();
  }
  writing_->wake();
}

void TouchPublisher::write_newest() {
  const bool is_read = writer_.status().matched > 0;
  is_read_.store(is_read, std::memory_order_relaxed);
  if (newest_.fetch() && is_read) write(newest_.value());
}

void TouchPublisher::write(Offered& offered) {
  const std::span<TouchingPart> all = offered.parts.all();
  const std::span<const TouchingPart> told = hardest_pushed(all);
  const std::size_t blocks =
      std::max<std::size_t>(1, (told.size() + pairs_per_block_ - 1) / pairs_per_block_);
  for (std::size_t b = 0; b < blocks; ++b) {
    msg::TouchingPairs block;
    block.block = static_cast<std::uint32_t>(b);
    block.block_count = static_cast<std::uint32_t>(blocks);
    block.seq = offered.state.seq;
    block.stamp_ns = offered.state.stamp_ns;
    block.touching = static_cast<std::uint32_t>(all.size());
    const std::size_t first = b * pairs_per_block_;
    for (const TouchingPart& part : told.subspan(first, std::min(pairs_per_block_, told.size() - first)))
      block.pairs.push_back(to_message(part));
    writer_.write(block);
  }
  told_.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace omentum::deform
