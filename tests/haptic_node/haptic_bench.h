// The real haptic_node on a domain of its own, and a device of the test's.
#pragma once

#include "runtime/clock.h"
#include "transport/bus.h"

#include "tests/haptic_node/haptic_block.h"

#include <cmath>
#include <mutex>
#include <optional>

namespace omentum::haptic_test {

/// haptic_node, and a device of this test's own.
class NodeBench {
 public:
  NodeBench(const test::BlockScene& scene, const std::string& node_vendor, transport::Vendor own)
      : domain_(test::domain_of_test()),
        node_("haptic_node", {"--scene", scene.scene(), "--dds", node_vendor, "--domain",
                              std::to_string(domain_), "--report", scene.report()}),
        bus_(transport::Bus::open({.vendor = own, .domain = domain_, .name = "test"})),
        poses_(bus_->writer<msg::ToolPose>()),
        scenes_(bus_->writer<msg::SceneInfo>()),
        forces_(bus_->reader<msg::ToolForce>([this](const msg::ToolForce& f) { take(f); })),
        contacts_(bus_->reader<msg::Contact>([this](const msg::Contact& c) { take(c); })) {}

  /// Sends the pose of tool 0 for as long as `wait` is false, at about the node's rate. False when patience
  /// ends.
  template <class Condition>
  bool hold(const Vec3& tip, Condition&& wait) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!wait()) {
      if (std::chrono::steady_clock::now() > end) return false;
      send(tip);
    }
    return true;
  }
  /// From where it is now, down or up in steps of 0.2 mm.
  void move(const Vec3& to) {
    const Vec3 from = tip_;
    const int steps = static_cast<int>(std::ceil((to - from).norm() / 2e-4));
    for (int i = 1; i <= steps; ++i) send(from + (to - from) * i / steps);
  }
  void send(const Vec3& tip) {
    tip_ = tip;
    msg::ToolPose pose{};
    pose.seq = ++seq_;
    pose.stamp_ns = runtime::steady_now_ns();
    pose.valid = true;
    pose.position = {.x = tip.x(), .y = tip.y(), .z = tip.z()};
    pose.orientation = {.w = 1, .x = 0, .y = 0, .z = 0};
    poses_->write(pose);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void send(const msg::SceneInfo& info) { scenes_->write(info); }

  /// Presses, or goes on pressing, until an answer is as `felt` says. A tip that a busy machine made the node
  /// lose is held where it is, without a force: it goes out and presses again.
  template <class Condition>
  bool press(Condition&& felt) {
    return test::comes_true([&] { return go_in() && (feels(felt) || go_out()); });
  }

  std::optional<msg::ToolForce> force() const { return get(force_); }
  std::optional<msg::Contact> contact() const { return get(contact_); }
  std::uint64_t seq() const { return seq_; }
  test::Process& node() { return node_; }
  int domain() const { return domain_; }

 private:
  bool go_in() {
    if (tip_ == kPressed) return true;
    const bool engaged = hold(kAbove, [&] { return force() && force()->state == 0; });
    move(kPressed);
    return engaged;
  }
  /// False: it is no press.
  bool go_out() {
    move(kAbove);
    return false;
  }
  /// Whether an answer to what is pressed from now on is as `felt` says.
  template <class Condition>
  bool feels(Condition&& felt) {
    constexpr int kPatience = 300;  // poses: longer than forces fade in
    const std::uint64_t from = seq_ + 1;
    for (int pose = 0; pose < kPatience; ++pose) {
      send(kPressed);
      if (force()->echo_seq >= from && felt()) return true;
    }
    return false;
  }

  void take(const msg::ToolForce& force) {
    const std::lock_guard lock(mutex_);
    if (force.tool == 0) force_ = force;
  }
  void take(const msg::Contact& contact) {
    const std::lock_guard lock(mutex_);
    if (contact.tool == 0) contact_ = contact;
  }
  template <class M>
  std::optional<M> get(const std::optional<M>& newest) const {
    const std::lock_guard lock(mutex_);
    return newest;
  }

  int domain_;
  test::Process node_;
  mutable std::mutex mutex_;
  std::optional<msg::ToolForce> force_;
  std::optional<msg::Contact> contact_;
  Vec3 tip_ = kAbove;
  std::uint64_t seq_ = 0;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::ToolPose>> poses_;
  std::unique_ptr<transport::Writer<msg::SceneInfo>> scenes_;
  std::unique_ptr<transport::Reader<msg::ToolForce>> forces_;
  std::unique_ptr<transport::Reader<msg::Contact>> contacts_;
};

}  // namespace omentum::haptic_test
