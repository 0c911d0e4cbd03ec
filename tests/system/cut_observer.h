// What tests of real sessions hear of cuts, and what they ask of forces while processes come and go.
#pragma once

#include "tests/system/session_on_trial.h"

#include <algorithm>
#include <bit>
#include <iterator>

namespace omentum::test {

/// The topologies of an organ, newest last.
class CutObserver {
 public:
  explicit CutObserver(int domain)
      : bus_(transport::Bus::open(
            {.vendor = transport::Vendor::kCyclone, .domain = domain, .name = "cut observer"})),
        reader_(bus_->reader<msg::Topology>([this](const msg::Topology& heard) {
          const std::lock_guard lock(mutex_);
          heard_.push_back(heard);
        })) {}

  /// Since the last time.
  std::vector<msg::Topology> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(heard_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<msg::Topology> heard_;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Reader<msg::Topology>> reader_;
};

inline int removed(const msg::Topology& topology) {
  int count = 0;
  for (const std::uint8_t bits : topology.removed_bits) count += std::popcount(bits);
  return count;
}

inline bool holds_all(const msg::Topology& topology, const msg::Topology& earlier) {
  return std::ranges::equal(topology.removed_bits, earlier.removed_bits,
                            [](unsigned now, unsigned before) { return (before & ~now) == 0; });
}

/// The largest change of the force on a hand, as a multiple of what the slew limit lets it change in the
/// ticks between two samples.
inline double steepest(const std::vector<msg::ToolForce>& of_all_hands, std::uint32_t tool) {
  constexpr double kSlew_n_per_tick = 2000 * 0.001;  // scene::HapticsSpec's own, at its own rate
  std::vector<msg::ToolForce> forces;
  std::ranges::copy_if(of_all_hands, std::back_inserter(forces),
                       [tool](const msg::ToolForce& force) { return force.tool == tool; });
  double most = 0;
  for (std::size_t i = 1; i < forces.size(); ++i) {
    const msg::Vec3 &now = forces[i].force, &before = forces[i - 1].force;
    const double change_n = Eigen::Vector3d(now.x - before.x, now.y - before.y, now.z - before.z).norm();
    if (forces[i].tick > forces[i - 1].tick)
      most = std::max(
          most, change_n / (kSlew_n_per_tick * static_cast<double>(forces[i].tick - forces[i - 1].tick)));
  }
  return most;
}

}  // namespace omentum::test
