#include "node_common/session_orders.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace omentum::node {
namespace {

// A count that was driven to its end stays there: senders then are ordered by their names.
std::uint64_t after(std::uint64_t order) {
  return order == std::numeric_limits<std::uint64_t>::max() ? order : order + 1;
}

RecordOrder record_order(const std::string& argument) {
  if (argument == kRecordOn) return RecordOrder::kOn;
  return argument == kRecordOff ? RecordOrder::kOff : RecordOrder::kToggle;
}

}  // namespace

void SessionOrders::hear(const msg::SessionCommand& command, std::int64_t now_ns) noexcept {
  const Heard heard{command.order, command.sender, command.command, now_ns};
  if (is_copy(heard)) return;
  raise_newest(command.order);
  switch (command.command) {
    case msg::COMMAND_START:
      order(Flow::kOrderedToRun, heard);
      break;
    case msg::COMMAND_PAUSE:
      order(Flow::kOrderedToPause, heard);
      break;
    case msg::COMMAND_RESET:
      reset_.store(true, std::memory_order_release);
      break;
    case msg::COMMAND_CLEAR_FAULT:
      clear_fault_.store(true, std::memory_order_release);
      break;
    case msg::COMMAND_RECORD:
      record_.store(static_cast<std::uint8_t>(record_order(command.argument)), std::memory_order_release);
      break;
    default:
      break;
  }
}

std::optional<RecordOrder> SessionOrders::take_record() noexcept {
  const std::uint8_t newest = record_.exchange(kNoRecord, std::memory_order_acquire);
  if (newest == kNoRecord) return std::nullopt;
  return static_cast<RecordOrder>(newest);
}

void SessionOrders::order(Flow flow, const Heard& command) noexcept {
  const bool earlier =
      std::tie(command.order, command.sender) < std::tie(flow_order_.order, flow_order_.sender);
  if (ordered_ && earlier && command.arrived_ns - flow_order_.arrived_ns <= kCrossing_ns) return;
  ordered_ = true;
  flow_order_ = command;
  flow_.store(flow, std::memory_order_relaxed);
}

void SessionOrders::hear(const msg::NodeStatus& status, std::int64_t now_ns) noexcept {
  raise_newest(status.newest_order);
  if (!status.paused || now_ns - start_ns_ > kJoining_ns) return;
  // who was ordered knows better
  Flow unordered = Flow::kRunning;
  flow_.compare_exchange_strong(unordered, Flow::kPauseAdopted, std::memory_order_relaxed);
}

msg::SessionCommand SessionOrders::issue(std::uint32_t command, std::uint64_t sender) noexcept {
  std::uint64_t newest = newest_order();
  while (!newest_order_.compare_exchange_weak(newest, after(newest), std::memory_order_relaxed)) {
  }
  return {.order = after(newest), .sender = sender, .command = command, .argument = {}};
}

void SessionOrders::raise_newest(std::uint64_t order) noexcept {
  std::uint64_t newest = newest_order();
  while (newest < order && !newest_order_.compare_exchange_weak(newest, order, std::memory_order_relaxed)) {
  }
}

void SessionOrders::tell(msg::NodeStatus& status) const noexcept {
  status.paused = paused();
  status.newest_order = newest_order();
}

bool SessionOrders::paused() const noexcept {
  const Flow flow = flow_.load(std::memory_order_relaxed);
  return flow == Flow::kPauseAdopted || flow == Flow::kOrderedToPause;
}

bool SessionOrders::is_copy(const Heard& command) noexcept {
  const auto end = heard_.begin() + static_cast<std::ptrdiff_t>(std::min(heard_count_, kRemembered));
  const bool known = std::any_of(heard_.begin(), end, [&](const Heard& heard) {
    return heard.order == command.order && heard.sender == command.sender &&
           heard.command == command.command && command.arrived_ns - heard.arrived_ns <= kCopies_ns;
  });
  if (!known) heard_[heard_count_++ % kRemembered] = command;
  return known;
}

}  // namespace omentum::node
