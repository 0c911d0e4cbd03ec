// Laws that know large motions, moved by every integrator: energy comes from work alone.
#include "physics/dynamics/corotational.h"
#include "physics/dynamics/energy_watch.h"
#include "physics/dynamics/spring_mesh.h"
#include "physics/dynamics/stable_step.h"
#include "physics/dynamics/warped_step.h"
#include "tests/physics/dynamics/law_tissue.h"
#include "tests/physics/dynamics/motions.h"
#include "tests/support/effort.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>

namespace omentum::physics {
namespace {

using namespace omentum::test;

constexpr double kShare = 0.9;   // of the stable step at rest
constexpr double kLongRun = 60;  // s, simulated

struct Swinging {
  const geometry::TetraMesh mesh = make_box_mesh(4, 2, 2, Vec3(4 * kEdge, 2 * kEdge, 2 * kEdge));
  Inertia inertia{.mass = lumped_masses(mesh, kTissue), .fixed = FixedComponents(mesh.positions.size(), 0)};
  const std::vector<double> nothing = std::vector<double>(3 * mesh.positions.size(), 0.0);

  Swinging() {
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
      if (mesh.positions[n].x() < 0.5 * kEdge) inertia.fixed[n] = kPinned;
    }
  }

  // bent by about half a right angle, and let go
  BodyState bent() const {
    BodyState state = state_at_rest(mesh.positions.size());
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
      const Vec3& p = mesh.positions[n];
      Vec3::Map(&state.u[3 * n]) = Eigen::AngleAxisd(0.8 * p.x() / (4 * kEdge), Vec3::UnitZ()) * p - p;
    }
    return state;
  }

  double energy(const ForceLaw& law, const BodyState& state) const {
    return law.energy(state.u) + kinetic_energy(inertia, state.v);
  }

  // every tetrahedron once, in no order
  std::vector<geometry::TetId> order() const {
    std::vector<std::size_t> numbers(mesh.tetrahedra.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    std::ranges::shuffle(numbers, std::mt19937(4));
    return {numbers.begin(), numbers.end()};
  }
};

enum class Kind { kCorotational, kSprings };

class LargeMotionTest : public testing::TestWithParam<std::tuple<Kind, ExplicitScheme>> {
 protected:
  Swinging body;
  const ExplicitScheme scheme = std::get<1>(GetParam());
  const std::unique_ptr<ForceLaw> law =
      std::get<0>(GetParam()) == Kind::kCorotational
          ? std::unique_ptr<ForceLaw>(std::make_unique<Corotational>(body.mesh, kTissue))
          : std::make_unique<SpringMesh>(body.mesh, kTissue);
};

INSTANTIATE_TEST_SUITE_P(Laws, LargeMotionTest,
                         testing::Combine(testing::Values(Kind::kCorotational, Kind::kSprings),
                                          testing::ValuesIn(kExplicitSchemes)),
                         [](const auto& test) {
                           std::string name = name_of(std::get<1>(test.param));
                           std::erase(name, '-');
                           return (std::get<0>(test.param) == Kind::kCorotational ? "Corotational_"
                                                                                  : "Springs_") +
                                  name;
                         });

TEST_P(LargeMotionTest, EnergyNeverGrowsWithoutWorkCutsIncluded) {
  const double highest = highest_frequency(*law, body.inertia).rad_s;
  body.inertia.stiffness_damping_s = 0.28 / highest;
  const double dt = kShare * stable_step_s(scheme, body.inertia, highest);
  ExplicitStep stepper(scheme, body.inertia);
  BodyState state = body.bent();
  EnergyWatch watch(energy_margin(scheme, kShare), 0);
  watch.restart(body.energy(*law, state));
  const std::vector<geometry::TetId> order = body.order();
  std::size_t next = 0, step = 0;
  for (double t = 0; t < tried(kLongRun); t += dt, ++step) {
    if (step % 200 == 199 && next < order.size() / 2) law->remove(order[next++]);
    static_cast<void>(stepper.step(*law, body.nothing, dt, state));
    if (step % 10 != 0) continue;
    ASSERT_TRUE(watch.accepts(body.energy(*law, state), 10 * dt)) << "after " << t << " s";
  }
}

TEST(WarpedMotion, EnergyNeverGrowsWithoutWorkCutsIncluded) {
  constexpr double kStep = 0.01;  // s
  const Swinging body;
  WarpedStep stepper(body.mesh, kTissue, body.inertia, Corotational(body.mesh, kTissue), {.step_s = kStep});
  BodyState state = body.bent();
  const std::vector<geometry::TetId> order = body.order();
  std::size_t next = 0;
  const double start = body.energy(stepper.law(), state);
  double before = start;
  for (int step = 0; step < static_cast<int>(tried(kLongRun) / kStep); ++step) {
    if (step % 20 == 19 && next < order.size() / 2) {
      ASSERT_TRUE(stepper.remove(std::span(order).subspan(next++, 1)));
    }
    ASSERT_TRUE(stepper.step(state, body.nothing));
    const double energy = body.energy(stepper.law(), state);
    // what an inexact step leaves to the next one
    ASSERT_LE(energy, before + 1e-3 * start) << "after " << kStep * step << " s";
    before = energy;
  }
  EXPECT_LE(before, 0.1 * start);
}

}  // namespace
}  // namespace omentum::physics
