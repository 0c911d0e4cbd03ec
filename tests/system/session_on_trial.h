// A whole session of real processes on a domain of its own, and an observer of what they say.
#pragma once

#include "transport/bus.h"

#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <Eigen/Core>

#include <cstdlib>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace omentum::test {

using Vendors = std::map<std::string, std::string>;  // process -> vendor

inline Vendors all_on(const std::string& vendor) {
  return {
      {"haptic_node", vendor}, {"deform_node", vendor}, {"render_node", vendor}, {"virtual_device", vendor}};
}

/// A scene made ready by the launcher itself, as a user's would be; its file lies in `folder`. `arguments`:
/// what a user adds, such as --organ FILE. Empty where the launcher refused, with its words as a test
/// failure.
inline std::string prepare_scene(const std::string& scene, std::vector<std::string> arguments,
                                 const std::filesystem::path& folder) {
  const std::string source = OMENTUM_SOURCE_DIR, programs = OMENTUM_BIN_DIR;
  arguments.insert(
      arguments.begin(),
      {"OMENTUM_BIN=" + programs, "OMENTUM_CACHE=" + programs + "/../tests/system/cache", "python3", "-B",
       source + "/launch_scripts/supervisor.py", scene, "--prepare", "--out", folder.string()});
  Process launcher("/usr/bin/env", arguments);
  if (launcher.wait() == 0) return folder / "scene.toml";
  ADD_FAILURE() << launcher.messages();
  return {};
}

/// The scene that most tests share: what the fixture of a whole run prepared, which says so in the
/// environment; a test that is run by hand prepares it again, as its organ may be one of programs that are no
/// more.
inline const std::string& held_scene() {
  static const std::string scene = [] {
    const char* const prepared = std::getenv("OMENTUM_HELD_SCENE");
    return prepared != nullptr
               ? std::string(prepared)
               : prepare_scene(OMENTUM_SOURCE_DIR "/tests/system/hold.toml", {}, OMENTUM_HELD_FOLDER);
  }();
  return scene;
}

/// Starts processes by name and keeps them until the end. Arguments beyond the shared ones come with start().
class SessionOnTrial {
 public:
  SessionOnTrial(std::string scene, Vendors vendors)
      : scene_(std::move(scene)), vendors_(std::move(vendors)), domain_(domain_of_test()) {}

  int domain() const { return domain_; }
  std::string report_of(const std::string& name) const { return folder_ / (name + ".json"); }

  Process& start(const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"--scene",         scene_,         "--dds",
                                          vendors_.at(name), "--domain",     std::to_string(domain_),
                                          "--report",        report_of(name)};
    if (name == "render_node")
      arguments.insert(arguments.end(), {"--headless", "--out", folder_.path().string()});
    arguments.insert(arguments.end(), more.begin(), more.end());
    processes_[name] = std::make_unique<Process>(name, arguments);
    return *processes_[name];
  }
  void start_all(const std::vector<std::string>& names) {
    for (const std::string& name : names) start(name);
  }
  Process& operator[](const std::string& name) { return *processes_.at(name); }
  /// From its next start on.
  void set_vendor(const std::string& name, const std::string& vendor) { vendors_[name] = vendor; }
  void kill(const std::string& name) { processes_.at(name)->end(SIGKILL); }

  /// A person's command, through the real program. Its exit code.
  int command(const std::string& word) {
    Process session("omentum_session", {word, "--domain", std::to_string(domain_)});
    return session.wait();
  }

 private:
  ScratchFolder folder_;
  std::string scene_;
  Vendors vendors_;
  int domain_;
  std::map<std::string, std::unique_ptr<Process>> processes_;
};

/// What one tool felt, told and did, newest last; at most kKept of each.
class Observer {
 public:
  Observer(int domain, transport::Vendor vendor)
      : bus_(transport::Bus::open({.vendor = vendor, .domain = domain, .name = "observer"})),
        force_reader_(bus_->reader<msg::ToolForce>([this](const msg::ToolForce& m) { keep(forces_, m); })),
        contact_reader_(bus_->reader<msg::Contact>([this](const msg::Contact& m) { keep(contacts_, m); })),
        state_reader_(bus_->reader<msg::OrganState>([this](const msg::OrganState& m) { keep(states_, m); })),
        pose_reader_(bus_->reader<msg::ToolPose>([this](const msg::ToolPose& m) { keep(poses_, m); })),
        status_reader_(
            bus_->reader<msg::NodeStatus>([this](const msg::NodeStatus& m) { keep(statuses_, m); })) {}

  std::vector<msg::ToolForce> forces() { return all(forces_); }
  std::vector<msg::Contact> contacts() { return all(contacts_); }
  std::vector<msg::OrganState> states() { return all(states_); }

  std::optional<msg::ToolForce> force(std::uint32_t tool = 0) {
    return newest(forces_, [tool](const auto& m) { return m.tool == tool; });
  }
  std::optional<msg::ToolPose> pose(std::uint32_t tool = 0) {
    return newest(poses_, [tool](const auto& m) { return m.tool == tool; });
  }
  std::optional<msg::OrganState> state() {
    return newest(states_, [](const auto&) { return true; });
  }
  std::optional<msg::NodeStatus> status(std::uint32_t kind) {
    return newest(statuses_, [kind](const auto& m) { return m.kind == kind; });
  }
  std::vector<msg::NodeStatus> statuses(std::uint32_t kind) {
    auto kept = all(statuses_);
    std::erase_if(kept, [kind](const auto& m) { return m.kind != kind; });
    return kept;
  }
  void forget() {
    const std::lock_guard lock(mutex_);
    forces_.clear(), contacts_.clear(), states_.clear(), poses_.clear(), statuses_.clear();
  }

  /// Newton, metres: of the newest sample; 0 when none came.
  double force_n(std::uint32_t tool = 0) {
    const auto sample = force(tool);
    return sample ? Eigen::Vector3d(sample->force.x, sample->force.y, sample->force.z).norm() : 0;
  }
  double dent_m() {
    const auto sample = state();
    double largest = 0;
    if (sample)
      for (const float u : sample->values) largest = std::max(largest, std::abs(static_cast<double>(u)));
    return largest;
  }

 private:
  static constexpr std::size_t kKept = 6000;  // three seconds of two tools at 1 kHz

  template <class M>
  void keep(std::deque<M>& list, const M& sample) {
    const std::lock_guard lock(mutex_);
    list.push_back(sample);
    if (list.size() > kKept) list.pop_front();
  }
  template <class M>
  std::vector<M> all(const std::deque<M>& list) {
    const std::lock_guard lock(mutex_);
    return {list.begin(), list.end()};
  }
  template <class M, class Which>
  std::optional<M> newest(const std::deque<M>& list, Which&& which) {
    const std::lock_guard lock(mutex_);
    for (auto m = list.rbegin(); m != list.rend(); ++m)
      if (which(*m)) return *m;
    return std::nullopt;
  }

  std::mutex mutex_;
  std::deque<msg::ToolForce> forces_;
  std::deque<msg::Contact> contacts_;
  std::deque<msg::OrganState> states_;
  std::deque<msg::ToolPose> poses_;
  std::deque<msg::NodeStatus> statuses_;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Reader<msg::ToolForce>> force_reader_;
  std::unique_ptr<transport::Reader<msg::Contact>> contact_reader_;
  std::unique_ptr<transport::Reader<msg::OrganState>> state_reader_;
  std::unique_ptr<transport::Reader<msg::ToolPose>> pose_reader_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> status_reader_;
};

}  // namespace omentum::test
