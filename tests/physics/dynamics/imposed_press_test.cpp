#include "physics/dynamics/imposed_press.h"

#include "physics/direct_solve.h"
#include "physics/dynamics/implicit_step.h"
#include "physics/dynamics/warped_step.h"
#include "tests/physics/dynamics/kept_factor_fixtures.h"
#include "tests/support/heap_count.h"

#include <gtest/gtest.h>

#include <deque>

namespace omentum::physics {
namespace {

using geometry::NodeId;
using test::HeldBody;

// The middle of the top face of held_box(): 6 x 4 x 5 cubes.
constexpr NodeId kTop(3 + 7 * (2 + 5 * 5));
constexpr double kPressed_m = 0.004;

Vec3 at(const std::vector<double>& components, NodeId n) {
  return Eigen::Map<const Vec3>(components.data() + 3 * n);
}

Press press_of(const NodeId& node, const Vec3& u, const Vec3& f) {
  return {{&node, 1}, {&u, 1}, {&f, 1}};
}

TEST(ImposedPressTest, AStepEndsWhereTheHandsAre) {
  const HeldBody body = test::held_box();
  ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = 0.005});
  ImposedPress imposed(body.mesh.positions.size(), 2);
  BodyState state = state_at_rest(body.mesh.positions.size());
  const std::vector<double> none(body.components(), 0.0);
  ASSERT_TRUE(stepper.step(state, none));

  const NodeId other(kTop - 1);  // each tool's force moves the other's node
  // the hands' forces are only nearly right
  std::vector<float> block(36);
  const std::array nodes{kTop, other};
  stepper.compliance(nodes, block);
  const double one = -0.9 * kPressed_m / (block[14] + block[17]),
               two = -1.1 * kPressed_m / (block[14] + block[17]);
  const std::array u{Vec3(0.001, 0, -kPressed_m), Vec3(0, 0, -kPressed_m)};
  const std::array f{Vec3(0, 0, one), Vec3(0, 0, two)};
  const std::array presses{press_of(nodes[0], u[0], f[0]), press_of(nodes[1], u[1], f[1])};
  const auto strength = imposed.impose(stepper, presses, state);
  EXPECT_NEAR(at(state.u, kTop).z(), -kPressed_m, 1e-6 * kPressed_m);
  EXPECT_NEAR(at(state.u, other).z(), -kPressed_m, 1e-6 * kPressed_m);
  EXPECT_NEAR(at(state.v, kTop).z(), -kPressed_m / 0.005, 1e-5);
  for (const double s : strength) EXPECT_NEAR(s, 1, 0.3);
}

TEST(ImposedPressTest, NoPressPullsAndNoneIsMoreThanTwiceAsStrong) {
  const HeldBody body = test::held_box();
  ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = 0.005});
  ImposedPress imposed(body.mesh.positions.size(), 1);
  BodyState state = state_at_rest(body.mesh.positions.size());
  const Vec3 up(0, 0, 0.01), far(0, 0, -0.05), f(0, 0, -0.1);
  EXPECT_EQ(imposed.impose(stepper, std::array{press_of(kTop, up, f)}, state)[0], 0);
  EXPECT_EQ(at(state.u, kTop), Vec3(0, 0, 0));
  EXPECT_EQ(imposed.impose(stepper, std::array{press_of(kTop, far, f)}, state)[0], 2);
  Press of_silent_hand = press_of(kTop, far, f);
  of_silent_hand.most_strength = 0.5;
  EXPECT_EQ(imposed.impose(stepper, std::array{of_silent_hand}, state)[0], 0.5);
}

TEST(ImposedPressTest, APatternThatMayPullDoesAndCountsFromHowStrongItWas) {
  const HeldBody body = test::held_box();
  ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = 0.005});
  ImposedPress imposed(body.mesh.positions.size(), 1);
  const Vec3 f(0, 0, -0.01), place(0, 0, 1e-6);
  Press press = press_of(kTop, place, f);
  press.least_strength = -1;
  BodyState state = state_at_rest(body.mesh.positions.size());
  const double strength = imposed.impose(stepper, std::array{press}, state)[0];
  EXPECT_LT(strength, 0);
  EXPECT_NEAR(at(state.u, kTop).z(), place.z(), 1e-6 * place.z());
  press.already = strength;
  EXPECT_NEAR(imposed.impose(stepper, std::array{press}, state)[0], strength, 1e-6 * std::abs(strength));
}

TEST(ImposedPressTest, APlaceWithAWallOfItsOwnIsDeeperByWhatThatYields) {
  const HeldBody body = test::held_box();
  ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = 0.005});
  ImposedPress imposed(body.mesh.positions.size(), 1);
  BodyState state = state_at_rest(body.mesh.positions.size());
  const Vec3 u(0, 0, -kPressed_m), f(0, 0, -0.1);
  const double wall_m_n = 0.02;
  Press press = press_of(kTop, u, f);
  press.own_yield_j = wall_m_n * f.squaredNorm();
  const double strength = imposed.impose(stepper, std::array{press}, state)[0];
  EXPECT_GT(strength, 0.1);
  EXPECT_LT(strength, Press::kMostStrength);
  EXPECT_NEAR(at(state.u, kTop).z() + strength * wall_m_n * f.z(), -kPressed_m, 1e-6 * kPressed_m);
}

TEST(ImposedPressTest, TakesNoMemory) {
  const HeldBody body = test::held_box();
  ImplicitStep stepper(body.mesh, test::kTissue, body.inertia, {.step_s = 0.005});
  ImposedPress imposed(body.mesh.positions.size(), 1);
  BodyState state = state_at_rest(body.mesh.positions.size());
  const Vec3 u(0, 0, -0.001), f(0, 0, -0.1);
  std::vector<double> next(body.components());
  const std::size_t before = test::heap_allocations();
  imposed.impose(stepper, std::array{press_of(kTop, u, f)}, state);
  stepper.foresee(state, next, next);
  EXPECT_EQ(test::heap_allocations(), before);
}

// ---- a hand that knows the body from what was sent some milliseconds ago

struct Link {
  double hand_hz, organ_hz, delay_s, density_kg_m3;
};

// What the organ's side sends: x(f, t) = place + t speed + compliance (f - force), of kTop along z.
struct LocalAnswer {
  double arrives_s = 0, place = 0, speed = 0, force = 0, compliance = 1;
};

// What the hand's side sends.
struct HandContact {
  double arrives_s = 0, place = 0, force = 0;
};

struct Felt {
  double hold_n = 0;   // mean, while the hand stands still
  double given_j = 0;  // to the hand, while it moves up and down
};

// Down to kPressed_m within 0.1 s, still until 1.5 s, then up and down by 1 mm at 3 Hz.
double hand_at(double t) {
  if (t < 1.5) return -kPressed_m * std::clamp((t - 0.2) / 0.1, 0.0, 1.0);
  return -kPressed_m - 0.001 * std::sin(2 * EIGEN_PI * 3 * (t - 1.5));
}

// The newest of what has come by now.
template <class T>
void receive(std::deque<T>& under_way, double t, T& newest) {
  while (!under_way.empty() && under_way.front().arrives_s <= t) {
    newest = under_way.front();
    under_way.pop_front();
  }
}

// A body in fixed steps under the contact that came last.
class Organ {
 public:
  static constexpr double kStep_s = 0.005;

  explicit Organ(double density_kg_m3)
      : tissue_{test::kTissue.young_pa, test::kTissue.poisson, density_kg_m3},
        body_(test::held_box()),
        inertia_{lumped_masses(body_.mesh, tissue_), body_.inertia.fixed, 5, 0},
        stepper_(body_.mesh, tissue_, inertia_, {.step_s = kStep_s}),
        imposed_(body_.mesh.positions.size(), 1),
        state_(state_at_rest(body_.mesh.positions.size())),
        none_(body_.components()),
        next_(body_.components()) {}

  void advance(double dt_s, const HandContact& contact) {
    const Vec3 u(0, 0, contact.place), f(0, 0, contact.force);
    for (ahead_s_ += dt_s; ahead_s_ >= kStep_s; ahead_s_ -= kStep_s) {
      ASSERT_TRUE(stepper_.step(state_, none_));
      force_ = contact.force * imposed_.impose(stepper_, std::array{press_of(kTop, u, f)}, state_)[0];
    }
  }

  LocalAnswer answer(double arrives_s) {
    std::vector<double> external = none_;
    external[3 * kTop + 2] = force_;
    stepper_.foresee(state_, external, next_);
    std::vector<float> block(9);
    stepper_.compliance(std::array{kTop}, block);
    const double place = at(state_.u, kTop).z();
    return {arrives_s, place, (at(next_, kTop).z() - place) / kStep_s, force_, block[8]};
  }

 private:
  Material tissue_;
  HeldBody body_;
  Inertia inertia_;
  ImplicitStep stepper_;
  ImposedPress imposed_;
  BodyState state_;
  std::vector<double> none_, next_;
  double ahead_s_ = 0, force_ = 0;
};

Felt feel(const Link& link) {
  Organ organ(link.density_kg_m3);
  std::deque<LocalAnswer> answers;
  std::deque<HandContact> contacts;
  LocalAnswer known;
  HandContact contact;
  double organ_due_s = 0;
  Felt felt;
  int held = 0;
  const double period_s = 1 / link.hand_hz;
  for (double t = 0; t < 3; t += period_s) {
    receive(answers, t, known);
    const double x = known.place + std::min(t - known.arrives_s, 0.02) * known.speed;
    const double f = std::min(0.0, known.force + (hand_at(t) - x) / known.compliance);
    contacts.push_back({t + link.delay_s / 2, x + known.compliance * (f - known.force), f});
    if (t >= 1.5) felt.given_j += -f * (hand_at(t + period_s) - hand_at(t));
    if (t > 0.9 && t < 1.5) felt.hold_n += (-f - felt.hold_n) / ++held;
    if (t < organ_due_s) continue;
    organ_due_s += 1 / link.organ_hz;
    receive(contacts, t, contact);
    organ.advance(1 / link.organ_hz, contact);
    answers.push_back(organ.answer(t + link.delay_s / 2));
  }
  return felt;
}

double static_force_n() {
  const HeldBody body = test::held_box();
  std::vector<Vec3> loads(body.mesh.positions.size(), Vec3::Zero());
  loads[kTop].z() = -1;
  const auto exact = direct_solve(body.stiffness_without({}), body.inertia.fixed, {}, loads);
  return kPressed_m / -exact.displacements[kTop].z();
}

TEST(ImposedPressTest, AHoldForceIsTheSameAtAllRatesAndDelaysAndNoEnergyComesBack) {
  const double expected_n = static_force_n();
  for (const double density_kg_m3 : {100.0, 10000.0}) {
    for (const double hand_hz : {300.0, 1000.0}) {
      for (const double organ_hz : {60.0, 200.0}) {
        for (const double delay_s : {0.002, 0.02}) {
          const Felt felt = feel({hand_hz, organ_hz, delay_s, density_kg_m3});
          EXPECT_NEAR(felt.hold_n, expected_n, 0.02 * expected_n) << hand_hz << " Hz, " << organ_hz << " Hz";
          EXPECT_LE(felt.given_j, 0) << hand_hz << " Hz, " << organ_hz << " Hz, " << delay_s << " s";
        }
      }
    }
  }
}

}  // namespace
}  // namespace omentum::physics
