// One tool's half of the hand's loop: forces in, poses out.
#pragma once

#include "device_bridge/answer_gate.h"
#include "device_bridge/device.h"
#include "device_bridge/force_hold.h"
#include "device_bridge/frames/hand_mapping.h"
#include "device_bridge/hand_guard.h"
#include "runtime/faults.h"
#include "runtime/mailbox.h"

#include <cstdint>
#include <memory>
#include <string>

namespace omentum::device {

/// Between a Device and its topics. What guards the hand (limits, rise, the account of energy) stands on the
/// hand's side of the mapping, what the wire says is the tool's. Reads no clock.
class ToolChannel {
 public:
  /// `faults` must outlive the channel. Throws std::runtime_error naming what the device's info has wrong.
  ToolChannel(std::unique_ptr<Device> device, runtime::FaultList& faults, const MappingSpec& mapping = {});

  std::uint32_t tool() const { return info_.tool; }
  /// What is published: the device as the tool has it.
  const msg::DeviceInfo& info() const { return info_; }
  Device& device() { return *device_; }
  const Device& device() const { return *device_; }

  /// An answer of haptic_node. Only those that are accepted are exerted; one to another device's pose raises
  /// a fault. One thread (the reader's) at a time.
  AnswerVerdict receive(const msg::ToolForce& answer, std::int64_t now_ns) noexcept;

  /// Once a period, the loop's thread: commands the newest force and returns the pose to publish, stamped
  /// with the time of its measurement. A measurement that is not finite, or too old (kOldestMeasurement_s),
  /// goes out with its valid flag down and raises a fault; likewise one that the mapping makes no pose of.
  const msg::ToolPose& tick(std::int64_t now_ns) noexcept;

  /// Lets the hand go: commands nothing.
  void release() noexcept { device_->command({}); }

  std::uint64_t sent() const { return pose_.seq; }
  /// Given to the hand by the forces' work along the way of the tip, and that of the jaws' torque, J:
  /// negative where the hand gave.
  double energy_j() const { return energy_j_; }
  /// The most that it was at any time, J: EnergyTank::kBound_j bounds it.
  double most_energy_j() const { return most_energy_j_; }
  /// In how many periods less was exerted than answered, because it was not covered (HandGuard).
  std::uint64_t held_back() const { return guard_.held_back(); }
  /// How many times answers did not come in time, so that the force decayed.
  std::uint64_t expired() const { return hold_.expired(); }
  /// Any thread.
  AnswerCounts answers() const noexcept { return gate_.counts(); }

 private:
  struct Received {
    msg::ToolForce answer;
    std::int64_t at_ns = 0;
  };
  struct Exerted {
    Wrench wrench;
    std::uint64_t answer_seq = 0;  // whose, or what is left of it; 0: nobody's
  };

  const std::string* objection(const Measurement& measured, std::int64_t now_ns) const noexcept;
  bool usable(const Measurement& hand, std::int64_t now_ns) noexcept;
  void account(const Measurement& hand, const Wrench& moving) noexcept;
  void fill(const Measurement& tool, std::int64_t now_ns) noexcept;

  std::unique_ptr<Device> device_;
  HandMapping mapping_;
  msg::DeviceInfo info_;
  runtime::FaultList& faults_;
  // the faults' texts, made beforehand
  std::string bad_force_, foreign_answer_, bad_measurement_, old_measurement_, off_trocar_;
  AnswerGate gate_;
  runtime::Mailbox<Received> received_;
  ForceHold hold_;
  HandGuard guard_;
  Exerted exerted_;  // commanded last
  msg::ToolPose pose_;
  Measurement hand_;  // the newest; not valid where it could not be used
  std::int64_t ticked_ns_ = 0;
  double energy_j_ = 0, most_energy_j_ = 0;
};

}  // namespace omentum::device
