// An intestine as other organs meet it.
#pragma once

#include "deform_node/organ_contact.h"
#include "geometry/gut_shape.h"
#include "physics/intestine/gut_obstacle.h"
#include "physics/intestine/gut_state.h"

#include <span>
#include <vector>

namespace omentum::deform {

/// Spheres along the axis, about a radius of the tube apart, each with its share of the gut's mass. What they
/// met in a tick acts in the next step, as spheres that move into their way by the gut's share of the
/// overlap, so that momentum stays with both organs together.
class GutSpheres {
 public:
  /// `masses_kg`: [masses]. `most_met`: of one tick; what comes beyond is left out.
  GutSpheres(const geometry::GutShape& shape, std::span<const double> masses_kg, std::size_t most_met);

  /// Follows the masses.
  void follow(const physics::GutState& state) noexcept;
  std::span<const CollisionSphere> now() const noexcept { return now_; }

  void meet(std::span<const OrganContact> contacts) noexcept;
  void forget() noexcept { met_.clear(); }
  /// What the next step of `step_s` has to do with.
  std::span<const physics::MovingSphere> met(double step_s) noexcept;

 private:
  struct Place {
    std::size_t segment = 0;  // of the axis
    double at = 0;            // along it, 0 to 1
  };

  std::vector<Place> places_;         // [spheres]
  std::vector<CollisionSphere> now_;  // [spheres]
  std::vector<OrganContact> met_;     // capacity most_met
  std::vector<physics::MovingSphere> moving_;
};

}  // namespace omentum::deform
