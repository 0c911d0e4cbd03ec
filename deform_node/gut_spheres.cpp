#include "deform_node/gut_spheres.h"

#include <algorithm>
#include <cmath>

namespace omentum::deform {

using geometry::Vec3;

GutSpheres::GutSpheres(const geometry::GutShape& shape, std::span<const double> masses_kg,
                       std::size_t most_met) {
  double since_m = 0, carried_kg = 0;  // the last sphere
  for (std::size_t i = 0; i + 1 < static_cast<std::size_t>(shape.layout.columns); ++i) {
    const double length_m = (shape.positions[i + 1] - shape.positions[i]).norm();
    carried_kg += (masses_kg[i] + masses_kg[i + 1]) / 2;
    since_m += length_m;
    const auto count = static_cast<std::size_t>(since_m / shape.tube_radius_m);
    if (count == 0) continue;
    for (std::size_t k = 0; k < count; ++k) {
      places_.push_back({i, (static_cast<double>(k) + 0.5) / static_cast<double>(count)});
      now_.push_back(
          {Vec3::Zero(), Vec3::Zero(), shape.tube_radius_m, carried_kg / static_cast<double>(count)});
    }
    since_m = carried_kg = 0;
  }
  met_.reserve(most_met);
  moving_.reserve(most_met);
}

void GutSpheres::follow(const physics::GutState& state) noexcept {
  for (std::size_t s = 0; s < places_.size(); ++s) {
    const auto [i, at] = places_[s];
    now_[s].centre = (1 - at) * state.x[i] + at * state.x[i + 1];
    now_[s].velocity = (1 - at) * state.v[i] + at * state.v[i + 1];
  }
}

void GutSpheres::meet(std::span<const OrganContact> contacts) noexcept {
  met_.assign(contacts.begin(),
              contacts.begin() + static_cast<std::ptrdiff_t>(std::min(contacts.size(), met_.capacity())));
}

std::span<const physics::MovingSphere> GutSpheres::met(double step_s) noexcept {
  moving_.clear();
  for (const OrganContact& contact : met_) {
    const CollisionSphere& own = now_[static_cast<std::size_t>(contact.sphere)];
    // of the other sphere only its surface counts, and of the overlap this organ's share
    const double apart_m = 2 * own.radius_m - contact.share * contact.depth_m;
    const Vec3 centre = own.centre - apart_m * contact.normal;
    moving_.push_back({centre - step_s * contact.velocity, centre, own.radius_m});
  }
  return moving_;
}

}  // namespace omentum::deform
