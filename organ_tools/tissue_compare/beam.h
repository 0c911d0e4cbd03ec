// A beam whose deformations the continuum answers in closed form.
#pragma once

#include "organ_tools/tissue_compare/laws.h"
#include "physics/supports.h"

#include <vector>

namespace omentum::tissue_compare {

/// Along x from -length/2 to length/2, height (y) and width (z) about zero, of cubes with six tetrahedra
/// each. Neighbouring cubes mirror each other, so that no direction along an axis is another one's inferior.
struct Beam {
  static constexpr int kLengthOverHeight = 3;

  /// `cells`: cubes across its height and its width, at least 2 and even, so that a cut ends at its middle.
  Beam(int cells, const physics::Material& material);

  double length() const { return kLengthOverHeight * height; }
  double volume() const { return length() * height * height; }
  /// Of the cross section about z, m^4.
  double second_moment() const { return height * height * height * height / 12; }
  bool at_end(geometry::NodeId node) const;
  bool on_surface(geometry::NodeId node) const;
  /// Held at its bottom, as an organ on its bed.
  physics::FixedComponents on_bed() const;
  /// The tetrahedra of a slot one cube wide, from the top halfway down.
  std::vector<geometry::TetId> slot() const;

  double height = 0.06;  // m
  double cube;           // edge, m
  physics::Material common;
  Tissue tissue;
};

}  // namespace omentum::tissue_compare
