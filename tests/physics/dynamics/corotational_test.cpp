#include "physics/dynamics/corotational.h"

#include "physics/stiffness.h"
#include "tests/physics/dynamics/law_tissue.h"
#include "tests/physics/dynamics/motions.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace omentum::physics {
namespace {

using namespace omentum::test;

constexpr double kRounding = 1e-12;  // relative: a few hundred operations

Eigen::Matrix3d turned(double degrees, const Vec3& axis) {
  return Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized()).toRotationMatrix();
}

class CorotationalTest : public testing::Test {
 protected:
  // eleven packs and a few lanes: not a multiple of eight
  const geometry::TetraMesh mesh = make_box_mesh(3, 2, 3, Vec3(3 * kEdge, 2 * kEdge, 3 * kEdge));
  const Eigen::Index size = 3 * static_cast<Eigen::Index>(mesh.positions.size());
  Corotational law{mesh, kTissue};

  // forces' size when strains are near one
  const double stiff_force = kTissue.young_pa * kEdge * kEdge;
};

TEST_F(CorotationalTest, ForceIsMinusEnergyGradient) {
  for (const double share : {0.01, 0.1, 0.3}) {
    const Vector u =
        affine(mesh, turned(140, Vec3(1, 2, -1)), Vec3::Ones()) + random_vector(size, share * kEdge, 7);
    expect_force_is_minus_gradient(law, values_of(u), kStep, kDifferences);
  }
}

TEST_F(CorotationalTest, ForceIsMinusEnergyGradientWhereElementsAreInverted) {
  Eigen::Matrix3d mirrored = turned(70, Vec3(0, 1, 1));
  mirrored.col(0) *= -0.5;
  const Vector u = affine(mesh, mirrored, Vec3::Zero()) + random_vector(size, 0.1 * kEdge, 3);
  expect_force_is_minus_gradient(law, values_of(u), kStep, kDifferences);
}

TEST_F(CorotationalTest, RigidMotionGivesZeroForce) {
  for (const double degrees : {0.0, 1.0, 45.0, 90.0, 180.0, 275.0}) {
    const Vector u = affine(mesh, turned(degrees, Vec3(2, -1, 3)), Vec3(0.3, -0.2, 0.1));
    // the displacements themselves are rounded at 0.4 m, forty edges
    EXPECT_LE(force_of(law, u).cwiseAbs().maxCoeff(), 100 * kRounding * stiff_force) << degrees;
    EXPECT_LE(law.energy(view(u)), kRounding * kRounding * 1e4 * stiff_force * kEdge * size) << degrees;
  }
}

TEST_F(CorotationalTest, HasNoNetForceOrTorque) {
  const Vector u =
      affine(mesh, turned(100, Vec3(1, 1, 0)), Vec3::Zero()) + random_vector(size, 0.2 * kEdge, 5);
  expect_momentum_is_kept(law, values_of(u), kRounding);
  expect_no_torque(law, mesh, u, kRounding);
}

TEST_F(CorotationalTest, IsTheLinearLawWhereStrainsAndRotationsAreSmall) {
  const double small = 1e-7;
  const Vector u = random_vector(size, small * kEdge, 11);
  std::vector<Vec3> displacements;
  for (Eigen::Index i = 0; i < size; i += 3) displacements.emplace_back(u.segment<3>(i));
  const std::vector<Vec3> holding = holding_forces(assemble_stiffness(mesh, kTissue), displacements);
  const Vector f = force_of(law, u);
  for (std::size_t n = 0; n < holding.size(); ++n) {
    const Vec3 of_node = f.segment<3>(3 * static_cast<Eigen::Index>(n));
    EXPECT_LE((of_node + holding[n]).norm(), 100 * small * f.norm()) << n;
  }
}

TEST_F(CorotationalTest, ExactTangentIsHessianOfEnergy) {
  const Vector u =
      affine(mesh, turned(140, Vec3(1, 2, -1)), Vec3::Zero()) + random_vector(size, 0.2 * kEdge, 9);
  law.linearize(view(u), Tangent::kExact);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Vector v = random_vector(size, 1, seed);
    Vector product(size);
    law.product(view(v), view(product));
    const Vector ahead = u + kStep * v, behind = u - kStep * v;
    const Vector differences = (force_of(law, behind) - force_of(law, ahead)) / (2 * kStep);
    EXPECT_LE((product - differences).norm(), 10 * kDifferences * product.norm());
  }
}

TEST_F(CorotationalTest, WarpedTangentIsTheElementsStiffnessTurned) {
  const Vector u =
      affine(mesh, turned(140, Vec3(1, 2, -1)), Vec3::Zero()) + random_vector(size, 0.2 * kEdge, 9);
  law.linearize(view(u), Tangent::kWarped);
  const Vector v = random_vector(size, 1, 2);
  Vector product(size), expected = Vector::Zero(size);
  law.product(view(v), view(product));
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const geometry::TetId id(t);
    const ElementTensors K = element_tensors(corners_of(mesh, id), kTissue);
    const Eigen::Matrix3d R = law.rotation(id);
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        expected.segment<3>(3 * mesh.tetrahedra[t][j]) +=
            R * K[j][k] * R.transpose() * v.segment<3>(3 * mesh.tetrahedra[t][k]);
      }
    }
  }
  EXPECT_LE((product - expected).norm(), kRounding * expected.norm());
}

TEST_F(CorotationalTest, TangentsAreOneWhereNothingIsStrained) {
  const Vector u = affine(mesh, turned(60, Vec3(1, 2, -1)), Vec3::Zero());
  const Vector v = random_vector(size, 1, 4);
  Vector warped(size), exact(size);
  law.linearize(view(u), Tangent::kWarped);
  law.product(view(v), view(warped));
  law.linearize(view(u), Tangent::kExact);
  law.product(view(v), view(exact));
  EXPECT_LE((warped - exact).norm(), kRounding * exact.norm());
}

TEST_F(CorotationalTest, RemovedTetrahedraAreOutOfForcesAndProducts) {
  const Vector u =
      affine(mesh, turned(80, Vec3(1, 0, 1)), Vec3::Zero()) + random_vector(size, 0.2 * kEdge, 6);
  geometry::TetraMesh cut = mesh;
  for (const std::size_t t : {90u, 40u, 3u}) {
    law.remove(geometry::TetId(t));
    cut.tetrahedra.erase(cut.tetrahedra.begin() + static_cast<std::ptrdiff_t>(t));
  }
  Corotational of_cut(cut, kTissue);
  const Vector f = force_of(of_cut, u);
  EXPECT_LE((force_of(law, u) - f).norm(), kRounding * f.norm());
  EXPECT_NEAR(law.energy(view(u)), of_cut.energy(view(u)), kRounding * law.energy(view(u)));
  const Vector v = random_vector(size, 1, 1);
  Vector product(size), product_of_cut(size);
  law.linearize(view(u), Tangent::kExact);
  law.product(view(v), view(product));
  of_cut.linearize(view(u), Tangent::kExact);
  of_cut.product(view(v), view(product_of_cut));
  EXPECT_LE((product - product_of_cut).norm(), kRounding * product.norm());
}

TEST_F(CorotationalTest, AddingUndoesRemoving) {
  expect_adding_undoes_removing(law, mesh.tetrahedra.size(), random_vector(size, 0.2 * kEdge, 8));
}

TEST_F(CorotationalTest, NodesOfRemovedTetrahedraMayBeAnywhere) {
  // a corner node of few tetrahedra
  const std::int32_t corner = static_cast<std::int32_t>(mesh.positions.size()) - 1;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    if (std::ranges::count(mesh.tetrahedra[t], geometry::NodeId(corner)) > 0) law.remove(geometry::TetId(t));
  }
  Vector u = random_vector(size, 0.1 * kEdge, 8);
  const Vector f = force_of(law, u);
  u.segment<3>(3 * corner).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ((force_of(law, u) - f).cwiseAbs().maxCoeff(), 0);
}

TEST_F(CorotationalTest, StepAllocatesNothing) {
  // one node is all of them: the way through the ambiguous rotations, too
  const Vector u = affine(mesh, Eigen::Matrix3d::Zero(), Vec3::Zero());
  Vector f(size);
  const std::size_t before = heap_allocations();
  law.forces(view(u), view(f));
  law.linearize(view(u), Tangent::kExact);
  law.product(view(u), view(f));
  law.remove(geometry::TetId(0));
  law.add(geometry::TetId(0));
  EXPECT_GE(law.energy(view(u)), 0);
  EXPECT_EQ(heap_allocations(), before);
}

TEST_F(CorotationalTest, EveryVectorUnitFindsTheSame) {
  const Eigen::Matrix3d whole = turned(100, Vec3(1, 1, 0)), flat = whole * Vec3(1, 1, 0).asDiagonal();
  for (const Eigen::Matrix3d& A : {whole, flat}) {
    const Vector u = affine(mesh, A, Vec3::Zero()) + random_vector(size, 0.1 * kEdge, 5);
    const Vector f = force_of(law, u), v = random_vector(size, 1, 2);
    Vector product(size), other_product(size);
    law.linearize(view(u), Tangent::kExact);
    law.product(view(v), view(product));
    for (const kernels::LawKernels* const* unit = kernels::law_kernels(); *unit != nullptr; ++unit) {
      Corotational other(mesh, kTissue, **unit);
      EXPECT_LE((force_of(other, u) - f).norm(), kRounding * f.norm()) << (*unit)->name;
      EXPECT_NEAR(other.energy(view(u)), law.energy(view(u)), kRounding * law.energy(view(u)))
          << (*unit)->name;
      other.linearize(view(u), Tangent::kExact);
      other.product(view(v), view(other_product));
      EXPECT_LE((other_product - product).norm(), kRounding * product.norm()) << (*unit)->name;
    }
  }
}

// One tetrahedron that is let go: x <- x + f / (a stiffness above its own), until it is at rest.
class CollapsedElementTest : public testing::TestWithParam<std::string> {
 protected:
  static Eigen::Matrix3d gradient_of(const std::string& name) {
    Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
    if (name == "flat") F(2, 2) = 0;
    if (name == "line") F(1, 1) = F(2, 2) = 0;
    if (name == "point") F.setZero();
    if (name == "inverted") F(0, 0) = -0.6;
    if (name == "inverted_as_far_as_thick") F(0, 0) = -1;
    if (name == "point_reflected") F *= -1;
    return turned(50, Vec3(1, -1, 2)) * F * turned(20, Vec3(0, 1, 1));
  }
};

INSTANTIATE_TEST_SUITE_P(Shapes, CollapsedElementTest,
                         testing::Values("flat", "line", "point", "inverted", "inverted_as_far_as_thick",
                                         "point_reflected"),
                         [](const auto& shape) { return shape.param; });

TEST_P(CollapsedElementTest, Recovers) {
  geometry::TetraMesh mesh;
  mesh.positions = {{0, 0, 0}, {kEdge, 0, 0}, {0.2 * kEdge, kEdge, 0}, {0.1 * kEdge, 0.3 * kEdge, kEdge}};
  mesh.tetrahedra = {{geometry::NodeId(0), geometry::NodeId(1), geometry::NodeId(2), geometry::NodeId(3)}};
  Corotational law(mesh, kTissue);
  Vector u = affine(mesh, gradient_of(GetParam()), Vec3::Zero());
  const double at_first = law.energy(view(u));
  ASSERT_GT(at_first, 0);
  double last = at_first;
  for (int step = 0; step < 3000; ++step) {
    const Vector f = force_of(law, u);
    ASSERT_TRUE(f.allFinite());
    u += f / (20 * kTissue.young_pa * kEdge);
    const double energy = law.energy(view(u));
    ASSERT_LE(energy, last * (1 + kRounding) + 1e-20 * at_first) << step;
    last = energy;
  }
  EXPECT_LE(last, 1e-12 * at_first);
  const Vector x = rest_positions(mesh) + u;
  EXPECT_GT(geometry::signed_volume(x.segment<3>(0), x.segment<3>(3), x.segment<3>(6), x.segment<3>(9)), 0);
}

TEST(CorotationalRotation, IsTheNearestOneWhateverTheDeformation) {
  const geometry::TetraMesh mesh = make_box_mesh(1, 1, 1, Vec3::Constant(kEdge));
  Corotational law(mesh, kTissue);
  for (unsigned seed = 1; seed <= 200; ++seed) {
    Eigen::Matrix3d F = Eigen::Map<const Eigen::Matrix3d>(random_vector(9, 1, seed).data());
    if (seed % 4 == 0) F.col(0) = 1e-9 * F.col(1);  // flat
    const Vector u = affine(mesh, F, Vec3::Zero());
    law.linearize(view(u), Tangent::kWarped);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vec3 sign(1, 1, svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1 : 1);
    const Eigen::Matrix3d nearest = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
    const Vec3 s = svd.singularValues();
    const double gap = (s[1] + sign[2] * s[2]) / s[0];
    if (gap < 1e-3) continue;  // another one is as near
    EXPECT_LE((law.rotation(geometry::TetId(0)) - nearest).norm(), 1e-8) << seed;
  }
}

}  // namespace
}  // namespace omentum::physics
