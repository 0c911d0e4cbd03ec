// Displacements of a mesh as one vector, and what holds for laws that know large ones.
#pragma once

#include "geometry/tetra_mesh.h"
#include "tests/physics/dynamics/force_law_properties.h"

#include <Eigen/Dense>

namespace omentum::test {

using Vector = Eigen::VectorXd;  // [3N]

inline Values values_of(const Vector& vector) {
  return {vector.begin(), vector.end()};
}

inline std::span<const double> view(const Vector& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

inline std::span<double> view(Vector& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}

inline Vector random_vector(Eigen::Index size, double typical, unsigned seed) {
  const Values values = random_values(static_cast<std::size_t>(size), typical, seed);
  return Eigen::Map<const Vector>(values.data(), size);
}

inline Vector rest_positions(const geometry::TetraMesh& mesh) {
  Vector X(3 * static_cast<Eigen::Index>(mesh.positions.size()));
  for (std::size_t n = 0; n < mesh.positions.size(); ++n)
    X.segment<3>(3 * static_cast<Eigen::Index>(n)) = mesh.positions[n];
  return X;
}

/// The displacements that x -> A x + b makes.
inline Vector affine(const geometry::TetraMesh& mesh, const Eigen::Matrix3d& A, const geometry::Vec3& b) {
  const Vector X = rest_positions(mesh);
  Vector u(X.size());
  for (Eigen::Index i = 0; i < X.size(); i += 3) u.segment<3>(i) = A * X.segment<3>(i) + b - X.segment<3>(i);
  return u;
}

inline Vector force_of(physics::ForceLaw& law, const Vector& u) {
  Vector f = Vector::Constant(u.size(), 1e9);  // overwritten, not added to
  law.forces(view(u), view(f));
  return f;
}

/// Below `tolerance` of the forces times the size of all: angular momentum is kept.
inline void expect_no_torque(physics::ForceLaw& law, const geometry::TetraMesh& mesh, const Vector& u,
                             double tolerance) {
  const Vector f = force_of(law, u), x = rest_positions(mesh) + u;
  geometry::Vec3 torque = geometry::Vec3::Zero();
  for (Eigen::Index i = 0; i < f.size(); i += 3)
    torque += geometry::Vec3(x.segment<3>(i)).cross(geometry::Vec3(f.segment<3>(i)));
  EXPECT_LE(torque.norm(), tolerance * f.norm() * x.norm());
}

/// Removed one after the other and added again in another order, the forces are the same to the last bit;
/// with all removed there are none.
inline void expect_adding_undoes_removing(physics::ForceLaw& law, std::size_t tetrahedra, const Vector& u) {
  const Vector before = force_of(law, u);
  for (std::size_t t = 0; t < tetrahedra; ++t) law.remove(geometry::TetId(t));
  EXPECT_EQ(force_of(law, u).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(law.energy(view(u)), 0);
  for (std::size_t t = tetrahedra; t-- > 0;) law.add(geometry::TetId(t));
  EXPECT_EQ((force_of(law, u) - before).cwiseAbs().maxCoeff(), 0);
}

}  // namespace omentum::test
