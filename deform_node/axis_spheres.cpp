#include "deform_node/axis_spheres.h"

#include <cmath>
#include <limits>

namespace omentum::deform {

using geometry::Vec3;

AxisSpheres::AxisSpheres(const geometry::GutShape& shape, std::span<const double> masses_kg) {
  const geometry::GutLayout& layout = shape.layout;
  double since_m = 0, carried_kg = 0;  // the last sphere
  for (std::int32_t s = 0; s < layout.segment_count(); ++s) {
    const auto i = static_cast<std::size_t>(s);
    const double length_m = (shape.positions[i + 1] - shape.positions[i]).norm();
    carried_kg += (masses_kg[i] + masses_kg[i + 1]) / 2;
    since_m += length_m;
    const double count = std::floor(since_m / shape.tube_radius_m);
    if (count < 1) continue;
    const auto [one, other] = layout.segment(s);
    const bool is_held = layout.is_held(one) && layout.is_held(other);
    for (double k = 0; k < count; ++k) {
      places_.push_back({i, (k + 0.5) / count});
      shown_.push_back({.radius_m = shape.tube_radius_m,
                        .mass_kg = is_held ? std::numeric_limits<double>::infinity() : carried_kg / count});
    }
    since_m = carried_kg = 0;
  }
}

std::span<const CollisionSphere> AxisSpheres::follow(std::span<const Vec3> x,
                                                     std::span<const Vec3> v) noexcept {
  for (std::size_t s = 0; s < places_.size(); ++s) {
    const auto [i, at] = places_[s];
    shown_[s].centre = (1 - at) * x[i] + at * x[i + 1];
    shown_[s].velocity = (1 - at) * v[i] + at * v[i + 1];
  }
  return shown_;
}

void AxisSpheres::push(std::span<const OrganContact> contacts, std::span<Vec3> impulses) const noexcept {
  for (const OrganContact& contact : contacts) {
    const auto s = static_cast<std::size_t>(contact.sphere);
    if (std::isinf(shown_[s].mass_kg)) continue;
    const Vec3 impulse = shown_[s].mass_kg * answer(contact, shown_[s].velocity);
    const auto [i, at] = places_[s];
    impulses[i] += (1 - at) * impulse;
    impulses[i + 1] += at * impulse;
  }
}

}  // namespace omentum::deform
