#include "air_oracle.h"

#include "geometry/closest_points.h"

namespace omentum::haptic_test {

using geometry::SurfaceId;
using geometry::Vec3;

void PlainSurface::deform(std::span<const haptic::NodeForce> forces, std::int32_t without) {
  x_ = organ_.rest;
  for (const haptic::NodeForce& entry : forces) {
    if (entry.tool == without || entry.force.isZero(0)) continue;
    for (SurfaceId n(0); n < organ_.surface.mobile_count; n = SurfaceId(n + 1))
      x_[n] += organ_.compliance.block(n, entry.node) * entry.force;
  }
}

bool PlainSurface::outside(const Vec3& p) const {
  // in a direction that no mesh is aligned with, beyond every organ
  const Vec3 far = p + Vec3(0.5773, 0.3217, 0.7512);
  int crossings = 0;
  for (const geometry::Triangle& t : organ_.surface.triangles)
    crossings += geometry::intersect_segment_triangle(p, far, x_[t[0]], x_[t[1]], x_[t[2]]).has_value();
  return crossings % 2 == 0;
}

bool PlainSurface::clear_of(std::span<const Vec3> points, double margin_m) const {
  Eigen::AlignedBox3d room;
  for (const Vec3& p : points) room.extend(p);
  room.min() -= Vec3::Constant(margin_m), room.max() += Vec3::Constant(margin_m);
  for (const geometry::Triangle& t : organ_.surface.triangles) {
    const Vec3 &a = x_[t[0]], &b = x_[t[1]], &c = x_[t[2]];
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    if (!room.intersects(Eigen::AlignedBox3d(low, high))) continue;
    for (const Vec3& p : points) {
      const double squared = geometry::closest_point_on_triangle(p, a, b, c).squared_distance;
      if (squared <= margin_m * margin_m) return false;
    }
  }
  // no triangle is near: all points are on one side
  return outside(points.front());
}

bool PlainSurface::clear_way(const Vec3& a, const Vec3& b) const {
  for (const geometry::Triangle& t : organ_.surface.triangles)
    if (geometry::intersect_segment_triangle(a, b, x_[t[0]], x_[t[1]], x_[t[2]])) return false;
  return true;
}

AirOracle::Place AirOracle::look(const haptic::HapticState& state, bool feels) {
  const haptic::ToolState& tool = state.tools[tool_];
  without_.deform(state.forces(), tool_);
  if (!without_.clear_of(tool.now, kMargin_m)) return Place::kTissue;
  const Vec3& tip = tool.frame.p_WT;
  if (!feels) {
    free_ = tip;
    return Place::kAir;
  }
  with_.deform(state.forces());
  if (with_.clear_of(tool.now, kMargin_m)) return Place::kAir;
  return free_ && without_.clear_way(*free_, tip) ? Place::kDragged : Place::kTissue;
}

}  // namespace omentum::haptic_test
