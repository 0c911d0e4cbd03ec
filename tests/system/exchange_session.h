// The hand's loop and the organ's on one scripted bus, with a device that goes where a test says.
#pragma once

#include "deform_node/deform_loop.h"
#include "haptic_node/haptic_loop.h"
#include "scene/scene.h"

#include "tests/deform_node/yielding_block.h"
#include "tests/support/block_scene.h"
#include "tests/support/fake_bus.h"
#include "tests/support/staged_loop.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>

namespace omentum::test {

using geometry::Vec3;

inline constexpr std::array kFelt{
    scene::OrganModelWord{"quasi-static", scene::OrganKind::kTetrahedralMesh, scene::Feel::kLocalModels}};
inline constexpr std::array kMoved{deform_test::kYieldingBlock};
inline const Vec3 kAbove{0.048, 0.053, 0.103}, kPressed{0.048, 0.053, 0.094};
inline constexpr double kListens_s = 1, kApproach_s = 0.5;

inline const BlockScene& block() {
  static const BlockScene scene(
      6,
      "[[tools]]\nid = 0\nname = \"hook\"\nshape = \"probe\"\npoints = [[0,0,0], [0.003,0,0.001]]\n"
      "cuts = true\nedge = [[0,0,0], [0,0,0.01]]\n");
  return scene;
}

/// The scene, and models other than those that the product knows.
struct ExchangeScene {
  std::string file = block().scene();
  std::span<const scene::OrganModelWord> felt = kFelt;
  std::span<const deform::ModelEntry> moved = kMoved;
};

/// One hand, one organ; each ticks at its own rate, the hand's device with the hand's loop.
class Session {
 public:
  Session(double hand_hz, double organ_hz, const ExchangeScene& scene = {})
      : hand_hz_(hand_hz),
        organ_hz_(organ_hz),
        scene_(scene),
        hand_(make_hand()),
        organ_(organ_hz, organ_options(organ_hz, scene), bus_.opener()) {}

  /// The hand's next tick with the tip there; the organ's, where one is due. The force on the hand.
  Vec3 step_to(const Vec3& tip, bool pressed = false) {
    msg::ToolPose pose{};
    pose.seq = ++poses_;
    pose.stamp_ns = hand_->pace().now_ns();
    pose.valid = true;
    pose.position = {tip.x(), tip.y(), tip.z()};
    pose.orientation.w = 1;
    pose.buttons = pressed ? msg::BUTTON_CUT : 0;
    pose.grip = grip_rad_;
    bus_.post(pose);
    hand_->tick();
    tip_ = tip;
    hand_s_ += 1 / hand_hz_;
    while (organ_lives_ && organ_s_ + 1 / organ_hz_ <= hand_s_ + 1e-9) {
      organ_s_ += 1 / organ_hz_;
      organ_.tick();
    }
    for (const msg::ToolForce& force : bus_.take_all<msg::ToolForce>())
      if (force.tool == 0) felt_ = Vec3(force.force.x, force.force.y, force.force.z);
    return felt_;
  }
  Vec3 move_to(const Vec3& tip, double seconds, bool pressed = false) {
    const Vec3 from = tip_;
    const int ticks = static_cast<int>(std::lround(seconds * hand_hz_));
    Vec3 force = Vec3::Zero();
    for (int i = 1; i <= ticks; ++i) {
      const Vec3 before = tip_;
      force = step_to(from + (tip - from) * i / ticks, pressed);
      given_j_ += 0.5 * (force + last_).dot(tip_ - before);
      most_given_j_ = std::max(most_given_j_, given_j_);
      largest_step_n_ = std::max(largest_step_n_, (force - last_).norm());
      last_ = force;
    }
    return force;
  }
  /// Both have listened; the tip is above the organ.
  void begin() { move_to(kAbove, kListens_s + 0.5); }
  Vec3 press() {
    move_to(kPressed, kApproach_s);
    return move_to(kPressed, 1);
  }

  /// After press(): aside by a centimetre, off, and back above the place.
  void slide_and_leave() {
    move_to(kPressed + Vec3(0.01, 0, 0), 0.5);
    move_to(kAbove + Vec3(0.01, 0, 0), 0.5);
    move_to(kAbove, 0.5);
  }
  /// After press(): over the surface and back, still pressed.
  void slide_to_and_fro() {
    move_to(kPressed + Vec3(0.02, 0.01, 0), 1);
    move_to(kPressed, 1);
  }

  /// Another tool's next pose, upright.
  void place_other(std::uint32_t tool, const Vec3& tip, bool pressed) {
    msg::ToolPose pose{};
    pose.tool = tool;
    pose.seq = poses_ + 1;
    pose.stamp_ns = hand_->pace().now_ns();
    pose.valid = true;
    pose.position = {tip.x(), tip.y(), tip.z()};
    pose.orientation.w = 1;
    pose.buttons = pressed ? msg::BUTTON_CUT : 0;
    bus_.post(pose);
  }
  /// Of the next poses: how far the jaws are open.
  void open_jaws(double grip_rad) { grip_rad_ = grip_rad; }
  void stop_organ() { organ_lives_ = false; }
  /// A busy machine takes the organ's next ticks away.
  void take_organ_ticks(int count) {
    organ_.pace().stall(std::llround(1e9 * count / organ_hz_));
    organ_s_ += count / organ_hz_;
  }
  /// Another one in its place, which knows of nothing that was.
  void replace_hand() {
    EXPECT_EQ(hand_->end(), "");
    hand_.reset();
    hand_ = make_hand();
    last_.setZero();
  }
  double given_j() const { return given_j_; }
  double most_given_j() const { return most_given_j_; }
  double largest_step_n() const { return largest_step_n_; }
  nlohmann::json hand_report() {
    EXPECT_EQ(hand_->end(), "");
    return hand_->loop().report();
  }
  nlohmann::json organ_report() {
    EXPECT_EQ(organ_.end(), "");
    return organ_.loop().report();
  }
  FakeBus& bus() { return bus_; }

 private:
  std::unique_ptr<StagedLoop<haptic::HapticLoop>> make_hand() {
    return std::make_unique<StagedLoop<haptic::HapticLoop>>(hand_hz_, hand_options(hand_hz_, scene_),
                                                            bus_.opener());
  }
  static haptic::HapticOptions hand_options(double rate_hz, const ExchangeScene& scene) {
    haptic::HapticOptions options;
    options.node.scene = scene.file;
    options.rate_hz = rate_hz;
    options.models = scene.felt;
    return options;
  }
  static deform::DeformOptions organ_options(double rate_hz, const ExchangeScene& scene) {
    deform::DeformOptions options;
    options.node.scene = scene.file;
    options.rate_hz = rate_hz;
    options.models = scene.moved;
    return options;
  }

  double hand_hz_, organ_hz_, hand_s_ = 0, organ_s_ = 0;
  FakeBus bus_;
  ExchangeScene scene_;
  std::unique_ptr<StagedLoop<haptic::HapticLoop>> hand_;
  StagedLoop<deform::DeformLoop> organ_;
  std::uint64_t poses_ = 0;
  Vec3 tip_ = kAbove, last_ = Vec3::Zero(), felt_ = Vec3::Zero();
  bool organ_lives_ = true;
  double grip_rad_ = 0;
  double given_j_ = 0, most_given_j_ = 0, largest_step_n_ = 0;
};

/// What the tensors say of a press that is held, N: a hand that has them feels it.
inline double whole_n() {
  FakeBus bus;
  haptic::HapticOptions options;
  options.node.scene = block().scene();
  StagedLoop<haptic::HapticLoop> hand(1000, options, bus.opener());
  msg::ToolPose pose{};
  for (int i = 0; i < 2500; ++i) {
    const Vec3 tip = kAbove + (kPressed - kAbove) * std::clamp((i - 1500) / 500.0, 0.0, 1.0);
    pose.seq = static_cast<std::uint64_t>(i) + 1;
    pose.stamp_ns = hand.pace().now_ns();
    pose.valid = true;
    pose.position = {tip.x(), tip.y(), tip.z()};
    pose.orientation.w = 1;
    bus.post(pose);
    hand.tick();
  }
  const auto force = bus.newest<msg::ToolForce>();
  return Vec3(force->force.x, force->force.y, force->force.z).norm();
}

}  // namespace omentum::test
