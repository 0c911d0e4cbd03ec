// The real haptic_node on a domain of its own, and a device of the test's.
#pragma once

#include "node_common/loaded_scene.h"
#include "organ/organ.h"
#include "runtime/clock.h"
#include "transport/bus.h"

#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <mutex>
#include <optional>

namespace omentum::haptic_test {

using geometry::Vec3;

// Forces leave as doubles; contacts' forces are summed again here.
inline constexpr double kRelative = 1e-9;
// From when on a node is not moved by newcomers (node/rivals.h), and a second more.
inline constexpr double kSettled_s = 6;
// A node's instance is its start in ns; the test's own, on the wire only, have small ones.
inline constexpr std::uint64_t kForgedInstances = 1000;

/// A block of 10 cm, held at z = 0, one probe and one grasper.
class BlockScene {
 public:
  BlockScene() {
    geometry::write_mesh(test::make_box_mesh(6, 6, 6, Vec3::Constant(0.1)), folder_ / "block.msh");
    test::Process build("organ_build",
                        {folder_ / "block.msh", "-o", folder_ / "block.h5", "--young", "10000", "--poisson",
                         "0.4", "--density", "1000", "--scale", "1", "--fixed", "plane:z<0.001"});
    if (build.wait() != 0) throw std::runtime_error(build.messages());
    std::ofstream(folder_ / "scene.toml")
        << "name = \"a block\"\n"
           "[[organs]]\nname = \"block\"\nmesh = \"block.msh\"\nfile = \"block.h5\"\n"
           "young_pa = 10000\npoisson = 0.4\ndensity_kg_m3 = 1000\nfixed = \"plane:z<0.001\"\n"
           "[[tools]]\nid = 0\nname = \"probe\"\nshape = \"probe\"\npoints = [[0,0,0], [0.003,0,0.001]]\n"
           "[[tools]]\nid = 3\nname = \"grasper\"\nshape = \"grasper\"\npoints = [[0,0,0]]\n";
  }
  std::string scene() const { return folder_ / "scene.toml"; }
  std::string report() const { return folder_ / "report.json"; }
  /// What a deform_node tells that serves this scene with the organ file of that hash.
  msg::SceneInfo info(const std::string& organ_hash) const {
    const scene::Scene loaded = scene::load_scene(scene());
    return node::to_message(node::loaded_scene(loaded, {{.name = "block", .hash = organ_hash}}), loaded.name);
  }
  std::string organ_hash() const {
    return organ::load_organ(folder_ / "block.h5", organ::Load::kMeshOnly).hash;
  }

 private:
  test::ScratchFolder folder_;
};

inline Vec3 vector(const msg::Vec3& v) {
  return {v.x, v.y, v.z};
}

/// haptic_node, and a device of this test's own.
class NodeBench {
 public:
  NodeBench(const BlockScene& scene, const std::string& node_vendor, transport::Vendor own,
            int rate_hz = 1000)
      : scene_(scene),
        vendor_(node_vendor),
        rate_hz_(rate_hz),
        domain_(test::domain_of_test()),
        node_("haptic_node", arguments(scene.report())),
        bus_(transport::Bus::open({.vendor = own, .domain = domain_, .name = "test"})),
        poses_(bus_->writer<msg::ToolPose>()),
        devices_(bus_->writer<msg::DeviceInfo>()),
        commands_(bus_->writer<msg::SessionCommand>()),
        scenes_(bus_->writer<msg::SceneInfo>()),
        others_(bus_->writer<msg::NodeStatus>()),
        forces_(bus_->reader<msg::ToolForce>([this](const msg::ToolForce& f) { take(f); })),
        contacts_(bus_->reader<msg::Contact>([this](const msg::Contact& c) { take(c); })),
        statuses_(bus_->reader<msg::NodeStatus>([this](const msg::NodeStatus& s) { take(s); })) {}

  std::vector<std::string> arguments(const std::string& report) const {
    return {"--scene",   scene_.scene(),          "--dds",    vendor_,
            "--domain",  std::to_string(domain_), "--report", report,
            "--rate-hz", std::to_string(rate_hz_)};
  }

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
    std::this_thread::sleep_for(std::chrono::microseconds(1'000'000 / rate_hz_));
  }
  void send(const msg::ToolPose& pose) { poses_->write(pose); }
  void send(const msg::DeviceInfo& info) { devices_->write(info); }
  void send(const msg::SceneInfo& info) { scenes_->write(info); }
  void send(const msg::NodeStatus& status) { others_->write(status); }
  void command(std::uint32_t command) {
    commands_->write({.order = ++commands_sent_, .sender = 1, .command = command, .argument = {}});
  }

  /// Presses, or goes on pressing, until an answer is as `felt` says. A tip that a busy machine made the node
  /// lose is held where it is, without a force: it goes out and presses again.
  template <class Condition>
  bool press(Condition&& felt) {
    return test::comes_true([&] { return go_in() && (feels(felt) || go_out()); });
  }
  /// The forces of a press have faded in.
  bool press() {
    return press([&] { return is_pressing(); });
  }
  /// Whether one and the same press goes on after `event`, which says whether it happened. Where a busy
  /// machine may have ended the press, it happens to another one.
  template <class Event>
  bool press_outlives(Event&& event) {
    return test::comes_true(
        [&] { return press() && event() && (feels([&] { return is_pressing(); }) || go_out()); });
  }

  std::optional<msg::ToolForce> force() const { return get(force_); }
  std::optional<msg::Contact> contact() const { return get(contact_); }
  std::optional<msg::NodeStatus> status() const { return get(status_); }
  /// The fault that the node tells and that begins so, with how often it came; empty when there is none.
  std::string fault(const std::string& text) const {
    const auto told = status();
    if (!told) return {};
    const auto found = std::find_if(told->faults.begin(), told->faults.end(),
                                    [&](const std::string& line) { return line.starts_with(text); });
    return found == told->faults.end() ? std::string() : *found;
  }
  bool status_fault(const std::string& text) const { return !fault(text).empty(); }
  double newton() const { return force() ? vector(force()->force).norm() : 0; }
  std::uint64_t seq() const { return seq_; }
  test::Process& node() { return node_; }
  int domain() const { return domain_; }

  // of the tip: over the block, and 6 mm in it
  inline static const Vec3 kAbove{0.048, 0.053, 0.103}, kPressed{0.048, 0.053, 0.094};

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
  bool is_pressing() const {
    constexpr double kFelt_n = 0.1;
    const auto newest = force();
    return newest->state == 0 && vector(newest->force).norm() > kFelt_n;
  }

  void take(const msg::ToolForce& force) {
    const std::lock_guard lock(mutex_);
    if (force.tool == 0) force_ = force;
  }
  void take(const msg::Contact& contact) {
    const std::lock_guard lock(mutex_);
    if (contact.tool == 0) contact_ = contact;
  }
  void take(const msg::NodeStatus& status) {
    const std::lock_guard lock(mutex_);
    if (status.kind == msg::NODE_HAPTIC && status.instance > kForgedInstances) status_ = status;
  }
  template <class M>
  std::optional<M> get(const std::optional<M>& newest) const {
    const std::lock_guard lock(mutex_);
    return newest;
  }

  const BlockScene& scene_;
  std::string vendor_;
  int rate_hz_, domain_;
  test::Process node_;
  mutable std::mutex mutex_;
  std::optional<msg::ToolForce> force_;
  std::optional<msg::Contact> contact_;
  std::optional<msg::NodeStatus> status_;
  Vec3 tip_ = kAbove;
  std::uint64_t seq_ = 0, commands_sent_ = 0;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::ToolPose>> poses_;
  std::unique_ptr<transport::Writer<msg::DeviceInfo>> devices_;
  std::unique_ptr<transport::Writer<msg::SessionCommand>> commands_;
  std::unique_ptr<transport::Writer<msg::SceneInfo>> scenes_;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> others_;
  std::unique_ptr<transport::Reader<msg::ToolForce>> forces_;
  std::unique_ptr<transport::Reader<msg::Contact>> contacts_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> statuses_;
};

}  // namespace omentum::haptic_test
