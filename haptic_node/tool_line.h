// One tool's line to its device: poses in through the guard, forces out through the safety's exit.
#pragma once

#include "haptic_node/device_book.h"
#include "haptic_node/force_safety.h"
#include "haptic_node/haptic_step.h"
#include "haptic_node/hold_lead.h"
#include "haptic_node/pose_guard.h"
#include "haptic_node/pose_interval.h"
#include "node_common/tool_holder.h"
#include "runtime/faults.h"
#include "runtime/mailbox.h"

#include <atomic>
#include <string>

namespace omentum::haptic {

/// How a tool's poses came in.
struct PoseCounts {
  std::uint64_t accepted = 0, refused = 0, lost = 0;
};

/// All times are CLOCK_MONOTONIC of this process, ns, and are given: tests inject them.
class ToolLine {
 public:
  /// Jaws whose poses stay out for less hold on to the tissue, though the hand feels nothing of it: a busy
  /// machine takes some tens of ms from a device. (deform_node tells no models around a tool that is silent
  /// for 0.1 s.)
  static constexpr std::int64_t kHoldSilence_ns = 200'000'000;
  /// After so long a silence a device is told nothing more, ns.
  static constexpr std::int64_t kForget_ns = 1'000'000'000;

  /// `id`: which tool of the scene; `device`: the name of the device that the scene wants for it, or empty.
  /// `faults` must outlive the line.
  ToolLine(std::uint32_t id, const ForceLimits& limits, runtime::FaultList& faults, std::string device = {});

  std::uint32_t id() const noexcept { return id_; }

  // ---- the vendor's threads, one at a time for each message

  /// Whether the pose was accepted: then the loop has something to do. A sample that says itself that it is
  /// none (`valid` down) is counted with the refused ones; any other refused one is a fault as well, and so
  /// are poses that come less often than kLongestInterval_s. `who` sent it: of several devices one holds the
  /// tool (node::ToolHolder).
  bool hear(const msg::ToolPose& pose, std::int64_t now_ns,
            const transport::ParticipantId& who = {}) noexcept;
  void hear(const msg::DeviceInfo& info, const transport::WriterId& writer = {}) noexcept;
  /// A writer of DeviceInfo left, in whatever way. On the thread of its samples.
  void gone(const transport::WriterId& writer) noexcept;

  // ---- any thread

  /// After a reset the device's path starts elsewhere: its next pose is a new connection.
  void expect_new_connection() noexcept { forget_.store(true, std::memory_order_release); }
  PoseCounts counts() const noexcept;

  // ---- the ordinary thread

  /// Who says that he is this tool's device.
  const node::KnownDevices& described() noexcept {
    described_.fetch();
    return described_.value();
  }
  /// The newest hand-over if there was one since the last call.
  const node::HandOver* fetch_hand_over() noexcept { return handed_.fetch() ? &handed_.value() : nullptr; }

  // ---- the loop's thread

  /// Takes the newest pose; what the step shall see of it. Returns whether it is a new one. A silent tool
  /// holds its dent no longer than its force: when that has decayed it lets go of the tissue. If it is heard
  /// again it is a tool that appears where it is.
  bool listen(std::int64_t now_ns, ToolInput& input) noexcept;
  /// The force that may leave, with the echo of the pose that `listen` took. Every tick: safety follows the
  /// hand.
  const msg::ToolForce& answer(const ToolOutput& output, std::int64_t now_ns, double dt_s,
                               bool paused) noexcept;
  /// The newest answer as the next sample of the topic: only what is sent is counted. Then say whether it
  /// was.
  const msg::ToolForce& to_send(std::uint64_t tick) noexcept;
  void sent(bool written) noexcept { written_ = written; }

  /// After a reset: the next force fades in from zero.
  void restart() noexcept;
  /// A person says that the latched fault is mended: the next force fades in from zero.
  void clear_fault() noexcept { safety_.clear_fault(); }
  /// Whether a tool is in the scene.
  bool engaged() const noexcept { return engaged_; }
  /// Whether its device is told forces: as long as that, and a while longer that there is none.
  bool is_told() const noexcept { return told_; }
  /// The newest pose that counts, all zeros before the first.
  const msg::ToolPose& pose() const noexcept { return poses_.value().pose; }
  /// What an answer to it echoes; seq 0 and stamp 0 before the first.
  msg::Echo echo() const noexcept;
  const ForceSafety& safety() const noexcept { return safety_; }

 private:
  struct HeardPose {
    msg::ToolPose pose{};
    std::int64_t arrival_ns = 0;
    std::uint64_t connection = 0;  // counts new connections; 0: none yet
    double interval_s = 0;         // how often they come; 0: not known
  };

  /// The text for a field of DeviceInfo, with the first value that was refused: one text however many come.
  using DeviceFault = std::array<char, runtime::FaultList::kTextSize + 1>;

  PoseVerdict judge(const msg::ToolPose& pose, std::int64_t now_ns,
                    const transport::ParticipantId& who) noexcept;
  void tell(const RefusedLimit& refused) noexcept;
  void take(const HeardPose& heard) noexcept;
  std::int64_t silence_ns(const HeardPose& heard) const noexcept;
  SafetyInput known(const ToolOutput& output, std::int64_t now_ns, double dt_s) const noexcept;
  SafeForce pass(const SafetyInput& input) noexcept;

  std::uint32_t id_;
  ForceLimits limits_;
  runtime::FaultList& faults_;
  std::array<std::string, kPoseVerdicts> refusals_;  // texts, made beforehand
  std::string force_fault_, source_fault_, slow_fault_;

  // the vendor's threads
  PoseGuard guard_;
  node::ToolHolder holder_;
  PoseInterval interval_;
  std::uint64_t connections_ = 0;
  std::atomic<bool> forget_{false};
  std::atomic<std::uint64_t> accepted_{0}, refused_{0}, lost_{0};
  runtime::Mailbox<HeardPose> poses_;
  DeviceBook devices_;
  std::array<DeviceFault, kLimitFields> device_faults_{};
  runtime::Mailbox<DeviceLimits> device_;
  node::DeviceRegister named_;
  runtime::Mailbox<node::KnownDevices> known_;      // to the poses' thread
  runtime::Mailbox<node::HandOver> handed_;         // and from it to the ordinary one
  runtime::Mailbox<node::KnownDevices> described_;  // to the ordinary one

  // the loop's thread
  ForceSafety safety_;
  HoldLead lead_;
  double max_stiffness_n_m_ = kUsualStiffness_n_m;
  bool engaged_ = false, told_ = false;
  bool reconnected_ = false;      // it appears where it is: a new connection, or after a silence
  std::uint64_t connection_ = 0;  // of the newest pose taken ...
  std::int64_t stamp_ns_ = 0, taken_arrival_ns_ = 0;  // ... and when it was measured and came
  double way_s_ = 0;      // what the way to it took; 0: no pose was taken in this tick
  bool written_ = false;  // the last answer was
  bool fed_ = false;      // a source was cut off, and said so
  msg::ToolForce force_{};
};

/// The pose's frame. The quaternion is normalized; it must not be zero (PoseGuard lets none pass). Any
/// thread.
ToolFrame frame_of(const msg::ToolPose& pose) noexcept;

}  // namespace omentum::haptic
