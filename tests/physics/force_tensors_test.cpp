// The precomputed tensors against constrained solves from scratch: docs/design.md, "Superposition".
#include "physics/force_tensors.h"

#include "physics/direct_solve.h"
#include "physics/surface_compliance.h"
#include "physics/tensor_solve.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <random>

namespace omentum::physics {
namespace {

// Contracts of organ_solve (issue 2, "done when"), relative to the largest force and displacement.
constexpr double kDoubleTolerance = 1e-9;
constexpr double kFloatForceTolerance = 1e-5;
constexpr double kFloatDisplacementTolerance = 2e-5;

// Neighbours that are moved each their own way need large forces whose effects nearly cancel: the rounding of
// C, stored in float, then counts as often as the condition of C_AA says.
constexpr double kFloatRounding = std::numeric_limits<float>::epsilon() / 2;

const Material kTissue{3000, 0.45, 1050};

// Tensors in aligned memory of their own.
template <class Scalar>
struct OwnTiles {
  explicit OwnTiles(std::int32_t mobile) : view{mobile, nullptr} {
    memory.reset(static_cast<Scalar*>(std::aligned_alloc(64, (view.size() * sizeof(Scalar) + 63) / 64 * 64)),
                 std::free);
    view.values = memory.get();
    bounds.resize(static_cast<std::size_t>(mobile) * view.cluster_count());
  }
  ComplianceTiles<const Scalar> tiles() const { return {view.mobile_count, view.values}; }

  std::shared_ptr<Scalar> memory;
  ComplianceTiles<Scalar> view;
  std::vector<float> bounds;
};

struct Model {
  geometry::TetraMesh mesh;
  FixedComponents fixed;
  geometry::Surface surface;
  Stiffness stiffness;
  FreeDofs free;

  Model(geometry::TetraMesh m, FixedComponents f)
      : mesh(std::move(m)),
        fixed(std::move(f)),
        surface(geometry::extract_surface(mesh, pinned_nodes(fixed))),
        stiffness(assemble_stiffness(mesh, kTissue)),
        free(free_dofs(fixed)) {}

  template <class Scalar>
  OwnTiles<Scalar> tensors(int threads = 2) const {
    OwnTiles<Scalar> own(surface.mobile_count);
    EXPECT_TRUE(compute_force_tensors(StiffnessFactor(stiffness, free), free, surface, own.view,
                                      std::span(own.bounds), {threads, {}, {}, {}}));
    return own;
  }

  double size() const {
    double largest = 0;
    for (const Vec3& p : mesh.positions) largest = std::max(largest, (p - mesh.positions[0]).norm());
    return largest;
  }
};

// Holds everything in the tenth of the mesh with the smallest x.
FixedComponents hold_left_end(const geometry::TetraMesh& mesh) {
  double low = mesh.positions[0].x(), high = low;
  for (const Vec3& p : mesh.positions) {
    low = std::min(low, p.x());
    high = std::max(high, p.x());
  }
  FixedComponents fixed(mesh.positions.size(), 0);
  for (std::size_t n = 0; n < fixed.size(); ++n) {
    if (mesh.positions[n].x() < low + 0.1 * (high - low)) fixed[n] = kPinned;
  }
  return fixed;
}

// Who is pressed: nodes anywhere, each its own way; nodes side by side moved alike, as an instrument moves
// them; or side by side, each its own way, which no instrument does and which makes the contact system
// hardest.
enum class Press { kAnywhere, kTool, kJagged };

std::vector<ImposedSurfaceNode> press(const Model& model, Press how, int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0, 0.01 * model.size());
  std::vector<std::int32_t> nodes(model.surface.mobile_count);
  std::iota(nodes.begin(), nodes.end(), 0);
  if (how == Press::kAnywhere) std::shuffle(nodes.begin(), nodes.end(), generator);
  const std::size_t first = how == Press::kAnywhere ? 0 : generator() % (nodes.size() - count);
  std::vector<ImposedSurfaceNode> imposed;
  Vec3 u;
  for (int q = 0; q < count; ++q) {
    if (q == 0 || how != Press::kTool) u = Vec3::NullaryExpr([&] { return normal(generator); });
    imposed.push_back({SurfaceId(nodes[first + q]), u});
    const std::uint8_t held = model.fixed[model.surface.node[nodes[first + q]]];
    for (int axis = 0; axis < 3; ++axis) {
      if (is_fixed(held, axis)) imposed.back().displacement[axis] = 0;
    }
  }
  return imposed;
}

struct Error {
  double force = 0;         // relative to the largest force
  double displacement = 0;  // relative to the largest displacement
  double condition = 1;     // of C_AA
};

template <class Scalar>
Error compare(const Model& model, const ComplianceTiles<const Scalar>& tiles,
              const std::vector<ImposedSurfaceNode>& imposed) {
  std::vector<ImposedDisplacement> at_nodes;
  for (const auto& i : imposed) at_nodes.push_back({model.surface.node[i.node], i.displacement});
  const StaticSolution direct = direct_solve(model.stiffness, model.fixed, at_nodes, {});
  const SurfaceSolution tensors = tensor_solve(tiles, model.surface, model.fixed, imposed);
  std::vector<Vec3> u(model.mesh.positions.size(), Vec3::Zero());
  for (std::int32_t s = 0; s < model.surface.mobile_count; ++s)
    u[model.surface.node[s]] = tensors.displacements[s];
  u = extend_inside(model.stiffness, model.fixed, model.surface, u, {});

  Error error;
  double largest_force = 0, largest_displacement = 0;
  for (std::size_t q = 0; q < imposed.size(); ++q) {
    error.force = std::max(error.force, (tensors.holding_forces[q] - direct.holding_forces[q]).norm());
    largest_force = std::max(largest_force, direct.holding_forces[q].norm());
  }
  for (std::size_t n = 0; n < u.size(); ++n) {
    error.displacement = std::max(error.displacement, (u[n] - direct.displacements[n]).norm());
    largest_displacement = std::max(largest_displacement, direct.displacements[n].norm());
  }
  return {error.force / largest_force, error.displacement / largest_displacement, 1 / tensors.rcond};
}

void expect_tensors_equal_direct(const Model& model) {
  const OwnTiles<double> in_double = model.tensors<double>();
  const OwnTiles<float> in_float = model.tensors<float>();
  for (const int count : {1, 3, 12}) {
    for (const Press how : {Press::kAnywhere, Press::kTool, Press::kJagged}) {
      SCOPED_TRACE(std::to_string(count) + " nodes, press " + std::to_string(static_cast<int>(how)));
      const auto imposed = press(model, how, count, 1);
      const Error twofold = compare<double>(model, in_double.tiles(), imposed);
      EXPECT_LE(twofold.force, kDoubleTolerance);
      EXPECT_LE(twofold.displacement, kDoubleTolerance);
      const Error single = compare<float>(model, in_float.tiles(), imposed);
      const double rounding = how == Press::kAnywhere ? 0 : kFloatRounding * single.condition;
      EXPECT_LE(single.force, std::max(kFloatForceTolerance, rounding));
      EXPECT_LE(single.displacement, std::max(kFloatDisplacementTolerance, rounding));
    }
  }
}

Model box_model() {
  geometry::TetraMesh mesh = test::make_box_mesh(6, 4, 4, {0.12, 0.08, 0.08});
  FixedComponents fixed = hold_left_end(mesh);
  return {std::move(mesh), std::move(fixed)};
}

// Rollers: one component on each of three faces, so that many nodes move in some components only.
Model roller_model() {
  geometry::TetraMesh mesh = test::make_box_mesh(5, 4, 3, {0.1, 0.08, 0.06});
  FixedComponents fixed(mesh.positions.size(), 0);
  for (std::size_t n = 0; n < fixed.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      if (mesh.positions[n][axis] < 1e-12) fixed[n] |= static_cast<std::uint8_t>(1 << axis);
    }
  }
  return {std::move(mesh), std::move(fixed)};
}

TEST(ForceTensorsTest, EqualDirectSolveOnBox) {
  expect_tensors_equal_direct(box_model());
}

TEST(ForceTensorsTest, EqualDirectSolveWithSupportsOfSingleComponents) {
  expect_tensors_equal_direct(roller_model());
}

struct RealMesh {
  const char* file;
  double metres_per_unit;
};

class RealMeshTest : public testing::TestWithParam<RealMesh> {};

INSTANTIATE_TEST_SUITE_P(Organs, RealMeshTest,
                         testing::Values(RealMesh{"tet/openhelp_liver_7k.msh", 1e-3},
                                         RealMesh{"tet/sofamcp_prostate.vtk", 1e-3},
                                         RealMesh{"tet/sofaenv_tissue_retraction.msh", 1}));

TEST_P(RealMeshTest, TensorsEqualDirectSolve) {
  const std::filesystem::path file = test::data_file(GetParam().file);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent";
  geometry::TetraMesh mesh = geometry::check_mesh(geometry::read_mesh(file), GetParam().metres_per_unit).mesh;
  FixedComponents fixed = hold_left_end(mesh);
  expect_tensors_equal_direct({std::move(mesh), std::move(fixed)});
}

TEST(ForceTensorsTest, AreColumnsOfTheInverse) {
  const Model model = roller_model();
  const OwnTiles<double> own = model.tensors<double>();
  const Eigen::MatrixXd C = StiffnessFactor(model.stiffness, model.free)
                                .solve(Eigen::MatrixXd::Identity(model.free.count, model.free.count));
  const double tolerance = kDoubleTolerance * C.cwiseAbs().maxCoeff();
  for (std::int32_t n = 0; n < model.surface.mobile_count; ++n) {
    for (std::int32_t k = 0; k < model.surface.mobile_count; ++k) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          const std::int32_t row = model.free.of(model.surface.node[n], i);
          const std::int32_t column = model.free.of(model.surface.node[k], j);
          const double expected = row < 0 || column < 0 ? 0 : C(row, column);
          ASSERT_NEAR(own.view.at(n, i, k, j), expected, tolerance);
        }
      }
    }
  }
}

TEST(ForceTensorsTest, AreExactlySymmetric) {
  const OwnTiles<float> own = box_model().tensors<float>();
  for (std::int32_t n = 0; n < own.view.mobile_count; ++n) {
    for (std::int32_t k = 0; k < own.view.mobile_count; ++k) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) ASSERT_EQ(own.view.at(n, i, k, j), own.view.at(k, j, n, i));
      }
    }
  }
}

TEST(ForceTensorsTest, UnusedLanesAreZero) {
  const OwnTiles<float> own = box_model().tensors<float>();
  ASSERT_NE(own.view.mobile_count % 16, 0);
  for (std::int32_t k = 0; k < own.view.mobile_count; ++k) {
    const float* tile = own.view.tile(k, own.view.cluster_count() - 1);
    for (int plane = 0; plane < 9; ++plane) {
      for (int lane = own.view.mobile_count % 16; lane < 16; ++lane) ASSERT_EQ(tile[16 * plane + lane], 0);
    }
  }
}

TEST(ForceTensorsTest, DoNotDependOnTheNumberOfWorkers) {
  const Model model = box_model();
  const OwnTiles<float> one = model.tensors<float>(1), three = model.tensors<float>(3);
  for (std::size_t v = 0; v < one.view.size(); ++v) {
    ASSERT_NEAR(one.view.values[v], three.view.values[v], 1e-6 * std::abs(one.view.values[v]) + 1e-12);
  }
}

TEST(ForceTensorsTest, BoundsHoldForEveryNodeOfTouchingTrianglesAndAreTight) {
  const Model model = box_model();
  const OwnTiles<float> own = model.tensors<float>();
  const SurfaceCompliance compliance(own.view.mobile_count, own.view.values, own.bounds.data(), own.memory);
  const int clusters = own.view.cluster_count();
  for (std::int32_t k = 0; k < own.view.mobile_count; ++k) {
    std::vector<double> largest(clusters, 0);
    for (const auto& triangle : model.surface.triangles) {
      for (const auto touched : triangle) {
        if (touched >= own.view.mobile_count) continue;
        for (const auto n : triangle) {
          const Eigen::Matrix3d C_nk = compliance.block(n, SurfaceId(k));
          double& worst = largest[touched / 16];
          worst = std::max(worst, C_nk.jacobiSvd().singularValues()[0]);
        }
      }
    }
    for (int c = 0; c < clusters; ++c) {
      ASSERT_GE(compliance.bounds(SurfaceId(k))[c], largest[c]);
      ASSERT_LE(compliance.bounds(SurfaceId(k))[c], 3 * largest[c])
          << "sqrt(|C|_1 |C|_inf) is at most 3 |C|_2";
    }
  }
}

TEST(ForceTensorsTest, StopLeavesThemIncompleteAndSaysSo) {
  const Model model = box_model();
  OwnTiles<float> own(model.surface.mobile_count);
  const StiffnessFactor factor(model.stiffness, model.free);
  EXPECT_FALSE(compute_force_tensors(factor, model.free, model.surface, own.view, std::span(own.bounds),
                                     {2, {}, [] { return true; }, {}}));
}

TEST(ForceTensorsTest, ProgressEndsAtOne) {
  const Model model = box_model();
  OwnTiles<float> own(model.surface.mobile_count);
  const StiffnessFactor factor(model.stiffness, model.free);
  std::vector<double> seen;
  ASSERT_TRUE(compute_force_tensors(factor, model.free, model.surface, own.view, std::span(own.bounds),
                                    {2, [&](double fraction) { seen.push_back(fraction); }, {}, {}}));
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1);
}

}  // namespace
}  // namespace omentum::physics
