// Meshes that tests build or read.
#pragma once

#include "geometry/tetra_mesh.h"

#include <algorithm>
#include <filesystem>

namespace omentum::test {

/// A file of the real data beside the repository, which may be absent: test it with std::filesystem::exists
/// and GTEST_SKIP() then. `name` is relative, such as "tet/openhelp_liver_7k.msh".
inline std::filesystem::path data_file(const std::string& name) {
  return std::filesystem::path(OMENTUM_SOURCE_DIR) / ".." / "shared" / "data" / name;
}

/// The box [0,x] x [0,y] x [0,z] m of nx x ny x nz cubes with six tetrahedra each (Kuhn's subdivision: all
/// share the cube's main diagonal, so that neighbours match). Node (i,j,k) has number i + (nx+1) (j + (ny+1)
/// k).
inline geometry::RawMesh make_raw_box(int nx, int ny, int nz, const geometry::Vec3& size) {
  geometry::RawMesh raw;
  raw.source = "box";
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) {
        raw.positions.emplace_back(size.x() * i / nx, size.y() * j / ny, size.z() * k / nz);
      }
    }
  }
  const std::array<int, 3> stride = {1, nx + 1, (nx + 1) * (ny + 1)};
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        // each order of the axes is a path along three edges from one end of the diagonal to the other
        std::array<int, 3> axes = {0, 1, 2};
        do {
          const int a = i * stride[0] + j * stride[1] + k * stride[2];
          const int b = a + stride[axes[0]], c = b + stride[axes[1]], d = c + stride[axes[2]];
          const bool even = (axes[1] - axes[0] + 3) % 3 == 1;
          raw.tetrahedra.push_back(even ? std::array{a, b, c, d} : std::array{a, b, d, c});
        } while (std::next_permutation(axes.begin(), axes.end()));
      }
    }
  }
  return raw;
}

/// The same, checked.
inline geometry::TetraMesh make_box_mesh(int nx, int ny, int nz, const geometry::Vec3& size) {
  return geometry::check_mesh(make_raw_box(nx, ny, nz, size), 1.0).mesh;
}

}  // namespace omentum::test
