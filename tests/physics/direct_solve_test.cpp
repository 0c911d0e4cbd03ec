#include "physics/direct_solve.h"

#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace omentum::physics {
namespace {

constexpr double kRounding =
    1e-10;  // relative: eps times the condition number of these small meshes (below 1e5)

bool on_box(const Vec3& p, const Vec3& size) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(p[axis]) < 1e-12 || std::abs(p[axis] - size[axis]) < 1e-12) return true;
  }
  return false;
}

// A box whose inner nodes are moved about, so that no symmetry helps.
geometry::TetraMesh irregular_box(int n, const Vec3& size) {
  geometry::RawMesh raw = test::make_raw_box(n, n, n, size);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> part(-0.15, 0.15);
  for (Vec3& p : raw.positions) {
    if (on_box(p, size)) continue;
    for (int axis = 0; axis < 3; ++axis) p[axis] += part(generator) * size[axis] / n;
  }
  return geometry::check_mesh(raw, 1.0).mesh;
}

TEST(DirectSolveTest, PatchTestLinearFieldIsReproducedInside) {
  const Vec3 size(0.04, 0.05, 0.03);
  const geometry::TetraMesh mesh = irregular_box(4, size);
  const Stiffness K = assemble_stiffness(mesh, Material{3000, 0.45, 1000});
  Eigen::Matrix3d gradient;
  gradient << 0.01, 0.02, -0.01, 0.005, -0.02, 0.01, 0.0, 0.015, 0.03;
  std::vector<ImposedDisplacement> boundary;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    const Vec3& p = mesh.positions[n];
    if (on_box(p, size)) boundary.push_back({NodeId(n), gradient * p});
  }
  ASSERT_LT(boundary.size(), mesh.positions.size());

  const StaticSolution solution = direct_solve(K, FixedComponents(mesh.positions.size(), 0), boundary, {});

  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    EXPECT_LE((solution.displacements[n] - gradient * mesh.positions[n]).norm(),
              kRounding * gradient.norm() * size.norm());
  }
}

TEST(DirectSolveTest, UniaxialStretchGivesYoungTimesStrainTimesArea) {
  // rollers on three faces, the fourth pulled: uniform strain, lateral contraction by Poisson's ratio
  const Vec3 size(0.03, 0.02, 0.05);
  const Material material{7000, 0.3, 1000};
  const double strain = 0.01;
  const geometry::TetraMesh mesh = irregular_box(3, size);
  FixedComponents fixed(mesh.positions.size(), 0);
  std::vector<ImposedDisplacement> top;
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    const Vec3& p = mesh.positions[n];
    for (int axis = 0; axis < 3; ++axis) {
      if (p[axis] < 1e-12) fixed[n] |= static_cast<std::uint8_t>(1 << axis);
    }
    const Vec3 u(-material.poisson * strain * p.x(), -material.poisson * strain * p.y(), strain * p.z());
    if (p.z() > size.z() - 1e-12) top.push_back({NodeId(n), u});
  }

  const StaticSolution solution = direct_solve(assemble_stiffness(mesh, material), fixed, top, {});

  double pull = 0, sideways = 0;
  for (const Vec3& f : solution.holding_forces) {
    pull += f.z();
    sideways = std::max({sideways, std::abs(f.x()), std::abs(f.y())});
  }
  const double expected = material.young_pa * strain * size.x() * size.y();
  EXPECT_NEAR(pull, expected, kRounding * expected);
  EXPECT_LE(sideways, kRounding * expected) << "the sides are free of stress";
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    const Vec3& p = mesh.positions[n];
    const Vec3 u(-material.poisson * strain * p.x(), -material.poisson * strain * p.y(), strain * p.z());
    EXPECT_LE((solution.displacements[n] - u).norm(), kRounding * strain * size.norm());
  }
}

// Two materials in series: one stress in both, so that each has its own constant strain. Displacements along
// z are linear in either part, which linear elements hold exactly where no tetrahedron lies in both.
struct TwoMaterials {
  const char* name;
  Material lower, upper;
  bool
      confined;  // sides on rollers: strain along z alone, else sides are free and nothing contracts (nu = 0)
};

class SeriesTest : public testing::TestWithParam<TwoMaterials> {
 protected:
  // Stress per strain along z.
  static double modulus(const Material& m) { return m.lambda() + 2 * m.mu(); }
};

INSTANTIATE_TEST_SUITE_P(Bars, SeriesTest,
                         testing::Values(TwoMaterials{"free", {2000, 0, 1000}, {10000, 0, 1000}, false},
                                         TwoMaterials{
                                             "confined", {2000, 0.45, 1000}, {10000, 0.2, 1000}, true}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(SeriesTest, ABarUnderTensionHasTheAnalyticDisplacement) {
  const TwoMaterials& p = GetParam();
  const double length = 0.1, joint = 0.04, pull_n = 0.5;
  const Vec3 size(0.02, 0.02, length);
  geometry::TetraMesh mesh = test::make_box_mesh(2, 2, 10, size);
  for (const auto& t : mesh.tetrahedra) {
    const double z = (mesh.positions[t[0]].z() + mesh.positions[t[3]].z()) / 2;
    mesh.regions.push_back(z < joint ? 3 : 8);
  }
  FixedComponents fixed(mesh.positions.size(), 0);
  std::vector<ImposedDisplacement> top;
  const double stress = pull_n / (size.x() * size.y());
  const auto expected = [&](double z) {
    return stress * (std::min(z, joint) / modulus(p.lower) + std::max(z - joint, 0.0) / modulus(p.upper));
  };
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    const Vec3& x = mesh.positions[n];
    for (int axis = 0; axis < 3; ++axis) {
      const bool at_side = x[axis] < 1e-12 || x[axis] > size[axis] - 1e-12;
      if (p.confined && axis < 2 ? at_side : x[axis] < 1e-12)
        fixed[n] |= static_cast<std::uint8_t>(1 << axis);
    }
    if (x.z() > length - 1e-12) top.push_back({NodeId(n), {0, 0, expected(length)}});
  }

  const MaterialMap material{p.lower, {{8, p.upper}}};
  const StaticSolution solution = direct_solve(assemble_stiffness(mesh, material), fixed, top, {});

  double pull = 0;
  for (const Vec3& f : solution.holding_forces) pull += f.z();
  EXPECT_NEAR(pull, pull_n, kRounding * pull_n);
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    const Vec3 u(0, 0, expected(mesh.positions[n].z()));
    EXPECT_LE((solution.displacements[n] - u).norm(), kRounding * expected(length)) << mesh.positions[n].z();
  }
}

// A bar of n x n x 4n cubes that hangs from its top, without lateral contraction: u_z = -(rho g / E) (L s -
// s^2 / 2) at distance s below the top. Errors relative to the tip's displacement.
struct BarError {
  double tip;    // of the lower end's mean
  double worst;  // of any node: the cubes' diagonals all run one way, which tilts a coarse bar
};

BarError hanging_bar_error(int n) {
  const double length = 0.2, g = 9.81;
  const Material material{2000, 0.0, 1000};
  const geometry::TetraMesh mesh = test::make_box_mesh(n, n, 4 * n, {length / 4, length / 4, length});
  FixedComponents fixed(mesh.positions.size(), 0);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.positions[i].z() > length - 1e-12) fixed[i] = kPinned;
  }
  const auto loads = body_forces(mesh, material, {0, 0, -g});
  const StaticSolution solution = direct_solve(assemble_stiffness(mesh, material), fixed, {}, loads);

  const double unit = material.density_kg_m3 * g / material.young_pa;
  double worst = 0, tip = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double s = length - mesh.positions[i].z();
    const Vec3 expected(0, 0, -unit * (length * s - s * s / 2));
    worst = std::max(worst, (solution.displacements[i] - expected).norm());
    if (mesh.positions[i].z() < 1e-12)
      tip += (solution.displacements[i] - expected).z() / ((n + 1) * (n + 1));
  }
  const double scale = unit * length * length / 2;
  return {std::abs(tip) / scale, worst / scale};
}

TEST(DirectSolveTest, BarUnderItsOwnWeightMatchesTheoryAndConverges) {
  const BarError coarse = hanging_bar_error(2), fine = hanging_bar_error(4);
  EXPECT_LE(coarse.tip, 1e-4);  // linear elements are exact at the nodes of a rod
  EXPECT_LE(fine.tip, 1e-4);
  EXPECT_LE(fine.worst, 0.5 * coarse.worst);  // at least first order in the mesh size
}

TEST(DirectSolveTest, SupportsCarryTheWholeWeight) {
  const Material material{2000, 0.4, 1000};
  const geometry::TetraMesh mesh = test::make_box_mesh(2, 2, 4, {0.05, 0.05, 0.1});
  FixedComponents fixed(mesh.positions.size(), 0);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.positions[i].z() < 1e-12) fixed[i] = kPinned;
  }
  const Stiffness K = assemble_stiffness(mesh, material);
  const auto loads = body_forces(mesh, material, {0, 0, -9.81});
  const StaticSolution solution = direct_solve(K, fixed, {}, loads);

  const std::vector<Vec3> internal = holding_forces(K, solution.displacements);
  Vec3 carried = Vec3::Zero();
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    if (fixed[i] == kPinned) carried += internal[i] - loads[i];
  }
  const double weight = material.density_kg_m3 * 0.05 * 0.05 * 0.1 * 9.81;
  EXPECT_LE((carried - Vec3(0, 0, weight)).norm(), kRounding * weight);
}

TEST(DirectSolveTest, ImposedNodesArriveExactlyAndNothingElseIsLoaded) {
  const geometry::TetraMesh mesh = test::make_box_mesh(3, 3, 3, {0.05, 0.05, 0.05});
  FixedComponents fixed(mesh.positions.size(), 0);
  for (int n = 0; n < 16; ++n) fixed[n] = kPinned;
  const Stiffness K = assemble_stiffness(mesh, Material{3000, 0.45, 1000});
  const std::vector<ImposedDisplacement> imposed{{NodeId(60), {1e-3, 0, -2e-3}}, {NodeId(40), {0, 1e-3, 0}}};

  const StaticSolution solution = direct_solve(K, fixed, imposed, {});

  const std::vector<Vec3> forces = holding_forces(K, solution.displacements);
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    if (fixed[n] == kPinned || n == 60 || n == 40) continue;
    EXPECT_LE(forces[n].norm(), kRounding * solution.holding_forces[0].norm()) << n;
  }
  EXPECT_EQ(solution.displacements[60], imposed[0].displacement);
  EXPECT_EQ(solution.displacements[40], imposed[1].displacement);
  EXPECT_GT(solution.holding_forces[0].dot(imposed[0].displacement), 0) << "work is done on the tissue";
}

}  // namespace
}  // namespace omentum::physics
