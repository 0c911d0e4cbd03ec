#include "physics/stiffness.h"

#include <algorithm>
#include <map>

namespace omentum::physics {

namespace {

// Tetrahedra around each node, compressed: those of node n are tets[start[n]] .. tets[start[n+1]].
struct Stars {
  std::vector<std::int32_t> start;
  std::vector<std::int32_t> tets;
};

Stars stars_of(const geometry::TetraMesh& mesh) {
  Stars stars;
  stars.start.assign(mesh.positions.size() + 1, 0);
  for (const auto& tet : mesh.tetrahedra) {
    for (const NodeId n : tet) ++stars.start[n + 1];
  }
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) stars.start[n + 1] += stars.start[n];
  stars.tets.resize(4 * mesh.tetrahedra.size());
  std::vector<std::int32_t> next(stars.start.begin(), stars.start.end() - 1);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    for (const NodeId n : mesh.tetrahedra[t]) stars.tets[next[n]++] = static_cast<std::int32_t>(t);
  }
  return stars;
}

// The pattern: who shares a tetrahedron with whom.
Stiffness empty_stiffness(const geometry::TetraMesh& mesh) {
  const Stars stars = stars_of(mesh);
  Stiffness K;
  K.start.push_back(0);
  std::vector<NodeId> row;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    row.clear();
    for (std::int32_t s = stars.start[n]; s < stars.start[n + 1]; ++s) {
      const auto& tet = mesh.tetrahedra[stars.tets[s]];
      row.insert(row.end(), tet.begin(), tet.end());
    }
    std::ranges::sort(row);
    row.erase(std::unique(row.begin(), row.end()), row.end());
    K.neighbour.insert(K.neighbour.end(), row.begin(), row.end());
    K.start.push_back(static_cast<std::int32_t>(K.neighbour.size()));
  }
  K.block.assign(K.neighbour.size(), Eigen::Matrix3d::Zero());
  return K;
}

// Of each node among the added ones; -1: none of them.
std::vector<std::int32_t> places_in(const AddedStiffness& added, std::int32_t node_count) {
  std::vector<std::int32_t> place(static_cast<std::size_t>(node_count), -1);
  for (std::size_t k = 0; k < added.nodes.size(); ++k) place[added.nodes[k]] = static_cast<std::int32_t>(k);
  return place;
}

}  // namespace

Stiffness assemble_stiffness(const geometry::TetraMesh& mesh, const MaterialMap& material) {
  Stiffness K = empty_stiffness(mesh);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const geometry::TetId id(t);
    const ElementTensors element = element_tensors(corners_of(mesh, id), material.of(mesh, id));
    const auto& tet = mesh.tetrahedra[t];
    for (int j = 0; j < 4; ++j) {
      const auto row = K.neighbour.begin() + K.start[tet[j]];
      const auto row_end = K.neighbour.begin() + K.start[tet[j] + 1];
      for (int k = 0; k < 4; ++k) {
        K.block[std::lower_bound(row, row_end, tet[k]) - K.neighbour.begin()] += element[j][k];
      }
    }
  }
  return K;
}

Stiffness with_added(const Stiffness& stiffness, const AddedStiffness& added) {
  if (added.nodes.empty()) return stiffness;
  const std::vector<std::int32_t> place = places_in(added, stiffness.node_count());
  Stiffness sum;
  sum.start.push_back(0);
  for (std::int32_t n = 0; n < stiffness.node_count(); ++n) {
    std::map<NodeId, Eigen::Matrix3d> row;
    for (std::int32_t b = stiffness.start[n]; b < stiffness.start[n + 1]; ++b)
      row.emplace(stiffness.neighbour[b], stiffness.block[b]);
    for (std::size_t k = 0; place[n] >= 0 && k < added.nodes.size(); ++k)
      row.try_emplace(added.nodes[k], Eigen::Matrix3d::Zero()).first->second +=
          added.K.block<3, 3>(3 * place[n], 3 * static_cast<Eigen::Index>(k));
    for (const auto& [neighbour, block] : row) {
      sum.neighbour.push_back(neighbour);
      sum.block.push_back(block);
    }
    sum.start.push_back(static_cast<std::int32_t>(sum.neighbour.size()));
  }
  return sum;
}

std::vector<Vec3> holding_forces(const Stiffness& stiffness, std::span<const Vec3> displacements) {
  std::vector<Vec3> forces(displacements.size(), Vec3::Zero());
  for (std::int32_t n = 0; n < stiffness.node_count(); ++n) {
    for (std::int32_t b = stiffness.start[n]; b < stiffness.start[n + 1]; ++b) {
      forces[n] += stiffness.block[b] * displacements[stiffness.neighbour[b]];
    }
  }
  return forces;
}

std::vector<Vec3> body_forces(const geometry::TetraMesh& mesh, const MaterialMap& material,
                              const Vec3& acceleration) {
  std::vector<Vec3> forces(mesh.positions.size(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const geometry::TetId id(t);
    const Corners c = corners_of(mesh, id);
    const double mass = material.of(mesh, id).density_kg_m3 * geometry::signed_volume(c[0], c[1], c[2], c[3]);
    for (const NodeId n : mesh.tetrahedra[t]) forces[n] += mass / 4 * acceleration;
  }
  return forces;
}

}  // namespace omentum::physics
