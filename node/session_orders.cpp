#include "node/session_orders.h"

#include <algorithm>

namespace omentum::node {

void SessionOrders::hear(const msg::SessionCommand& command) noexcept {
  switch (command.command) {
    case msg::COMMAND_START:
      flow_.store(Flow::kOrderedToRun, std::memory_order_relaxed);
      break;
    case msg::COMMAND_PAUSE:
      flow_.store(Flow::kOrderedToPause, std::memory_order_relaxed);
      break;
    case msg::COMMAND_RESET:
      if (is_new(command.seq)) reset_.store(true, std::memory_order_release);
      break;
    case msg::COMMAND_CLEAR_FAULT:
      if (is_new(command.seq)) clear_fault_.store(true, std::memory_order_release);
      break;
    default:
      break;
  }
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

bool SessionOrders::is_new(std::uint64_t seq) noexcept {
  const auto end = heard_.begin() + static_cast<std::ptrdiff_t>(std::min(heard_count_, kRemembered));
  if (std::find(heard_.begin(), end, seq) != end) return false;
  heard_[heard_count_++ % kRemembered] = seq;
  return true;
}

}  // namespace omentum::node
