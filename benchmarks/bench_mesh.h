// The mesh that benchmarks take where they take one.
#pragma once

#include "tests/support/meshes.h"

#include <cstdlib>

namespace omentum::bench {

/// OMENTUM_BENCH_MESH (a file in millimetres) where it is set; else the 7,185-tetrahedra liver beside the
/// repository; else a box of about its size, 9,438 tetrahedra. Throws geometry::InputError.
inline geometry::TetraMesh bench_mesh() {
  constexpr double kMillimetre = 1e-3;
  const char* chosen = std::getenv("OMENTUM_BENCH_MESH");
  const std::filesystem::path file =
      chosen != nullptr ? chosen : test::data_file("tet/openhelp_liver_7k.msh");
  if (chosen == nullptr && !std::filesystem::exists(file))
    return test::make_box_mesh(13, 11, 11, {0.18, 0.15, 0.15});
  return geometry::check_mesh(geometry::read_mesh(file), kMillimetre).mesh;
}

}  // namespace omentum::bench
