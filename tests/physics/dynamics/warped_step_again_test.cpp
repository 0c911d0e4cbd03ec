#include "physics/dynamics/warped_step.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

constexpr Material kPulledTissue{6000, 0.45, 1000};

// A block that is held at x = 0, one corner node of which is pulled by its own cell's size within a step: far
// beyond where its tetrahedra are what they were linearized as.
class WarpedStepAgainTest : public testing::Test {
 protected:
  WarpedStepAgainTest() {
    for (const Vec3& p : mesh_.positions) inertia_.fixed.push_back(p.x() == 0 ? kPinned : 0);
    for (std::size_t n = 0; n < mesh_.positions.size(); ++n)
      if ((mesh_.positions[n] - Vec3(0.04, 0, 0)).norm() < 1e-9) corner_ = n;
  }
  WarpedStep made() const {
    return {mesh_, kPulledTissue, inertia_, Corotational(mesh_, kPulledTissue), {.step_s = 0.01}};
  }
  std::vector<double> pull(const Vec3& force) const {
    std::vector<double> f(3 * mesh_.positions.size());
    Vec3::Map(&f[3 * corner_]) = force;
    return f;
  }
  double energy_j(WarpedStep& step, const BodyState& state) const {
    return step.elastic_energy(state.u) + kinetic_energy(step.mass(), state.v);
  }

  // Five steps that are made again gain nothing. Whether one that is not would have gained.
  bool try_pull(const Vec3& force) const {
    const std::vector<double> f = pull(force);
    WarpedStep once = made(), again = made();
    BodyState a = state_at_rest(mesh_.positions.size()), b = a;
    EXPECT_TRUE(once.step(a, f));
    for (int i = 0; i < 5; ++i) {
      const double before_j = energy_j(again, b);
      EXPECT_TRUE(again.step_again(b, f));
      EXPECT_LE(energy_j(again, b), (before_j + again.work(f, b.v)) * (1 + 1e-3))
          << force.norm() << ", " << i;
    }
    return energy_j(once, a) > once.work(f, a.v);
  }

  geometry::TetraMesh mesh_ = test::make_box_mesh(4, 2, 2, {0.04, 0.02, 0.02});
  Inertia inertia_{lumped_masses(mesh_, kPulledTissue), {}};
  std::size_t corner_ = 0;
};

TEST_F(WarpedStepAgainTest, EnergyIsNoMoreThanTheWorkWhereOneLinearizationGivesMore) {
  int beyond = 0;
  for (const double damping_s : {0.0, 0.01}) {
    inertia_.stiffness_damping_s = damping_s;
    for (const Vec3& way : {Vec3(-1, 0, 0), Vec3(-1, 1, 1), Vec3(0, 1, 0), Vec3(1, 0, 0)})
      for (const double force_n : {0.2, 0.5, 1.0, 2.0}) beyond += try_pull(force_n * way) ? 1 : 0;
  }
  EXPECT_GT(beyond, 3) << "no pull was hard enough";
}

TEST_F(WarpedStepAgainTest, WhereOneLinearizationIsExactItIsTheSameStep) {
  inertia_.mass_damping_per_s = 2;
  inertia_.stiffness_damping_s = 0.01;
  WarpedStep once = made(), again = made();
  BodyState a = state_at_rest(mesh_.positions.size()), b = a;
  for (int i = 0; i < 10; ++i) {
    const std::vector<double> f = pull(i < 5 ? Vec3(0, 0, 1e-5) : Vec3::Zero());
    ASSERT_TRUE(once.step(a, f) && again.step_again(b, f));
  }
  double most = 0, off = 0;
  for (std::size_t c = 0; c < a.u.size(); ++c) {
    most = std::max(most, std::abs(a.u[c]));
    off = std::max(off, std::abs(a.u[c] - b.u[c]));
  }
  EXPECT_LE(off, 5e-3 * most);  // an equation may lack a thousandth
}

}  // namespace
}  // namespace omentum::physics
