// What stands between a hand and the step: guard and safety here, the device's hold there; without a wire.
#pragma once

#include "device_bridge/force_hold.h"
#include "haptic_node/tool_line.h"

namespace omentum::haptic_test {

/// One hand's loop: its poses are heard, its answers exerted, each for one period of the device. Nothing is
/// late or lost. Keeps the account of what the hand really got.
class HandLine {
 public:
  /// The device exerts the whole wrench within a table-top device's limits.
  HandLine(std::uint32_t tool, double rate_hz);

  /// What the device exerts from now on, until the next pose.
  const device::Wrench& exert(std::int64_t now_ns);
  const device::Wrench& exerted() const { return exerted_; }
  /// The hand went there under it. What the step shall see.
  haptic::ToolInput hear(const haptic::ToolFrame& pose, std::int64_t now_ns);
  /// The step's answer to that pose, on its way to the device.
  void answer(const haptic::ToolOutput& output, std::int64_t now_ns);

  /// Given to the hand in all, less what it put in, J; and the most of it at any time, and of its negative.
  double given_j() const { return given_j_; }
  double most_given_j() const { return most_given_j_; }
  double most_put_in_j() const { return most_put_in_j_; }
  /// How many answers were not the model's own.
  int altered() const { return altered_; }

 private:
  runtime::FaultList faults_;
  haptic::ToolLine line_;
  device::ForceHold hold_;
  double period_s_;
  msg::ToolPose pose_{};
  haptic::ToolFrame frame_;
  device::Wrench exerted_;
  double given_j_ = 0, most_given_j_ = 0, most_put_in_j_ = 0;
  int altered_ = 0;
};

}  // namespace omentum::haptic_test
