// Whose poses move a tool, where several devices send some.
#pragma once

#include "node_common/known_devices.h"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace omentum::node {

/// What a pose's sender may do with the tool.
enum class PoseRight : std::uint8_t {
  kHolds,    // moves it on
  kTakes,    // moves it from now on: a hand of its own, no continuation of another one's
  kWaits,    // the tool is going over to the wanted device: a moment for the last force to end
  kRefused,  // somebody else's
};

/// How long it takes until a force of a hand that fell silent has ended for certain: the longest that a pose
/// is young, and the decay.
inline constexpr double kYoungAtMost_s = 0.025;
constexpr std::int64_t hand_over_ns(double decay_s) noexcept {
  // what a device that starts anew needs to be taken again, too
  constexpr std::int64_t kLeast_ns = 50'000'000;
  return std::max(kLeast_ns, static_cast<std::int64_t>(1e9 * (kYoungAtMost_s + decay_s)));
}

/// A tool changed hands.
struct HandOver {
  std::uint64_t count = 0;  // of this tool's, this one included
  std::int64_t at_ns = 0;
  DeviceName from{}, to{};  // all zeros: a device that did not say its name
};

/// Decides whose a tool is. The first device that moves it keeps it until it is silent; only one that the
/// scene wants takes it from one that is not, and as long as a wanted one is there nobody else gets it. Of
/// two wanted ones, and of two that nobody asked for, the first one keeps it.
///
/// A taking takes as long as a silence: neither is heard until what the tool's last hand felt has decayed. So
/// forces end and begin as with a device that leaves and another one that comes. It begins when the wanted
/// one's poses have come for so long, none of them so late that it would lose a tool: one that is too slow to
/// hold the tool interrupts nobody. Then one may come twice as late. A silent tool the wanted one has at
/// once; any other one that takes it must have come for so long, too: a node that stood still may hear a
/// stranger first. A tool that nobody took is still its last hand's, also beside a wanted one that rests: a
/// node cannot tell a silence of the device from one of the wire or its own.
///
/// Plain arithmetic on given times; reads no clock. One thread at a time.
class ToolHolder {
 public:
  /// `silence_ns`: after how long without a pose that counts a tool is another device's.
  explicit ToolHolder(std::int64_t silence_ns) : silence_ns_(silence_ns) {}

  /// For a pose that is well formed, and is one by its own word.
  PoseRight judge(const transport::ParticipantId& who, std::int64_t now_ns,
                  const KnownDevices& known) noexcept;
  /// Somebody who knows better says whose it is. No other one's first force waits for the last one's here.
  void give(const transport::ParticipantId& who, std::int64_t now_ns, const KnownDevices& known) noexcept {
    take(who, now_ns, known);
  }
  /// The holder's pose was one that counts.
  void heard(std::int64_t now_ns) noexcept {
    heard_ns_ = now_ns;
    next_.reset();
  }

  const std::optional<transport::ParticipantId>& holder() const noexcept { return holder_; }
  /// The newest one; count 0: none yet.
  const HandOver& last() const noexcept { return last_; }

 private:
  struct Candidate {
    transport::ParticipantId who{};
    std::int64_t since_ns = 0, heard_ns = 0;
  };
  struct Heir : Candidate {
    std::optional<std::int64_t> handing_ns;  // since when the tool goes over to it
  };

  bool outranks_holder(const transport::ParticipantId& who, const KnownDevices& known) const noexcept {
    return known.wants(who) && !known.wants(*holder_);
  }
  bool has_left(const Heir& heir, std::int64_t now_ns) const noexcept {
    return now_ns - heir.heard_ns >= (heir.handing_ns ? 2 : 1) * silence_ns_;
  }
  PoseRight of_holder(std::int64_t now_ns, const KnownDevices& known) noexcept;
  PoseRight of_heir(const transport::ParticipantId& who, std::int64_t now_ns,
                    const KnownDevices& known) noexcept;
  PoseRight of_next(const transport::ParticipantId& who, std::int64_t now_ns,
                    const KnownDevices& known) noexcept;
  PoseRight take(const transport::ParticipantId& who, std::int64_t now_ns,
                 const KnownDevices& known) noexcept;

  std::int64_t silence_ns_;
  std::optional<transport::ParticipantId> holder_;
  std::optional<Heir> heir_;       // who outranks the holder
  std::optional<Candidate> next_;  // of the others, who came since the holder was heard
  std::int64_t heard_ns_ = 0;
  DeviceName holder_name_{};
  HandOver last_;
};

}  // namespace omentum::node
