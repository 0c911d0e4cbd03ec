// Where an organ can be pressed and slid over in every direction, for what measures contact.
#pragma once

#include "haptic_node/haptic_model.h"

#include <optional>

namespace omentum::test {

/// A flat place of the rest surface. Lengths in m, frame W.
struct PressPlace {
  geometry::Vec3 point, normal;   // on the surface; outward, unit
  double slide_m = 0;             // how far every direction stays on the organ
  double rise_m = 0, fall_m = 0;  // of the surface over the plane through the point, along the slides
  double thickness_m = 0;         // of the organ below the point, along the normal

  /// The unit tangent at `degrees` from W's x axis laid into the plane (its y axis where x is the normal).
  geometry::Vec3 direction(double degrees) const;
};

/// The flattest place on the side that `up` (unit) points to, whose surroundings stay free of supports, with
/// slides of `slide_m`, or shorter ones (2 mm at a time) where the organ has none so large. Deterministic.
/// Nothing when the organ is too small for a slide of 4 mm.
std::optional<PressPlace> find_press_place(const haptic::ElasticSurface& organ, const geometry::Vec3& up,
                                           double slide_m);

}  // namespace omentum::test
