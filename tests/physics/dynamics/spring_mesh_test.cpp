#include "physics/dynamics/spring_mesh.h"

#include "tests/physics/dynamics/law_tissue.h"
#include "tests/physics/dynamics/motions.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <limits>

namespace omentum::physics {
namespace {

using namespace omentum::test;

constexpr double kSpringRounding = 1e-12;  // relative

Corners regular_tetrahedron() {
  return {Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 1), Vec3(1, 0, 1)};
}

Corners positive(Corners corners) {
  if (geometry::signed_volume(corners[0], corners[1], corners[2], corners[3]) < 0)
    std::swap(corners[0], corners[1]);
  return corners;
}

Corners random_corners(unsigned seed) {
  const Vector points = random_vector(12, kEdge, seed);
  Corners corners;
  for (int c = 0; c < 4; ++c) corners[static_cast<std::size_t>(c)] = points.segment<3>(3 * c);
  return positive(corners);
}

double length2(const Corners& corners, std::size_t edge) {
  return (corners[kTetEdges[edge][1]] - corners[kTetEdges[edge][0]]).squaredNorm();
}

std::vector<std::pair<std::size_t, std::size_t>> pairs_of_six() {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      if (i != j) pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

class SpringMeshTest : public testing::Test {
 protected:
  const geometry::TetraMesh mesh = make_box_mesh(3, 2, 3, Vec3(3 * kEdge, 2 * kEdge, 3 * kEdge));
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(mesh.positions.size());
  SpringMesh law{mesh, kTissue};

  // E of a uniform strain over that of the continuum with `material`
  double energy_ratio(SpringMesh& springs, const Eigen::Matrix3d& strain, const Material& material) {
    const Vector u = affine(mesh, Eigen::Matrix3d::Identity() + strain, Vec3::Zero());
    const double volume = 18 * kEdge * kEdge * kEdge;
    const double density =
        material.lambda() / 2 * strain.trace() * strain.trace() + material.mu() * strain.squaredNorm();
    return springs.energy(view(u)) / (density * volume);
  }
};

TEST_F(SpringMeshTest, ForceIsMinusEnergyGradient) {
  for (const double share : {0.01, 0.15}) {
    expect_force_is_minus_gradient(law, values_of(random_vector(size, share * kEdge, 7)), kStep,
                                   kDifferences);
  }
}

TEST_F(SpringMeshTest, HasNoForceAtRestAndUnderRigidMotion) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const double stiff_force = kTissue.young_pa * kEdge * kEdge;
  EXPECT_LE(force_of(law, Vector::Zero(size)).cwiseAbs().maxCoeff(), kSpringRounding * stiff_force);
  EXPECT_LE(force_of(law, affine(mesh, R, Vec3(0.1, 0, 0))).cwiseAbs().maxCoeff(),
            100 * kSpringRounding * stiff_force);
}

TEST_F(SpringMeshTest, HasNoNetForceOrTorque) {
  const Vector u = random_vector(size, 0.2 * kEdge, 5);
  expect_momentum_is_kept(law, values_of(u), kSpringRounding);
  expect_no_torque(law, mesh, u, kSpringRounding);
}

TEST_F(SpringMeshTest, AddingUndoesRemoving) {
  expect_adding_undoes_removing(law, mesh.tetrahedra.size(), random_vector(size, 0.2 * kEdge, 8));
}

TEST_F(SpringMeshTest, RemovedTetrahedraAreOut) {
  geometry::TetraMesh cut = mesh;
  for (const std::size_t t : {90u, 40u, 3u}) {
    law.remove(geometry::TetId(t));
    cut.tetrahedra.erase(cut.tetrahedra.begin() + static_cast<std::ptrdiff_t>(t));
  }
  SpringMesh of_cut(cut, kTissue);
  const Vector u = random_vector(size, 0.2 * kEdge, 6);
  const Vector f = force_of(of_cut, u);
  EXPECT_LE((force_of(law, u) - f).norm(), kSpringRounding * f.norm());
}

TEST_F(SpringMeshTest, NodesOfRemovedTetrahedraMayBeAnywhere) {
  const std::int32_t corner = static_cast<std::int32_t>(mesh.positions.size()) - 1;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (std::ranges::count(mesh.tetrahedra[t], geometry::NodeId(corner)) > 0) law.remove(geometry::TetId(t));
  }
  Vector u = random_vector(size, 0.1 * kEdge, 8);
  const Vector f = force_of(law, u);
  u.segment<3>(3 * corner).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ((force_of(law, u) - f).cwiseAbs().maxCoeff(), 0);
}

TEST_F(SpringMeshTest, EndsInOnePlaceTakeNoForceFromEachOther) {
  const Vector f = force_of(law, affine(mesh, Eigen::Matrix3d::Zero(), Vec3::Zero()));
  EXPECT_TRUE(f.allFinite());
}

TEST_F(SpringMeshTest, EveryVectorUnitFindsTheSame) {
  const Vector u = random_vector(size, 0.2 * kEdge, 8), f = force_of(law, u);
  for (const kernels::LawKernels* const* unit = kernels::law_kernels(); *unit != nullptr; ++unit) {
    SpringMesh other(mesh, kTissue, SpringFit::kLeastSquares, **unit);
    EXPECT_LE((force_of(other, u) - f).norm(), kSpringRounding * f.norm()) << (*unit)->name;
    EXPECT_NEAR(other.energy(view(u)), law.energy(view(u)), kSpringRounding * law.energy(view(u)))
        << (*unit)->name;
  }
}

TEST_F(SpringMeshTest, StepAllocatesNothing) {
  Vector u = random_vector(size, 0.1 * kEdge, 8), f(size);
  const std::size_t before = heap_allocations();
  law.forces(view(u), view(f));
  law.remove(geometry::TetId(0));
  law.add(geometry::TetId(0));
  EXPECT_GT(law.energy(view(u)), 0);
  EXPECT_EQ(heap_allocations(), before);
}

// What the fit promises: a continuum of the only Poisson's ratio that springs know. Six tetrahedra around one
// diagonal are no isotropic mesh: its shears differ by more.
TEST_F(SpringMeshTest, UniformDilationCostsWhatItCostsAContinuumOfRatioOneQuarter) {
  const Material fitted{kTissue.young_pa, 0.25, kTissue.density_kg_m3};
  for (const SpringFit fit : {SpringFit::kLeastSquares, SpringFit::kVanGelder}) {
    SpringMesh springs(mesh, kTissue, fit);
    EXPECT_NEAR(energy_ratio(springs, 1e-4 * Eigen::Matrix3d::Identity(), fitted), 1, 1e-9);
  }
}

TEST_F(SpringMeshTest, TissueThatHardlyYieldsInVolumeYieldsAsSprings) {
  const Material soft{5000, 0.45, 1000};
  SpringMesh springs(mesh, soft);
  EXPECT_LT(energy_ratio(springs, 1e-4 * Eigen::Matrix3d::Identity(), soft), 0.25);
}

TEST(SpringFitTest, RegularTetrahedronsSpringsAreAlike) {
  const Corners corners = positive(regular_tetrahedron());
  const double volume = 1.0 / 3, length2 = 2;
  const double expected = kTissue.young_pa * volume / length2;
  for (const SpringFit fit : {SpringFit::kLeastSquares, SpringFit::kVanGelder}) {
    for (const double k : fit_springs(corners, kTissue, fit)) EXPECT_NEAR(k, expected, 1e-9 * expected);
  }
}

// The quadratic form of the springs in the six strains, against V times that of lambda = mu = 2 E / 5.
double misfit(const Corners& corners, const std::array<double, 6>& k) {
  const double modulus = 0.4 * kTissue.young_pa;
  const double volume = geometry::signed_volume(corners[0], corners[1], corners[2], corners[3]);
  Eigen::Matrix<double, 6, 6> off = Eigen::Matrix<double, 6, 6>::Zero();
  off.topLeftCorner<3, 3>().setConstant(-modulus * volume);
  off.diagonal().array() -= 2 * modulus * volume;
  for (std::size_t i = 0; i < k.size(); ++i) {
    const Vec3 e = corners[kTetEdges[i][1]] - corners[kTetEdges[i][0]];
    Eigen::Matrix<double, 6, 1> w;
    w << e[0] * e[0], e[1] * e[1], e[2] * e[2], M_SQRT2 * e[1] * e[2], M_SQRT2 * e[0] * e[2],
        M_SQRT2 * e[0] * e[1];
    w /= e.norm();
    off += k[i] * w * w.transpose();
  }
  return off.norm();
}

// Without changing what a dilation costs: what one spring gets, another one loses.
TEST(SpringFitTest, NoOtherSpringsThatOnlyPullBackAreNearer) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Corners corners = random_corners(seed);
    const auto k = fit_springs(corners, kTissue, SpringFit::kLeastSquares);
    const double best = misfit(corners, k);
    for (const auto& [i, j] : pairs_of_six()) {
      ASSERT_GE(k[i], 0);
      auto other = k;
      const double moved =
          std::min(1e-3 * kTissue.young_pa * kEdge, k[j] * length2(corners, j) / length2(corners, i));
      other[i] += moved;
      other[j] = std::max(0.0, k[j] - moved * length2(corners, i) / length2(corners, j));
      EXPECT_GE(misfit(corners, other), best * (1 - 1e-9)) << seed << ": " << i << ", " << j;
    }
    EXPECT_LE(best, misfit(corners, fit_springs(corners, kTissue, SpringFit::kVanGelder)));
  }
}

}  // namespace
}  // namespace omentum::physics
