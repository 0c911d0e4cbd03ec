// What an assistant who holds the camera is measured by, as data.
#pragma once

#include "geometry/types.h"

#include <cstdint>
#include <optional>
#include <string>

namespace omentum::scene {

/// The target that is to be kept centred and level: another tool's tip, or a place of an organ, which goes
/// with the tissue (docs/score.md).
struct CameraScoreSpec {
  std::optional<std::uint32_t> tool;              // id; none: the organ's place
  std::string organ;                              // its name; empty: the tool's tip
  geometry::Vec3 place = geometry::Vec3::Zero();  // on the organ at rest, in W, m
  double within_deg = 10;  // of the view axis: a third of the way to the picture's edge (62 degree optics)
};

}  // namespace omentum::scene
