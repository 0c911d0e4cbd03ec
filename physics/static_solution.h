// Imposed displacements, and what a static solve answers.
#pragma once

#include "geometry/tetra_mesh.h"

#include <vector>

namespace omentum::physics {

/// A node that is held at a given displacement from rest, m.
struct ImposedDisplacement {
  geometry::NodeId node;
  geometry::Vec3 displacement;
};

struct StaticSolution {
  std::vector<geometry::Vec3> displacements;  // [N], m
  std::vector<geometry::Vec3>
      holding_forces;  // one per imposed displacement, N: what holds the node there, in its free
                       // components (the support carries the others: zero here)
};

}  // namespace omentum::physics
