// What the people of a session want of a node: pause, go on, reset, clear the fault.
#pragma once

#include "transport/messages.h"

#include <array>
#include <atomic>

namespace omentum::node {

/// A pause is a state of the session: a node that joins adopts it from the others. A reset is an event: it is
/// obeyed once, though senders send it twice, since a first sample may be lost (omentum_session).
///
/// Commands and statuses are heard on one thread each (their readers'), the rest may be asked by any; nobody
/// waits or allocates. Reads no clock.
class SessionOrders {
 public:
  /// How long a node that joins believes the others about the pause, ns: discovery takes up to 2.9 s between
  /// two Fast participants, and statuses come once a second or more often. Later only commands count.
  static constexpr std::int64_t kJoining_ns = 5'000'000'000;

  /// `start_ns`: when the node joined, on the clock of hear().
  explicit SessionOrders(std::int64_t start_ns) : start_ns_(start_ns) {}

  void hear(const msg::SessionCommand& command) noexcept;
  /// Another node's status; the node's own says nothing new.
  void hear(const msg::NodeStatus& status, std::int64_t now_ns) noexcept;

  bool paused() const noexcept;
  /// Whether somebody asked since the last call.
  bool take_reset() noexcept { return reset_.exchange(false, std::memory_order_acquire); }
  bool take_clear_fault() noexcept { return clear_fault_.exchange(false, std::memory_order_acquire); }

 private:
  enum class Flow : std::uint8_t { kRunning, kPauseAdopted, kOrderedToRun, kOrderedToPause };
  // copies of some commands of several senders may come one between another
  static constexpr std::size_t kRemembered = 8;

  bool is_new(std::uint64_t seq) noexcept;

  std::int64_t start_ns_;
  std::array<std::uint64_t, kRemembered> heard_{};  // sequence numbers of the newest events
  std::size_t heard_count_ = 0;
  std::atomic<Flow> flow_{Flow::kRunning};
  std::atomic<bool> reset_{false}, clear_fault_{false};
};

}  // namespace omentum::node
