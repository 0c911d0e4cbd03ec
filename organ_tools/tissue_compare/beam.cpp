#include "organ_tools/tissue_compare/beam.h"

#include <algorithm>
#include <cmath>

namespace omentum::tissue_compare {

namespace {

using geometry::Vec3;
using Triple = std::array<int, 3>;

int node_number(const Triple& at, const Triple& cells) {
  return at[0] + (cells[0] + 1) * (at[1] + (cells[1] + 1) * at[2]);
}

// Corners of a cube, x in bit 0, y in bit 1, z in bit 2: a regular tetrahedron, and one at each corner it
// leaves.
constexpr int kTetrahedra[5][4] = {{0, 5, 3, 6}, {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 0, 6, 5}, {7, 3, 5, 6}};

// An odd cube is an even one's mirror image, so that both sides of a face cut it alike.
void add_cube(geometry::RawMesh& raw, const Triple& cube, const Triple& cells) {
  const bool odd = (cube[0] + cube[1] + cube[2]) % 2 != 0;
  for (const auto& tetrahedron : kTetrahedra) {
    std::array<std::int32_t, 4> corners;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const int bits = tetrahedron[c] ^ (odd ? 1 : 0);
      corners[c] =
          node_number({cube[0] + (bits & 1), cube[1] + (bits >> 1 & 1), cube[2] + (bits >> 2 & 1)}, cells);
    }
    if (odd) std::swap(corners[2], corners[3]);
    raw.tetrahedra.push_back(corners);
  }
}

geometry::TetraMesh beam_mesh(const Triple& cells, double cube) {
  geometry::RawMesh raw;
  raw.source = "beam";
  const Vec3 middle(cells[0] / 2.0, cells[1] / 2.0, cells[2] / 2.0);
  for (int k = 0; k <= cells[2]; ++k) {
    for (int j = 0; j <= cells[1]; ++j) {
      for (int i = 0; i <= cells[0]; ++i) raw.positions.emplace_back(cube * (Vec3(i, j, k) - middle));
    }
  }
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) add_cube(raw, {i, j, k}, cells);
    }
  }
  return geometry::check_mesh(raw, 1).mesh;
}

}  // namespace

Beam::Beam(int cells, const physics::Material& material)
    : cube(height / cells),
      common(material),
      tissue{beam_mesh({kLengthOverHeight * cells, cells, cells}, cube), material} {}

bool Beam::at_end(geometry::NodeId node) const {
  return std::abs(tissue.mesh.positions[node].x()) > (length() - cube) / 2;
}

bool Beam::on_surface(geometry::NodeId node) const {
  const Vec3 p = tissue.mesh.positions[node].cwiseAbs();
  return at_end(node) || std::max(p.y(), p.z()) > (height - cube) / 2;
}

physics::FixedComponents Beam::on_bed() const {
  physics::FixedComponents fixed(tissue.mesh.positions.size(), 0);
  for (std::size_t n = 0; n < fixed.size(); ++n) {
    if (tissue.mesh.positions[geometry::NodeId(n)].y() < (cube - height) / 2) fixed[n] = physics::kPinned;
  }
  return fixed;
}

std::vector<geometry::TetId> Beam::slot() const {
  std::vector<geometry::TetId> found;
  for (std::size_t t = 0; t < tissue.mesh.tetrahedra.size(); ++t) {
    Vec3 centre = Vec3::Zero();
    for (const geometry::NodeId n : tissue.mesh.tetrahedra[t]) centre += tissue.mesh.positions[n] / 4;
    if (centre.x() > 0 && centre.x() < cube && centre.y() > 0) found.emplace_back(t);
  }
  return found;
}

}  // namespace omentum::tissue_compare
