// What the people of a session want of a node: pause, go on, reset, clear the fault, record.
#pragma once

#include "transport/messages.h"

#include <array>
#include <atomic>
#include <optional>

namespace omentum::node {

/// What COMMAND_RECORD asks for: its argument is "on", "off", or anything else for whichever it is not.
enum class RecordOrder : std::uint8_t { kOn, kOff, kToggle };
inline constexpr const char* kRecordOn = "on";
inline constexpr const char* kRecordOff = "off";

/// A pause is a state of the session: a node that joins adopts it from the others. A reset is an event.
///
/// Commands have an order that no clock makes (Lamport 1978): each sender writes one more than the highest it
/// heard of, and of equal orders the one of the larger sender is later. Of a pause and a start that two
/// people give at the same moment the later one holds, in whatever order they come to whichever node. Every
/// command is obeyed once, although senders send it twice, since a first sample may be lost: the same command
/// of the same sender and order within kCopies_ns is a copy, whatever came between. Who writes an order
/// without having listened is obeyed too, once kCrossing_ns have passed since a later command came: no number
/// shuts out what comes after it.
///
/// Commands and statuses are heard on one thread each (their readers'), the rest may be asked by any; nobody
/// waits or allocates. Reads no clock.
class SessionOrders {
 public:
  /// How long a node that joins believes the others about the pause, ns: discovery takes up to 2.9 s between
  /// two Fast participants, and statuses come once a second or more often. Later only commands count.
  static constexpr std::int64_t kJoining_ns = 5'000'000'000;
  /// omentum_session sends its copy after 0.2 s; a stalled machine may deliver it later, ns.
  static constexpr std::int64_t kCopies_ns = 2'000'000'000;
  /// Commands that come to this node within this may have crossed on their way, ns: as late as a copy may be.
  static constexpr std::int64_t kCrossing_ns = 2'000'000'000;

  /// `start_ns`: when the node joined, on the clock of hear().
  explicit SessionOrders(std::int64_t start_ns) : start_ns_(start_ns) {}

  void hear(const msg::SessionCommand& command, std::int64_t now_ns) noexcept;
  /// Another node's status; the node's own says nothing new.
  void hear(const msg::NodeStatus& status, std::int64_t now_ns) noexcept;

  /// The command (msg::COMMAND_*) as `sender` gives it now: later than all that was heard of.
  msg::SessionCommand issue(std::uint32_t command, std::uint64_t sender) noexcept;
  /// The highest order that was heard of.
  std::uint64_t newest_order() const noexcept { return newest_order_.load(std::memory_order_relaxed); }
  /// What a node's status says of its orders: whether it is paused, and the newest.
  void tell(msg::NodeStatus& status) const noexcept;

  bool paused() const noexcept;
  /// Whether somebody asked since the last call.
  bool take_reset() noexcept { return reset_.exchange(false, std::memory_order_acquire); }
  bool take_clear_fault() noexcept { return clear_fault_.exchange(false, std::memory_order_acquire); }
  /// The newest since the last call.
  std::optional<RecordOrder> take_record() noexcept;

 private:
  enum class Flow : std::uint8_t { kRunning, kPauseAdopted, kOrderedToRun, kOrderedToPause };
  /// What makes a command itself.
  struct Heard {
    std::uint64_t order = 0, sender = 0;
    std::uint32_t command = 0;
    std::int64_t arrived_ns = 0;
  };
  // more commands than people give within kCopies_ns (kCommandDepth of transport/topics.h)
  static constexpr std::size_t kRemembered = 32;

  bool is_copy(const Heard& command) noexcept;
  void order(Flow flow, const Heard& command) noexcept;
  void raise_newest(std::uint64_t order) noexcept;

  std::int64_t start_ns_;
  std::array<Heard, kRemembered> heard_{};
  std::size_t heard_count_ = 0;
  Heard flow_order_;  // the pause or start that holds
  bool ordered_ = false;
  std::atomic<std::uint64_t> newest_order_{0};
  std::atomic<Flow> flow_{Flow::kRunning};
  std::atomic<bool> reset_{false}, clear_fault_{false};
  static constexpr std::uint8_t kNoRecord = 255;
  std::atomic<std::uint8_t> record_{kNoRecord};  // a RecordOrder
};

}  // namespace omentum::node
