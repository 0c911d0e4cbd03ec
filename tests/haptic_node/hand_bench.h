// A hand, its device, the wire and haptic_node's line to it, on one injected clock: what the hand really
// receives when the model and the wire do as they like.
#pragma once

#include "device_bridge/force_hold.h"
#include "device_bridge/tool_channel.h"
#include "haptic_node/tool_line.h"
#include "node_common/vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <memory>
#include <random>

namespace omentum::hand_test {

using geometry::Vec3;

constexpr std::int64_t kMs = 1'000'000;

/// Where the hand is, whatever it feels: a closed loop would stop what a hostile path keeps going.
using Path = std::function<Vec3(double t_s)>;

/// What the model sees of the hand.
struct Seen {
  Vec3 tip = Vec3::Zero(), velocity = Vec3::Zero();
  double t_s = 0;
};
/// The model's answer, whatever it likes.
using Model = std::function<haptic::ToolOutput(const Seen&)>;

/// What goes wrong, each with its probability in a sample.
struct Wire {
  double poses_lost = 0, answers_lost = 0, writes_failed = 0;
  double kept_back = 0;  // an answer comes late_ms after the others: a burst
  double late_ms = 8;
  double freezes_per_s = 0;  // of haptic_node, 10 to 200 ms
};

/// A device whose motors do what they are told and whose place is the path's.
class LedHand : public device::Device {
 public:
  LedHand(Path path, bool simulated) : path_(std::move(path)), simulated_(simulated) {}

  msg::DeviceInfo info() const override {
    msg::DeviceInfo info{};
    info.max_force_n = 20;
    info.max_torque_nm = 1;
    info.max_stiffness_n_m = 3000;
    info.actuated_axes = msg::AXIS_X | msg::AXIS_Y | msg::AXIS_Z;
    return info;
  }
  void command(const device::Wrench& wrench) noexcept override {
    before = commanded;
    commanded = wrench.force;
  }
  device::Measurement measure(std::int64_t now_ns) noexcept override {
    return {.valid = true, .measured_ns = now_ns, .position = path_(1e-9 * static_cast<double>(now_ns))};
  }

  bool simulates() const noexcept override { return simulated_; }
  /// What moved it to where it was measured last.
  const Vec3& moving() const { return simulated_ ? commanded : before; }

  Vec3 before = Vec3::Zero(), commanded = Vec3::Zero();  // N

 private:
  Path path_;
  bool simulated_;
};

/// What a run gave to the hand.
struct Received {
  double most_j = -1e9;       // the most work that it ever had received in all
  double largest_step_n = 0;  // of the force from one command to the next, rising
  double smallest_share = 1;  // of the model's force that haptic_node let through
  std::uint32_t acted = 0;    // ToolForce.state bits after the first half second
  double largest_n = 0;
  double held_back_n = 0;  // the most that the device exerted less than it was told, after the first second
};

/// What stands between the wire and the motors: all of device_bridge's, or a maker's own code that only holds
/// a force and lets it decay.
enum class Kit { kWhole, kHoldOnly };

class HandBench {
 public:
  static constexpr std::int64_t kGrid_ns = kMs / 4;

  HandBench(double device_hz, const Path& path, Model model, Wire wire = {}, bool simulated = false)
      : period_ns_(static_cast<std::int64_t>(1e9 / device_hz)),
        path_(path),
        model_(std::move(model)),
        wire_(wire),
        simulated_(simulated) {
    connect_device();
    line_.hear(channel_->info());
  }

  /// Another process of the device: it knows nothing of the one before.
  void connect_device() {
    auto hand = std::make_unique<LedHand>(path_, simulated_);
    hand_ = hand.get();
    channel_ = std::make_unique<device::ToolChannel>(std::move(hand), faults_);
    on_the_way_.clear();
  }

  const Received& run(double seconds) {
    const std::int64_t end_ns = now_ns_ + static_cast<std::int64_t>(1e9 * seconds);
    while (now_ns_ < end_ns) step();
    return received_;
  }

  const Received& received() const { return received_; }
  /// What the hand received in all until now, J.
  double work_j() const { return work_j_; }
  haptic::ToolLine& line() { return line_; }
  device::ToolChannel& channel() { return *channel_; }
  Kit kit = Kit::kWhole;
  bool paused = false;
  bool deaf = false;  // no pose arrives
  void forget_peaks() { received_.largest_n = 0; }
  double now_s() const { return 1e-9 * static_cast<double>(now_ns_); }

 private:
  bool chance(double p) { return p > 0 && std::uniform_real_distribution<double>(0, 1)(random_) < p; }

  void step() {
    now_ns_ += kGrid_ns;
    while (!on_the_way_.empty() && on_the_way_.front().second <= now_ns_) {
      told_n_ = node::to_vector(on_the_way_.front().first.force).norm();
      receive(on_the_way_.front().first);
      on_the_way_.pop_front();
    }
    bool arrived = false;
    if (now_ns_ >= device_due_ns_) {
      device_due_ns_ = now_ns_ + period_ns_;
      arrived = tick_device();
    }
    if (chance(wire_.freezes_per_s * 1e-9 * static_cast<double>(kGrid_ns))) {
      const double ms = std::uniform_real_distribution<double>(10, 200)(random_);
      frozen_until_ns_ = now_ns_ + static_cast<std::int64_t>(1e6 * ms);
    }
    if (now_ns_ < frozen_until_ns_) return;
    if (arrived || now_ns_ - ticked_ns_ >= kMs) tick_node(arrived);
  }

  void receive(const msg::ToolForce& answer) {
    if (kit == Kit::kWhole) {
      static_cast<void>(channel_->receive(answer, now_ns_));
    } else {
      static_cast<void>(hold_.take(answer, now_ns_));
    }
  }

  msg::ToolPose exert_and_measure() {
    if (kit == Kit::kWhole) return channel_->tick(now_ns_);
    hand_->command(hold_.at(now_ns_));
    msg::ToolPose pose{};
    pose.seq = ++bare_seq_;
    pose.stamp_ns = now_ns_;
    pose.valid = true;
    pose.orientation.w = 1;
    pose.position = node::to_message(hand_->measure(now_ns_).position);
    return pose;
  }

  bool tick_device() {
    const Vec3 from = tip_;
    const msg::ToolPose pose = exert_and_measure();
    tip_ = node::to_vector(pose.position);
    const Vec3 way = moved_ ? Vec3(tip_ - from) : Vec3::Zero();
    moved_ = true;
    work_j_ += hand_->moving().dot(way);
    received_.most_j = std::max(received_.most_j, work_j_);
    received_.largest_n = std::max(received_.largest_n, hand_->commanded.norm());
    if (now_s() > 1)
      received_.held_back_n = std::max(received_.held_back_n, told_n_ - hand_->commanded.norm());
    if (hand_->commanded.norm() > hand_->before.norm())
      received_.largest_step_n =
          std::max(received_.largest_step_n, (hand_->commanded - hand_->before).norm());
    if (deaf || chance(wire_.poses_lost)) return false;
    if (now_ns_ < frozen_until_ns_) {
      kept_ = pose;
      return false;
    }
    return line_.hear(pose, now_ns_);
  }

  void tick_node(bool arrived) {
    if (kept_.seq != 0) {
      arrived |= line_.hear(kept_, now_ns_);
      kept_ = {};
    }
    haptic::ToolInput input;
    const bool fresh = line_.listen(now_ns_, input);
    const double dt_s = std::min(1e-9 * static_cast<double>(now_ns_ - ticked_ns_), 0.02);
    ticked_ns_ = now_ns_;
    if (fresh) look(input.frame.p_WT);
    const haptic::ToolOutput output = model_(seen_);
    const msg::ToolForce& force = line_.answer(output, now_ns_, dt_s, paused);
    if (now_s() > 0.5) received_.acted |= force.state;
    if (now_s() > 0.5 && !output.force.isZero(0))
      received_.smallest_share = std::min(received_.smallest_share, line_.safety().share());
    if (!fresh && now_ns_ - answered_ns_ < 3 * kMs / 2) return;
    send();
  }

  void send() {
    const msg::ToolForce& force = line_.to_send(++ticks_);
    const bool written = !chance(wire_.writes_failed);
    line_.sent(written);
    if (!written) return;
    answered_ns_ = now_ns_;
    if (chance(wire_.answers_lost)) return;
    const double late_ms = chance(wire_.kept_back) ? wire_.late_ms : 0.1;
    on_the_way_.emplace_back(force, now_ns_ + static_cast<std::int64_t>(1e6 * late_ms));
  }

  void look(const Vec3& tip) {
    const double dt_s = 1e-9 * static_cast<double>(now_ns_ - seen_ns_);
    if (dt_s > 0) seen_.velocity = (tip - seen_.tip) / dt_s;
    seen_.tip = tip;
    seen_.t_s = now_s();
    seen_ns_ = now_ns_;
  }

  std::int64_t period_ns_;
  Path path_;
  Model model_;
  Wire wire_;
  bool simulated_;
  std::mt19937 random_{1};
  runtime::FaultList faults_;
  haptic::ToolLine line_{0, {}, faults_};
  LedHand* hand_ = nullptr;
  device::ForceHold hold_{20, 1};
  std::uint64_t bare_seq_ = 0;
  std::unique_ptr<device::ToolChannel> channel_;
  std::deque<std::pair<msg::ToolForce, std::int64_t>> on_the_way_;
  std::int64_t now_ns_ = 0, device_due_ns_ = 0, ticked_ns_ = 0, answered_ns_ = 0, seen_ns_ = 0;
  std::int64_t frozen_until_ns_ = 0;
  msg::ToolPose kept_{};
  std::uint64_t ticks_ = 0;
  Vec3 tip_ = Vec3::Zero();
  bool moved_ = false;
  double work_j_ = 0, told_n_ = 0;
  Seen seen_;
  Received received_;
};

}  // namespace omentum::hand_test
