#include "physics/intestine/gut_spheres.h"

#include "geometry/closest_points.h"
#include "geometry/segment_points.h"
#include "physics/intestine/displacement_bound.h"

#include <algorithm>
#include <cmath>

namespace omentum::physics {
namespace {

using geometry::MassId;
using geometry::Vec3;

// A ball's centre as near to a part as this has no direction from it.
constexpr double kTouching_m = 1e-12;

// The part's point that is nearest to p.
GutPoint nearest_on(const GutParts& parts, std::int32_t part, std::span<const Vec3> x, const Vec3& p) {
  const std::array<MassId, 3> m = parts.masses[part];
  if (parts.is_segment(part)) {
    const double t = geometry::closest_points_of_segments(p, p, x[m[0]], x[m[1]]).t;
    return {m, {1 - t, t, 0}};
  }
  const Vec3 weights = geometry::closest_point_on_triangle(p, x[m[0]], x[m[1]], x[m[2]]).barycentric;
  return {m, {weights[0], weights[1], weights[2]}};
}

}  // namespace

GutSpheres::GutSpheres(const GutParts& parts) : parts_(parts) {
  const auto count = static_cast<std::size_t>(parts.count());
  for (auto* of_parts : {&x_, &y_, &z_, &radius_}) of_parts->resize(count);
}

void GutSpheres::look_at(std::span<const Vec3> x) noexcept {
  for (std::int32_t part = 0; part < parts_.count(); ++part) {
    const Ball ball = parts_.ball_around(part, x);
    const auto p = static_cast<std::size_t>(part);
    x_[p] = ball.centre.x();
    y_[p] = ball.centre.y();
    z_[p] = ball.centre.z();
    radius_[p] = ball.radius_m;
  }
}

void GutSpheres::lower_gaps(std::span<const Vec3> x, std::span<const MovingSphere> spheres,
                            std::span<double> gap) const noexcept {
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    const Vec3& centre = spheres[k].before;
    double& own = gap[x.size() + k];
    own = std::max((spheres[k].after - centre).norm() / kShareOfGap, parts_.reach.tube_m);
    for (std::size_t p = 0; p < radius_.size(); ++p) {
      const double far = own + radius_[p];
      const double dx = x_[p] - centre.x(), dy = y_[p] - centre.y(), dz = z_[p] - centre.z();
      if (dx * dx + dy * dy + dz * dz > far * far) continue;
      const GutPoint point = nearest_on(parts_, static_cast<std::int32_t>(p), x, centre);
      const double distance = (place_of(point, x) - centre).norm();
      own = std::min(own, distance);
      for (const MassId m : point.mass) {
        if (m.valid()) gap[m] = std::min(gap[m], distance);
      }
    }
  }
}

std::int64_t GutSpheres::add_contacts(std::span<const Vec3> x, const Vec3& centre, double radius_m,
                                      MassId sphere, std::int32_t key, double skin_m, std::size_t most,
                                      std::vector<GutContact>& contacts,
                                      std::vector<ContactKey>& keys) const noexcept {
  std::int64_t left_out = 0;
  for (std::size_t p = 0; p < radius_.size(); ++p) {
    const auto part = static_cast<std::int32_t>(p);
    const double near = reach_m(part) + radius_m + skin_m, far = near + radius_[p];
    const double dx = x_[p] - centre.x(), dy = y_[p] - centre.y(), dz = z_[p] - centre.z();
    if (dx * dx + dy * dy + dz * dz > far * far) continue;
    GutContact contact;
    contact.one = nearest_on(parts_, part, x, centre);
    const Vec3 between = place_of(contact.one, x) - centre;
    const double distance = between.norm();
    if (distance >= near) continue;
    if (contacts.size() >= most) {
      ++left_out;
      continue;
    }
    contact.other = {{sphere, MassId(), MassId()}, {1, 0, 0}};
    contact.normal = distance > kTouching_m ? Vec3(between / distance) : Vec3::UnitZ();
    contact.reach_m = reach_m(part) + radius_m;
    contacts.push_back(contact);
    keys.push_back({key, part});
  }
  return left_out;
}

}  // namespace omentum::physics
