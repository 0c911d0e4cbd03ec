// Strain and stress at the nodes of a body, by the forces of the laws whose stress it is.
#include "physics/nodal_stress.h"

#include "physics/dynamics/corotational.h"
#include "physics/dynamics/tensor_mass.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <numeric>

namespace omentum::physics {
namespace {

using geometry::NodeId;
using geometry::TetId;
using geometry::Vec3;

constexpr Material kTissue{.young_pa = 6000, .poisson = 0.4, .density_kg_m3 = 1000};
constexpr double kLength_m = 0.12, kWidth_m = 0.04, kHeight_m = 0.03;
constexpr double kFloat = 2e-6;  // relative, of values told in single precision

class NodalStressTest : public testing::Test {
 protected:
  NodalStressTest() : nodes_(mesh_.positions.size()) {
    for (std::size_t n = 0; n < nodes_.size(); ++n) nodes_[n] = NodeId(n);
    strain_.resize(nodes_.size());
    stress_pa_.resize(nodes_.size());
  }
  std::vector<double> deformed(const Eigen::Matrix3d& F) const {
    std::vector<double> u;
    for (const Vec3& x : mesh_.positions)
      for (const double component : Vec3(F * x - x)) u.push_back(component);
    return u;
  }
  /// A bar that is longer by `strain` and as thin as Poisson's ratio has it.
  static Eigen::Matrix3d tension(double strain) {
    const double across = 1 - kTissue.poisson * strain;
    return Eigen::Vector3d(1 + strain, across, across).asDiagonal();
  }
  void measure(StressLaw law, const std::vector<double>& u, std::span<const std::uint8_t> removed = {}) {
    NodalStress nodal(mesh_, material_, law);
    measure(nodal, u, removed);
  }
  void measure(NodalStress& nodal, const std::vector<double>& u, std::span<const std::uint8_t> removed = {}) {
    nodal.measure({u, removed, nodes_}, strain_,
                  nodal.knows_stress() ? std::span(stress_pa_) : std::span<float>());
  }
  void expect_everywhere(double strain, double stress_pa) const {
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      EXPECT_NEAR(strain_[n], strain, kFloat);
      EXPECT_NEAR(stress_pa_[n], stress_pa, kFloat * kTissue.young_pa);
    }
  }
  /// What holds the far end of the bar, over its cross-section at rest.
  double force_per_area_pa(ForceLaw& law, const std::vector<double>& u) const {
    std::vector<double> f(u.size());
    law.forces(u, f);
    Vec3 at_end = Vec3::Zero();
    for (const NodeId n : nodes_)
      if (mesh_.positions[n].x() > kLength_m - 1e-9) at_end += Eigen::Map<const Vec3>(f.data() + 3 * n);
    return at_end.norm() / (kWidth_m * kHeight_m);
  }

  geometry::TetraMesh mesh_ = test::make_box_mesh(6, 2, 2, Vec3(kLength_m, kWidth_m, kHeight_m));
  MaterialMap material_{kTissue};
  std::vector<NodeId> nodes_;
  std::vector<float> strain_, stress_pa_;
};

TEST_F(NodalStressTest, ABarThatIsPulledHasForceOverAreaAtEveryNode) {
  const double strain = 0.05;
  const auto u = deformed(tension(strain));
  TensorMass linear(mesh_, material_, TensorMass::Arithmetic::kDouble);
  Corotational turned(mesh_, material_);
  for (const auto& [law, body] : {std::pair<StressLaw, ForceLaw*>{StressLaw::kLinear, &linear},
                                  std::pair<StressLaw, ForceLaw*>{StressLaw::kTurned, &turned}}) {
    measure(law, u);
    const double pulled_pa = force_per_area_pa(*body, u);
    EXPECT_NEAR(pulled_pa, kTissue.young_pa * strain, 1e-6 * pulled_pa);
    expect_everywhere(strain, pulled_pa);
  }
}

TEST_F(NodalStressTest, ABarThatIsPulledAndTurnedHasTheSameInTheFrameThatTurns) {
  const double strain = 0.2;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(2.3, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  const auto u = deformed(R * tension(strain));
  Corotational turned(mesh_, material_);
  measure(StressLaw::kTurned, u);
  expect_everywhere(strain, force_per_area_pa(turned, u));
}

TEST_F(NodalStressTest, ARigidMotionHasNone) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(3.1, Vec3(3, 1, 2).normalized()).toRotationMatrix();
  measure(StressLaw::kTurned, deformed(R));
  expect_everywhere(0, 0);
}

TEST_F(NodalStressTest, TheLinearLawsStressIsWhatItAnswersAlsoWhereThatIsFalse) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix();
  measure(StressLaw::kLinear, deformed(R));
  // e = diag(cos - 1, cos - 1, 0): no principal stress is above that of the third direction
  const double e = std::cos(0.5) - 1;
  expect_everywhere(0, std::max(2 * kTissue.lambda() * e, 2 * (kTissue.lambda() + kTissue.mu()) * e));
}

TEST_F(NodalStressTest, CompressionIsNegativeWhereNothingIsLonger) {
  measure(StressLaw::kTurned, deformed(0.9 * Eigen::Matrix3d::Identity()));
  expect_everywhere(-0.1, -0.1 * (3 * kTissue.lambda() + 2 * kTissue.mu()));
}

TEST_F(NodalStressTest, AnElementTurnedInsideOutIsShorterThanNothing) {
  Eigen::Matrix3d flipped = Eigen::Matrix3d::Identity();
  flipped(0, 0) = -0.5;
  EXPECT_TRUE(turned_strain(flipped).isApprox(Eigen::Matrix3d(Vec3(-1.5, 0, 0).asDiagonal()), 1e-12));
}

TEST_F(NodalStressTest, SmallStrainsKeepTheirDigits) {
  const double strain = 1e-9;
  EXPECT_NEAR(largest_principal(turned_strain(tension(strain))), strain, 1e-6 * strain);
}

TEST_F(NodalStressTest, SpringsTellTheirStrainAlone) {
  NodalStress springs(mesh_, material_, StressLaw::kNone);
  EXPECT_FALSE(springs.knows_stress());
  measure(springs, deformed(tension(0.1)));
  expect_everywhere(0.1, 0);
}

TEST_F(NodalStressTest, WhatIsRemovedDoesNotCountAndANodeWithoutTissueHasNothing) {
  std::vector<double> u = deformed(tension(0.1));
  std::vector<std::uint8_t> removed((mesh_.tetrahedra.size() + 7) / 8);
  const NodeId corner(0);
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t)
    if (std::ranges::find(mesh_.tetrahedra[TetId(t)], corner) != mesh_.tetrahedra[TetId(t)].end())
      removed[t / 8] = static_cast<std::uint8_t>(removed[t / 8] | 1 << t % 8);
  u[0] = 1;  // far away: whatever is there is not tissue
  measure(StressLaw::kTurned, u, removed);
  EXPECT_EQ(strain_[0], 0);
  EXPECT_EQ(stress_pa_[0], 0);
  EXPECT_NEAR(strain_[1], 0.1, kFloat);
}

TEST_F(NodalStressTest, TheMeanIsByVolume) {
  // stretched along x, the more the greater x is: one strain in each tetrahedron
  std::vector<double> u;
  for (const Vec3& x : mesh_.positions) u.insert(u.end(), {x.x() * x.x(), 0, 0});
  measure(StressLaw::kTurned, u);
  const DeformationGradients gradients(mesh_);
  const NodeId n = nodes_[nodes_.size() / 2];
  double sum = 0, volume = 0;
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
    const TetId id(t);
    if (std::ranges::find(mesh_.tetrahedra[id], n) == mesh_.tetrahedra[id].end()) continue;
    sum += gradients.volume_m3(id) * (gradients.at(id, u)(0, 0) - 1);
    volume += gradients.volume_m3(id);
  }
  EXPECT_NEAR(strain_[n], sum / volume, kFloat);
}

TEST_F(NodalStressTest, MeasuringTakesNoMemory) {
  NodalStress nodal(mesh_, material_, StressLaw::kTurned);
  const auto u = deformed(tension(0.1));
  const std::size_t before = test::heap_allocations();
  measure(nodal, u);
  EXPECT_EQ(test::heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::physics
