#include "node/session_orders.h"

#include <algorithm>
#include <chrono>

namespace omentum::node {
namespace {

// Whether a number is a time of this century, ns since 1970: no counter and no machine's time since its start
// gets there.
bool is_stamp(std::uint64_t seq) {
  return seq > 1'000'000'000'000'000'000;
}

}  // namespace

msg::SessionCommand make_command(std::uint32_t command) {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  const auto stamp_ns = std::chrono::duration_cast<std::chrono::nanoseconds>(since_epoch).count();
  return {.seq = static_cast<std::uint64_t>(stamp_ns), .command = command, .argument = {}};
}

void SessionOrders::hear(const msg::SessionCommand& command, std::int64_t now_ns) noexcept {
  if (is_copy(command, now_ns)) return;
  switch (command.command) {
    case msg::COMMAND_START:
      order(Flow::kOrderedToRun, command.seq);
      break;
    case msg::COMMAND_PAUSE:
      order(Flow::kOrderedToPause, command.seq);
      break;
    case msg::COMMAND_RESET:
      reset_.store(true, std::memory_order_release);
      break;
    case msg::COMMAND_CLEAR_FAULT:
      clear_fault_.store(true, std::memory_order_release);
      break;
    default:
      break;
  }
}

void SessionOrders::order(Flow flow, std::uint64_t seq) noexcept {
  const bool crossed = is_stamp(seq) && seq < flow_seq_ && flow_seq_ - seq < kSameMoment_ns;
  if (crossed) return;
  flow_seq_ = seq;
  flow_.store(flow, std::memory_order_relaxed);
}

void SessionOrders::hear(const msg::NodeStatus& status, std::int64_t now_ns) noexcept {
  if (!status.paused || now_ns - start_ns_ > kJoining_ns) return;
  // who was ordered knows better
  Flow unordered = Flow::kRunning;
  flow_.compare_exchange_strong(unordered, Flow::kPauseAdopted, std::memory_order_relaxed);
}

bool SessionOrders::paused() const noexcept {
  const Flow flow = flow_.load(std::memory_order_relaxed);
  return flow == Flow::kPauseAdopted || flow == Flow::kOrderedToPause;
}

bool SessionOrders::is_copy(const msg::SessionCommand& command, std::int64_t now_ns) noexcept {
  const auto end = heard_.begin() + static_cast<std::ptrdiff_t>(std::min(heard_count_, kRemembered));
  const bool known = std::any_of(heard_.begin(), end, [&](const Heard& heard) {
    return heard.seq == command.seq && heard.command == command.command &&
           now_ns - heard.arrived_ns <= kCopies_ns;
  });
  if (!known) heard_[heard_count_++ % kRemembered] = {command.seq, command.command, now_ns};
  return known;
}

}  // namespace omentum::node
