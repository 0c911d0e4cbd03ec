#include "organ_tools/force_map/press_map.h"

#include "physics/obstacle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace omentum::force_map {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
// Triangles are cut into so many times so many when their part above a level is measured.
constexpr int kCuts = 8;

class Presser {
 public:
  Presser(const organ::Organ& organ, const Indenter& indenter)
      : organ_(organ),
        indenter_(indenter),
        x_(geometry::surface_positions(organ.mesh, organ.surface)),
        normals_(geometry::surface_normals(organ.surface, x_)) {}

  void press(SurfaceId s, PressMap& map) const {
    const Vec3 n = normals_[s];
    const std::vector<SurfaceId> nodes = under(s);
    const auto count = static_cast<Eigen::Index>(nodes.size());
    Eigen::VectorXd depth(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      depth[i] = needed_depth(nodes[static_cast<std::size_t>(i)], s);
      if (depth[i] > 0 && held_along(nodes[static_cast<std::size_t>(i)], n)) return;
    }
    Eigen::MatrixXd compliance(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index k = 0; k <= i; ++k)
        compliance(i, k) = compliance(k, i) = n.dot(
            organ_.compliance->block(nodes[static_cast<std::size_t>(i)], nodes[static_cast<std::size_t>(k)]) *
            n);
    }
    const auto forces = physics::clear_obstacle(compliance, depth);
    if (!forces)
      throw geometry::InputError(organ_.name +
                                 ": its tensors are damaged: they are not positive definite, or too badly "
                                 "conditioned for this indenter");
    map.force_n[s] = forces->sum();
    map.touching[s] = static_cast<std::int32_t>((forces->array() > 0).count());
  }

 private:
  // Mobile nodes within the ball's shadow that edges connect with s, s first; those that face away are none.
  std::vector<SurfaceId> under(SurfaceId s) const {
    std::vector<SurfaceId> found{s};
    std::vector<SurfaceId> looked{s};
    for (std::size_t next = 0; next < looked.size(); ++next) {
      for (const geometry::TriangleId t : organ_.surface.triangles_of(looked[next])) {
        for (const SurfaceId near : organ_.surface.triangles[t]) {
          if (std::ranges::find(looked, near) != looked.end() || off(near, s) >= indenter_.radius_m ||
              normals_[near].dot(normals_[s]) <= 0)
            continue;
          looked.push_back(near);
          if (!held_along(near, normals_[s]) || needed_depth(near, s) > 0) found.push_back(near);
        }
      }
    }
    return found;
  }

  // From the ball's way, m.
  double off(SurfaceId node, SurfaceId s) const {
    const Vec3 from = x_[node] - x_[s];
    return (from - from.dot(normals_[s]) * normals_[s]).norm();
  }

  // How far the ball pushes a node that nothing else moves, m; negative: how far above it is.
  double needed_depth(SurfaceId node, SurfaceId s) const {
    const double r = off(node, s), R = indenter_.radius_m;
    const double lowest = std::sqrt(std::max(R * R - r * r, 0.0)) - R + indenter_.depth_m;
    return (x_[node] - x_[s]).dot(normals_[s]) + lowest;
  }

  // Nothing of a node's movement is along n.
  bool held_along(SurfaceId node, const Vec3& n) const {
    return node >= organ_.surface.mobile_count || n.dot(organ_.compliance->block(node, node) * n) <= 0;
  }

  const organ::Organ& organ_;
  Indenter indenter_;
  std::vector<Vec3> x_, normals_;
};

double part_above(double a, double b, double c, double level) {
  int above = 0;
  for (int i = 0; i < kCuts; ++i) {
    for (int j = 0; j < kCuts - i; ++j) {
      // the centre of one small triangle, and of the one beside it that points the other way
      const double u = (i + 1.0 / 3) / kCuts, v = (j + 1.0 / 3) / kCuts;
      above += a + u * (b - a) + v * (c - a) > level;
      if (j + 1 == kCuts - i) continue;
      const double w = 1.0 / 3 / kCuts;
      above += a + (u + w) * (b - a) + (v + w) * (c - a) > level;
    }
  }
  return static_cast<double>(above) / (kCuts * kCuts);
}

double area_above(const organ::Organ& organ, const std::vector<double>& values, SurfaceId from,
                  double level) {
  const std::vector<Vec3> x = geometry::surface_positions(organ.mesh, organ.surface);
  std::vector<bool> seen(organ.surface.triangles.size());
  std::vector<SurfaceId> above{from};
  double area = 0;
  for (std::size_t next = 0; next < above.size(); ++next) {
    for (const geometry::TriangleId id : organ.surface.triangles_of(above[next])) {
      if (seen[id]) continue;
      seen[id] = true;
      const geometry::Triangle& t = organ.surface.triangles[id];
      for (const SurfaceId s : t) {
        if (values[s] > level && std::ranges::find(above, s) == above.end()) above.push_back(s);
      }
      const double part = part_above(values[t[0]], values[t[1]], values[t[2]], level);
      area += part * (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).norm() / 2;
    }
  }
  return area;
}

}  // namespace

PressMap press_everywhere(const organ::Organ& organ, const Indenter& indenter) {
  const auto count = static_cast<std::size_t>(organ.surface.node_count());
  PressMap map{std::vector<double>(count, kNothing), std::vector<std::int32_t>(count, 0)};
  const Presser presser(organ, indenter);
  for (std::int32_t s = 0; s < organ.surface.mobile_count; ++s) presser.press(SurfaceId(s), map);
  return map;
}

std::vector<double> ratio_of(const organ::Organ& a, const PressMap& pressed_a, const organ::Organ& b,
                             const PressMap& pressed_b) {
  if (a.surface.triangles != b.surface.triangles ||
      geometry::surface_positions(a.mesh, a.surface) != geometry::surface_positions(b.mesh, b.surface)) {
    throw geometry::InputError(b.name + ": has not the surface of " + a.name +
                               "; expected an organ of the same mesh and supports");
  }
  std::vector<double> ratio;
  for (std::size_t s = 0; s < pressed_a.force_n.size(); ++s)
    ratio.push_back(pressed_a.force_n[s] / pressed_b.force_n[s]);
  return ratio;
}

double Peak::diameter_m() const {
  return 2 * std::sqrt(area_m2 / std::numbers::pi);
}

std::optional<Peak> peak_of(const organ::Organ& organ, const std::vector<double>& values, double level) {
  std::optional<Peak> peak;
  for (std::size_t s = 0; s < values.size(); ++s) {
    if (std::isfinite(values[s]) && (!peak || values[s] > peak->value)) peak = {SurfaceId(s), values[s], 0};
  }
  if (peak) peak->area_m2 = area_above(organ, values, peak->node, (level + peak->value) / 2);
  return peak;
}

}  // namespace omentum::force_map
