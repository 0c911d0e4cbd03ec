// The force that it takes to press a round indenter into an organ, everywhere on its surface.
#pragma once

#include "organ/organ.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace omentum::force_map {

using geometry::SurfaceId;
using geometry::Vec3;

/// A rigid, frictionless ball that goes straight into the surface.
struct Indenter {
  double radius_m = 0.015;  // of a thumb's tip
  double depth_m = 0.005;
};

/// Surface nodes, [S]; SI.
struct PressMap {
  std::vector<double> force_n;         // not a number where nothing can be pressed
  std::vector<std::int32_t> touching;  // nodes that bear it
};

/// Presses along the inward normal at every mobile node of the surface by the organ's own tensors: the ball
/// displaces the nodes under it as far as it must, pushes them only, and only along its way (the normal at
/// its place); the force is the sum. A place cannot be pressed where the ball would have to move what is
/// held. Precondition: the organ has its tensors. Throws geometry::InputError where they are damaged.
PressMap press_everywhere(const organ::Organ& organ, const Indenter& indenter);

/// a over b, [S]; not a number where one is none. Throws geometry::InputError unless both organs have one
/// surface.
std::vector<double> ratio_of(const organ::Organ& a, const PressMap& pressed_a, const organ::Organ& b,
                             const PressMap& pressed_b);

/// Where a map is highest, and how large the part around is that lies above the middle between `level` and
/// there.
struct Peak {
  SurfaceId node;
  double value = 0;
  double area_m2 = 0;         // of the surface above the middle, connected with the node
  double diameter_m() const;  // of the disk of that area
};

/// Of the values at mobile nodes, numbers alone. Nothing where there is none.
std::optional<Peak> peak_of(const organ::Organ& organ, const std::vector<double>& values, double level);

}  // namespace omentum::force_map
