#include "physics/dynamics/tensor_mass.h"

#include "physics/dynamics/body_state.h"
#include "physics/stiffness.h"
#include "tests/physics/dynamics/force_law_properties.h"
#include "tests/physics/dynamics/tensor_tissue.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>

namespace omentum::physics {
namespace {

using Arithmetic = TensorMass::Arithmetic;

// lambda and mu far apart, so that a transposed tensor shows.
constexpr double kRounding = 1e-12;  // relative: sums of a few hundred tensors in double
constexpr double kDisplacement_m = 1e-3;

std::vector<double> rotated(const geometry::TetraMesh& mesh, const Vec3& axis) {
  std::vector<double> u;
  for (const Vec3& p : mesh.positions) {
    const Vec3 arm = axis.cross(p);
    u.insert(u.end(), arm.begin(), arm.end());
  }
  return u;
}

class TensorMassTest : public testing::TestWithParam<Arithmetic> {
 protected:
  const geometry::TetraMesh mesh = test::make_box_mesh(4, 3, 5, {0.04, 0.03, 0.05});
  const double rounding = GetParam() == Arithmetic::kFloat ? kFloatRounding : kRounding;
  TensorMass law{mesh, kMaterial, GetParam()};

  std::vector<double> displacements(unsigned seed = 7) const {
    return test::random_values(3 * mesh.positions.size(), kDisplacement_m, seed);
  }
};

INSTANTIATE_TEST_SUITE_P(In, TensorMassTest, testing::Values(Arithmetic::kFloat, Arithmetic::kDouble),
                         [](const auto& test) {
                           return test.param == Arithmetic::kFloat ? "Float" : "Double";
                         });

TEST_P(TensorMassTest, ForceIsMinusGradientOfEnergy) {
  test::expect_force_is_minus_gradient(law, displacements(), kDisplacement_m, 10 * rounding);
}

TEST_P(TensorMassTest, ForceIsThatOfAssembledStiffness) {
  const Stiffness K = assemble_stiffness(mesh, kMaterial);
  const std::vector<double> u = displacements();
  std::vector<Vec3> moved(mesh.positions.size());
  for (std::size_t n = 0; n < moved.size(); ++n) moved[n] = {u[3 * n], u[3 * n + 1], u[3 * n + 2]};

  const std::vector<Vec3> held = holding_forces(K, moved);
  const std::vector<double> f = test::forces_of(law, u);

  for (std::size_t n = 0; n < moved.size(); ++n) {
    const Vec3 own(f[3 * n], f[3 * n + 1], f[3 * n + 2]);
    EXPECT_LE((own + held[n]).norm(), 10 * rounding * held[n].norm()) << n;
  }
}

TEST_P(TensorMassTest, StiffnessIsSymmetric) {
  const std::vector<double> a = displacements(1), b = displacements(2);
  const std::vector<double> f_a = test::forces_of(law, a), f_b = test::forces_of(law, b);
  EXPECT_NEAR(test::dot(a, f_b), test::dot(b, f_a), 10 * rounding * test::norm(a) * test::norm(f_b));
}

TEST_P(TensorMassTest, TranslationGivesNoForceAtAll) {
  std::vector<double> u(3 * mesh.positions.size());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = i % 3 == 0 ? 0.1 : -0.03;
  const std::vector<double> f = test::forces_of(law, u);
  EXPECT_EQ(*std::ranges::max_element(f), 0);
  EXPECT_EQ(*std::ranges::min_element(f), 0);
}

TEST_P(TensorMassTest, InfinitesimalRotationGivesNoForce) {
  test::expect_no_force(law, rotated(mesh, {0.04, -0.07, 0.02}), 10 * rounding);
}

TEST_P(TensorMassTest, ForcesKeepMomentum) {
  test::expect_momentum_is_kept(law, displacements(), rounding);
}

TEST_P(TensorMassTest, RemovalLeavesForcesOfMeshThatIsLeft) {
  geometry::TetraMesh left = mesh;
  std::mt19937 generator(5);
  std::vector<geometry::Tetrahedron> kept;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (generator() % 3 == 0) {
      law.remove(geometry::TetId(t));
    } else {
      kept.push_back(mesh.tetrahedra[t]);
    }
  }
  left.tetrahedra = kept;
  TensorMass rebuilt(left, kMaterial, GetParam());

  const std::vector<double> u = displacements();
  const std::vector<double> f = test::forces_of(law, u), expected = test::forces_of(rebuilt, u);

  EXPECT_LE(test::norm(test::sum(f, -1, expected)), rounding / 2 * test::norm(expected));
  EXPECT_NEAR(law.energy(u), rebuilt.energy(u), 10 * kRounding * law.energy(u));
}

TEST_P(TensorMassTest, NothingLeftGivesNoForceAtAll) {
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) law.remove(geometry::TetId(t));
  const std::vector<double> u = displacements();
  EXPECT_EQ(test::norm(test::forces_of(law, u)), 0);
  EXPECT_EQ(law.energy(u), 0);
}

TEST_P(TensorMassTest, AllocatesNothingAfterConstruction) {
  const std::vector<double> u = displacements();
  std::vector<double> f(u.size());
  const std::size_t before = test::heap_allocations();
  law.forces(u, f);
  law.remove(geometry::TetId(3));
  law.add(geometry::TetId(3));
  const double energy = law.energy(u);
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_GT(energy, 0);
}

// Values that are no numbers stay with the nodes that share a tetrahedron with theirs.
TEST_P(TensorMassTest, LostNodeIsSeenInItsNeighboursOnly) {
  std::vector<double> u = displacements();
  u[0] = std::numeric_limits<double>::quiet_NaN();
  std::vector<bool> near(mesh.positions.size(), false);
  for (const auto& tet : mesh.tetrahedra) {
    if (std::ranges::find(tet, geometry::NodeId(0)) == tet.end()) continue;
    for (const geometry::NodeId n : tet) near[n] = true;
  }
  const std::vector<double> f = test::forces_of(law, u);
  for (std::size_t n = 0; n < near.size(); ++n) EXPECT_EQ(std::isnan(f[3 * n]), near[n]) << n;
}

TEST(TensorMassRounding, FloatForcesGoWithStrainNotWithDisplacement) {
  // a large shift on top of a small press: what is lost is the shift's own rounding, 2^-24 of 0.1 m
  const geometry::TetraMesh mesh = test::make_box_mesh(4, 3, 5, {0.04, 0.03, 0.05});
  TensorMass law(mesh, kMaterial);
  const std::vector<double> press = test::random_values(3 * mesh.positions.size(), kDisplacement_m, 4);
  std::vector<double> shifted = press;
  for (double& value : shifted) value += 0.1;
  const std::vector<double> f = test::forces_of(law, press), g = test::forces_of(law, shifted);
  EXPECT_LE(test::norm(test::sum(f, -1, g)), 0.1 / kDisplacement_m * 1.2e-7 * test::norm(f));
}

TEST(LumpedMasses, AddUpToMassOfMesh) {
  const geometry::TetraMesh mesh = test::make_box_mesh(3, 2, 4, {0.03, 0.02, 0.05});
  const std::vector<double> mass = lumped_masses(mesh, kMaterial);
  EXPECT_NEAR(std::accumulate(mass.begin(), mass.end(), 0.0), 0.03 * 0.02 * 0.05 * kMaterial.density_kg_m3,
              kRounding);
  EXPECT_GT(*std::ranges::min_element(mass), 0);
}

}  // namespace
}  // namespace omentum::physics
