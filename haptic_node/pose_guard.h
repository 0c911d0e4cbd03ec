// What may reach the step from the tool topic: nothing that is not a number, not a place, or not news.
#pragma once

#include "transport/messages.h"

#include <array>
#include <cstdint>

namespace omentum::haptic {

/// Faster than any hand moves an instrument, m/s and rad/s: surgeons stay below 1 m/s, a thrown handle
/// below 5.
inline constexpr double kMaxToolSpeed_m_s = 5;
inline constexpr double kMaxTurnSpeed_rad_s = 60;

enum class PoseVerdict : std::uint8_t {
  kAccepted,
  kReconnected,      // accepted: the first one, or a new place or count that lasted
  kInvalid,          // no fault: the device says that it has no measurement
  kSameMeasurement,  // no fault: a new number, but not measured anew (the stamp is the known one)
  kHandedOver,       // no fault: while the tool goes over to the scene's device (ToolLine)
  kNotFinite,        // NaN or infinity in any number
  kNotARotation,     // the quaternion's length is off
  kOldSequence,      // repeated, or older than what is known, by number or stamp
  kJump,             // farther than an instrument can have moved
  kForeign,          // of a device that does not hold the tool (ToolLine)
};
inline constexpr int kPoseVerdicts = 10;

/// A short English phrase, e.g. "position jumps".
const char* describe(PoseVerdict verdict);

inline bool is_accepted(PoseVerdict verdict) {
  return verdict <= PoseVerdict::kReconnected;
}
inline bool is_fault(PoseVerdict verdict) {
  return verdict > PoseVerdict::kHandedOver;
}

/// later - earlier of two stamps from the wire; what does not fit is the largest there is.
std::int64_t stamp_difference_ns(std::int64_t earlier_ns, std::int64_t later_ns) noexcept;

/// Judges one tool's samples in order of arrival. A refused sample counts, and the pose before it ages on as
/// if none had come.
///
/// A device that restarted counts from anew, and one that was re-calibrated is elsewhere: samples that are
/// refused only because of where they are or how they count, but agree among themselves for kReconnect, are a
/// new connection.
///
/// Plain arithmetic on given times; reads no clock. One thread at a time.
class PoseGuard {
 public:
  /// How long a new place must last, ns: long beside a burst of bad samples, short for a person.
  static constexpr std::int64_t kReconnect_ns = 50'000'000;
  /// The longest gap that motion is granted for, ns: after it an instrument may be 10 cm away.
  static constexpr std::int64_t kLongestGap_ns = 20'000'000;

  PoseVerdict judge(const msg::ToolPose& pose, std::int64_t arrival_ns) noexcept;
  /// What the sample is by itself: kAccepted, kInvalid, kNotFinite or kNotARotation.
  static PoseVerdict form(const msg::ToolPose& pose) noexcept;

  /// The next well-formed sample is a new connection (after a reset, when the device's path starts again).
  void forget() noexcept { known_.present = false; }

  /// Sequence numbers that never came.
  std::uint64_t lost() const noexcept { return lost_; }

 private:
  struct Sample {
    bool present = false;
    msg::ToolPose pose;
    std::int64_t arrival_ns = 0;
  };

  static PoseVerdict follows(const Sample& before, const msg::ToolPose& pose,
                             std::int64_t arrival_ns) noexcept;
  PoseVerdict accept(const msg::ToolPose& pose, std::int64_t arrival_ns, PoseVerdict verdict) noexcept;

  Sample known_;                         // the newest accepted one
  Sample candidate_;                     // the newest refused one of a possible new connection ...
  std::int64_t candidate_since_ns_ = 0;  // ... which began then
  std::uint64_t lost_ = 0;
};

}  // namespace omentum::haptic
