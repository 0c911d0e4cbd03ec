// Writes which parts of the organs touch while somebody reads it, on a thread of its own.
#pragma once

#include "deform_node/state_mark.h"
#include "deform_node/touching_parts.h"
#include "runtime/mailbox.h"
#include "runtime/woken_thread.h"
#include "transport/bus.h"

#include <atomic>

namespace omentum::deform {

/// Publishes TouchingPairs for people to look at, less often than states. As StressPublisher: what nobody
/// reads is not copied, and is asked for anew as often as it would be told.
class TouchPublisher {
 public:
  /// Writer and organs outlive this. `rate_hz`: of the ticks. `start`: how the publishing thread is made.
  TouchPublisher(transport::Writer<msg::TouchingPairs>& writer, const OrganGroup& organs,
                 std::size_t pairs_per_block, double rate_hz, const runtime::StartWork& start);

  /// The loop's thread, in every tick, after the steps. Neither waits nor allocates.
  void offer(const StateMark& state) noexcept;
  /// How many moments were told. The loop's thread, or after it.
  std::uint64_t told() const noexcept { return told_.load(std::memory_order_relaxed); }

 private:
  struct Offered {
    StateMark state;
    TouchingParts parts;
  };
  void write_newest();
  void write(Offered& offered);

  transport::Writer<msg::TouchingPairs>& writer_;
  const OrganGroup& organs_;
  std::size_t pairs_per_block_;
  std::uint64_t ticks_ = 0, ticks_per_moment_;
  runtime::Mailbox<Offered> newest_;
  std::atomic<bool> is_read_ = false;
  std::atomic<std::uint64_t> told_ = 0;
  std::unique_ptr<runtime::WokenWork> writing_;  // last: it uses what is above
};

}  // namespace omentum::deform
