// A bar that is cut through.
#pragma once

#include "tests/physics/dynamics/kept_factor_fixtures.h"

#include <vector>

namespace omentum::test {

/// 12 x 3 x 3 cm, held at x = 0.
inline HeldBody held_bar() {
  return HeldBody(make_box_mesh(12, 3, 3, {0.12, 0.03, 0.03}), 0.01);
}

/// All that lies between two planes across the bar.
inline std::vector<geometry::TetId> slice(const geometry::TetraMesh& mesh, double from, double to) {
  std::vector<geometry::TetId> tetrahedra;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    double x = 0;
    for (const geometry::NodeId n : mesh.tetrahedra[t]) x += mesh.positions[n].x() / 4;
    if (x > from && x < to) tetrahedra.emplace_back(t);
  }
  return tetrahedra;
}

}  // namespace omentum::test
