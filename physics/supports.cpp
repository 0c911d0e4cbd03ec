#include "physics/supports.h"

#include <Eigen/Dense>

#include <algorithm>
#include <string>

namespace omentum::physics {

namespace {

// Supports that stop a motion only to this part of what they stop another count as letting it go: a
// factorization in double would keep fewer than four digits of the answer.
constexpr double kLooseMotion = 1e-6;

// For each held component, what each of the six rigid motions does to it: three translations, and three
// rotations about the centroid, scaled by the nodes' size so that all have the unit of length.
Eigen::Matrix<double, 6, 6> rigid_gram(const geometry::TetraMesh& mesh,
                                       std::span<const geometry::NodeId> nodes,
                                       const FixedComponents& fixed) {
  geometry::Vec3 centre = geometry::Vec3::Zero();
  for (const geometry::NodeId n : nodes) centre += mesh.positions[n] / static_cast<double>(nodes.size());
  double radius = 0;
  for (const geometry::NodeId n : nodes) radius = std::max(radius, (mesh.positions[n] - centre).norm());

  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  for (const geometry::NodeId n : nodes) {
    const geometry::Vec3 arm = (mesh.positions[n] - centre) / radius;
    for (int axis = 0; axis < 3; ++axis) {
      if (!is_fixed(fixed[n], axis)) continue;
      const geometry::Vec3 e = geometry::Vec3::Unit(axis);
      Eigen::Matrix<double, 6, 1> row;
      row << e, arm.cross(e);
      gram += row * row.transpose();
    }
  }
  return gram;
}

}  // namespace

std::vector<bool> pinned_nodes(const FixedComponents& fixed) {
  std::vector<bool> pinned(fixed.size());
  for (std::size_t n = 0; n < fixed.size(); ++n) pinned[n] = fixed[n] == kPinned;
  return pinned;
}

FreeDofs free_dofs(const FixedComponents& fixed) {
  FreeDofs free;
  free.index.reserve(3 * fixed.size());
  for (const std::uint8_t components : fixed) {
    for (int axis = 0; axis < 3; ++axis) {
      free.index.push_back(is_fixed(components, axis) ? -1 : free.count++);
    }
  }
  return free;
}

int loose_motions(const geometry::TetraMesh& mesh, std::span<const geometry::NodeId> nodes,
                  const FixedComponents& fixed) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> motions(rigid_gram(mesh, nodes, fixed),
                                                                           Eigen::EigenvaluesOnly);
  // Eigenvalues of the Gram matrix are squares of what the supports feel.
  const double limit = kLooseMotion * kLooseMotion * motions.eigenvalues().maxCoeff();
  return static_cast<int>((motions.eigenvalues().array() <= limit).count());
}

void require_held(const geometry::TetraMesh& mesh, const FixedComponents& fixed) {
  std::vector<geometry::NodeId> nodes;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) nodes.emplace_back(n);
  if (const int loose = loose_motions(mesh, nodes, fixed); loose > 0) {
    throw FloatingError("the supports leave the organ floating: " + std::to_string(loose) +
                        " of its 6 rigid motions meet no support; expected none");
  }
}

}  // namespace omentum::physics
