#include "tests/support/closed_path.h"

#include "geometry/rotation.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace omentum::test {
namespace {

using geometry::Vec3;

constexpr double kHover_m = 2e-3;  // over the highest skin on the way

class Walker {
 public:
  Walker(const haptic::HapticModel& model, const ClosedPath& path)
      : model_(model), state_(model), work_(std::make_unique<haptic::HapticWorkspace>(model)) {
    input_.engaged = true;
    input_.frame = {path.corners()[0], geometry::rotation_onto(Vec3::UnitZ(), path.place.normal)};
    step();
    figures_ = {};
  }
  /// Returns by how much the force changed, N.
  double go(const Vec3& tip) {
    const Vec3 force = output_.force, way = tip - input_.frame.p_WT;
    input_.frame.p_WT = tip;
    step();
    figures_.net_j += 0.5 * (force + output_.force).dot(way);
    figures_.most_put_in_j = std::max(figures_.most_put_in_j, -figures_.net_j);
    figures_.largest_force_n = std::max(figures_.largest_force_n, output_.force.norm());
    return (output_.force - force).norm();
  }
  ClosedPathFigures& figures() { return figures_; }
  const haptic::ToolOutput& output() const { return output_; }

 private:
  void step() {
    const auto result = haptic::haptic_step(model_, {&input_, 1}, state_, *work_, {&output_, 1});
    figures_.unsolved += result.status != physics::ContactStatus::kConverged;
  }

  const haptic::HapticModel& model_;
  haptic::HapticState state_;
  std::unique_ptr<haptic::HapticWorkspace> work_;
  haptic::ToolInput input_;
  haptic::ToolOutput output_;
  ClosedPathFigures figures_;
};

}  // namespace

std::array<Vec3, ClosedPath::kLegs.size() + 1> ClosedPath::corners() const {
  const Vec3 up = (place.rise_m + kHover_m) * place.normal, down = -depth_m * place.normal;
  const Vec3 away = place.slide_m * place.direction(direction_deg);
  const Vec3& p = place.point;
  return {p + up, p + down, p + down + away, p + up + away, p + up};
}

ClosedPathFigures walk(const haptic::HapticModel& model, const ClosedPath& path, double step_m,
                       const std::function<void(const PathPoint&)>& watch) {
  Walker walker(model, path);
  ClosedPathFigures& figures = walker.figures();
  const auto corners = path.corners();
  double way_m = 0;
  for (std::size_t leg = 0; leg < ClosedPath::kLegs.size(); ++leg) {
    const Vec3 whole = corners[leg + 1] - corners[leg];
    const int steps = std::max(1, static_cast<int>(std::ceil(whole.norm() / step_m)));
    for (int i = 1; i <= steps; ++i) {
      const Vec3 tip = corners[leg] + whole * i / steps;
      const double change_n = walker.go(tip);
      if (change_n > figures.largest_step_n) {
        figures.largest_step_n = change_n;
        figures.leg = leg;
        figures.along_m = whole.norm() * i / steps;
      }
      way_m += whole.norm() / steps;
      const double depth_m = (path.place.point - tip).dot(path.place.normal);
      if (watch) watch({way_m, depth_m, tip, walker.output(), figures.net_j});
    }
  }
  return figures;
}

}  // namespace omentum::test
