// What the people of a session want of a node: pause, go on, reset, clear the fault.
#pragma once

#include "transport/messages.h"

#include <array>
#include <atomic>

namespace omentum::node {

/// The command (msg::COMMAND_*) as a sender of ours writes it, now: its number is the wall clock's, ns.
msg::SessionCommand make_command(std::uint32_t command);

/// A pause is a state of the session: a node that joins adopts it from the others. A reset is an event.
///
/// Every command is obeyed once, although senders send it twice, since a first sample may be lost: the same
/// command under the same number within kCopies_ns is a copy, whatever came between. Of a pause and a start
/// that two people give at the same moment the one with the later stamp holds, in whatever order they come to
/// whichever node; numbers that are no stamps (another sender may count) hold in the order of arrival.
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
  /// Stamps that are nearer than this were given at the same moment, ns: a person presses no faster, and
  /// clocks of two machines that are further apart say nothing.
  static constexpr std::uint64_t kSameMoment_ns = 1'000'000'000;

  /// `start_ns`: when the node joined, on the clock of hear().
  explicit SessionOrders(std::int64_t start_ns) : start_ns_(start_ns) {}

  void hear(const msg::SessionCommand& command, std::int64_t now_ns) noexcept;
  /// Another node's status; the node's own says nothing new.
  void hear(const msg::NodeStatus& status, std::int64_t now_ns) noexcept;

  bool paused() const noexcept;
  /// Whether somebody asked since the last call.
  bool take_reset() noexcept { return reset_.exchange(false, std::memory_order_acquire); }
  bool take_clear_fault() noexcept { return clear_fault_.exchange(false, std::memory_order_acquire); }

 private:
  enum class Flow : std::uint8_t { kRunning, kPauseAdopted, kOrderedToRun, kOrderedToPause };
  struct Heard {
    std::uint64_t seq = 0;
    std::uint32_t command = 0;
    std::int64_t arrived_ns = 0;
  };
  // more commands than people give within kCopies_ns (kCommandDepth of transport/topics.h)
  static constexpr std::size_t kRemembered = 32;

  bool is_copy(const msg::SessionCommand& command, std::int64_t now_ns) noexcept;
  void order(Flow flow, std::uint64_t seq) noexcept;

  std::int64_t start_ns_;
  std::array<Heard, kRemembered> heard_{};
  std::size_t heard_count_ = 0;
  std::uint64_t flow_seq_ = 0;  // of the pause or start that holds
  std::atomic<Flow> flow_{Flow::kRunning};
  std::atomic<bool> reset_{false}, clear_fault_{false};
};

}  // namespace omentum::node
