// Two tools in one place: what each hand feels depends on where both are, not on whose id is which or who
// came first. On the scene's phantom with its equal tips, 6 mm deep around the hand's press point, upright.
#include "geometry/rotation.h"
#include "tests/haptic_node/haptic_fixtures.h"
#include "tests/support/trial_organs.h"

#include <algorithm>
#include <optional>
#include <string>

namespace omentum::haptic_test {
namespace {

constexpr double kDepth_m = 6e-3, kHover_m = 6e-3, kStep_m = 2e-5;
// A hand tells forces apart that differ by a tenth.
constexpr double kSame = 0.01;
// A step that a hand does not feel, of its force; and below this force, N, of this one.
constexpr double kUnfelt = 0.02, kLeast_n = 0.2;
constexpr std::array<double, 11> kDistances_m = {0,    0.5e-3, 1e-3,  2e-3,  4e-3, 6e-3,
                                                 8e-3, 10e-3,  15e-3, 20e-3, 25e-3};

const Vec3 kPressPoint(-0.0479, -0.0149, 0.0276);
const Vec3 kNormal = Vec3(-0.15, -0.15, 0.977).normalized();

// What both hands feel.
struct TwoForces {
  double at_a_n, at_b_n;
};

enum class Arrival { kTogether, kAFirst, kBFirst };

std::string at(double distance_m, Arrival arrival) {
  constexpr std::array kNames = {"together", "A first", "B first"};
  return std::to_string(distance_m) + " m apart, " + kNames[static_cast<std::size_t>(arrival)];
}

// The scene's organ and its tip so many times, without trocars.
class Phantom {
 public:
  static const haptic::HapticModel* with_tools(std::size_t count) {
    static const auto organ = test::make_trial_organ(test::organ_recipe("phantom"));
    if (!organ) return nullptr;
    static const haptic::ToolModel tip = test::scene_tools(false).front();
    static const haptic::HapticModel one = test::trial_model(*organ, {tip}),
                                     two = test::trial_model(*organ, {tip, tip});
    return count == 1 ? &one : &two;
  }
};

class Hands {
 public:
  explicit Hands(std::size_t count) : bench_(*Phantom::with_tools(count)) {
    for (std::size_t t = 0; t < count; ++t)
      bench_.input(t).frame.q_WT = geometry::rotation_onto(Vec3::UnitZ(), kNormal);
  }
  void appear(std::size_t tool, const Vec3& tip) { bench_.place(tool, tip).step(); }
  /// Straight, in steps of 20 um; the work that the hand gets is added to given_j().
  void go(std::size_t tool, const Vec3& way) {
    const Vec3 from = bench_.input(tool).frame.p_WT;
    const int steps = std::max(1, static_cast<int>(std::ceil(way.norm() / kStep_m)));
    for (int i = 1; i <= steps; ++i) {
      const Vec3 before = bench_.output(tool).force;
      bench_.step_to(from + way * i / steps, tool);
      given_j_ += 0.5 * (before + bench_.output(tool).force).dot(way) / steps;
      put_in_j_ = std::max(put_in_j_, -given_j_);
    }
  }
  void go_both(const Vec3& way_a, const Vec3& way_b) {
    const std::array<Vec3, 2> ways = {way_a, way_b}, before = {force(0), force(1)};
    for (std::size_t t = 0; t < 2; ++t) bench_.place(t, bench_.input(t).frame.p_WT + ways[t]);
    bench_.step();
    for (std::size_t t = 0; t < 2; ++t) given_j_ += 0.5 * (before[t] + force(t)).dot(ways[t]);
    put_in_j_ = std::max(put_in_j_, -given_j_);
  }
  void go_together(const Vec3& way) {
    const int steps = static_cast<int>(std::ceil(way.norm() / kStep_m));
    for (int i = 0; i < steps; ++i) {
      for (std::size_t t = 0; t < 2; ++t) bench_.place(t, bench_.input(t).frame.p_WT + way / steps);
      bench_.step();
    }
  }
  Vec3 force(std::size_t tool) const { return bench_.output(tool).force; }
  double stored_j() const { return bench_.output(0).stored_j + bench_.output(1).stored_j; }
  double given_j() const { return given_j_; }
  double put_in_j() const { return put_in_j_; }

 private:
  Bench bench_;
  double given_j_ = 0, put_in_j_ = 0;
};

const Vec3 kAlong = (Vec3::UnitX() - kNormal.x() * kNormal).normalized();
const Vec3 kDown = -(kHover_m + kDepth_m) * kNormal;

Vec3 above(double along_m) {
  return kPressPoint + along_m * kAlong + kHover_m * kNormal;
}

// Tool `a` at the press point, the other one so far from it.
TwoForces press(std::size_t a, double distance_m, Arrival arrival) {
  Hands hands(2);
  const std::size_t b = 1 - a;
  hands.appear(a, above(0));
  hands.appear(b, above(distance_m));
  if (arrival == Arrival::kTogether) {
    hands.go_together(kDown);
  } else {
    hands.go(arrival == Arrival::kAFirst ? a : b, kDown);
    hands.go(arrival == Arrival::kAFirst ? b : a, kDown);
  }
  return {hands.force(a).norm(), hands.force(b).norm()};
}

double press_alone(double along_m) {
  Hands hands(1);
  hands.appear(0, above(along_m));
  hands.go(0, kDown);
  return hands.force(0).norm();
}

class TwoTools : public testing::Test {
 protected:
  void SetUp() override {
    if (!Phantom::with_tools(2)) GTEST_SKIP() << "organ_phantom is not built";
  }
};

TEST_F(TwoTools, IdsDoNotCount) {
  for (const double distance_m : kDistances_m) {
    for (const Arrival arrival : {Arrival::kTogether, Arrival::kAFirst, Arrival::kBFirst}) {
      const TwoForces found = press(0, distance_m, arrival), swapped = press(1, distance_m, arrival);
      EXPECT_NEAR(swapped.at_a_n, found.at_a_n, kSame * found.at_a_n) << at(distance_m, arrival);
      EXPECT_NEAR(swapped.at_b_n, found.at_b_n, kSame * found.at_b_n) << at(distance_m, arrival);
    }
  }
}

TEST_F(TwoTools, TheHandsDoNotFeelWhoCameFirst) {
  for (const double distance_m : kDistances_m) {
    const TwoForces together = press(0, distance_m, Arrival::kTogether);
    for (const Arrival arrival : {Arrival::kAFirst, Arrival::kBFirst}) {
      const TwoForces found = press(0, distance_m, arrival);
      EXPECT_NEAR(found.at_a_n, together.at_a_n, kSame * together.at_a_n) << at(distance_m, arrival);
      EXPECT_NEAR(found.at_b_n, together.at_b_n, kSame * together.at_b_n) << at(distance_m, arrival);
    }
  }
}

TEST_F(TwoTools, NoneTakesAllThatAnotherWouldFeelAlone) {
  // tissue bulges beside a dent: a neighbour may lend a little
  constexpr double kLeastPart = 0.25, kLent = 0.05;
  const double alone_n = press_alone(0);
  for (const double distance_m : kDistances_m) {
    const TwoForces both = press(0, distance_m, Arrival::kTogether);
    const double other_n = press_alone(distance_m);
    EXPECT_GT(both.at_a_n, kLeastPart * alone_n) << distance_m << " m apart";
    EXPECT_GT(both.at_b_n, kLeastPart * other_n) << distance_m << " m apart";
    EXPECT_LT(both.at_a_n, alone_n * (1 + kLent)) << distance_m << " m apart";
    EXPECT_LT(both.at_b_n, other_n * (1 + kLent)) << distance_m << " m apart";
  }
}

TEST_F(TwoTools, InOnePlaceTheyShareAlike) {
  const TwoForces both = press(0, 0, Arrival::kTogether);
  EXPECT_NEAR(both.at_a_n, both.at_b_n, 1e-9);
  EXPECT_GT(both.at_a_n, 0.5 * press_alone(0));
}

TEST_F(TwoTools, AToolThatPassesAnotherIsNoStep) {
  constexpr double kFrom_m = -12e-3;
  Hands hands(2), alone(1);
  hands.appear(0, above(0));
  hands.go(0, kDown);
  hands.appear(1, above(kFrom_m));
  hands.go(1, kDown);
  alone.appear(0, above(kFrom_m));
  alone.go(0, kDown);
  for (double along_m = kFrom_m; along_m < -kFrom_m; along_m += kStep_m) {
    const std::array<Vec3, 2> before = {hands.force(0), hands.force(1)};
    const Vec3 alone_before = alone.force(0);
    hands.go(1, kStep_m * kAlong);
    alone.go(0, kStep_m * kAlong);
    const double mesh_n = (alone.force(0) - alone_before).norm();
    for (const std::size_t t : {0, 1}) {
      const double limit_n = kUnfelt * std::max(kLeast_n, before[t].norm()) + mesh_n;
      ASSERT_LT((hands.force(t) - before[t]).norm(), limit_n) << "tool " << t << " at " << along_m << " m";
    }
  }
}

// -dE/dp: what a small way down or up puts in is what is stored more. Of the energy between the tools a part
// changes with the material points, without a force; the joint account keeps it.
TEST_F(TwoTools, EachHandsForceIsTheGradientOfWhatIsStored) {
  constexpr double kWay_m = 2e-4, kTolerance = 0.02;
  for (const double distance_m : kDistances_m) {
    Hands hands(2);
    hands.appear(0, above(0));
    hands.appear(1, above(distance_m));
    hands.go_together(kDown);
    for (const std::size_t tool : {0, 1}) {
      for (const double way_m : {kWay_m, -kWay_m}) {
        const double stored_j = hands.stored_j(), given_j = hands.given_j();
        hands.go(tool, -way_m * kNormal);
        const double put_in_j = given_j - hands.given_j();
        EXPECT_NEAR(hands.stored_j() - stored_j, put_in_j, kTolerance * std::abs(put_in_j))
            << distance_m << " m apart, tool " << tool << " by " << way_m;
      }
    }
  }
}

TEST_F(TwoTools, ClosedPathsOfBothHandsAreNoSource) {
  constexpr double kGain = 0.002, kLoss = 0.01;
  for (const double distance_m : {0.5e-3, 4e-3, 10e-3}) {
    for (const double slide_m : {0.0, 8e-3, -2 * distance_m}) {
      Hands hands(2);
      hands.appear(0, above(0));
      hands.appear(1, above(distance_m));
      hands.go(0, kDown);
      hands.go(1, kDown);
      hands.go(1, slide_m * kAlong);
      hands.go(1, -kDown);
      hands.go(1, -slide_m * kAlong);
      hands.go(0, -kDown);
      EXPECT_LT(hands.given_j(), kGain * hands.put_in_j()) << distance_m << " m apart, slides " << slide_m;
      EXPECT_GT(hands.given_j(), -kLoss * hands.put_in_j()) << distance_m << " m apart, slides " << slide_m;
    }
  }
}

// One after the other, in turns, without ever letting go: each turn would give the same again.
TEST_F(TwoTools, HandsThatTakeTurnsAreFedByNone) {
  Hands hands(2);
  hands.appear(0, above(0));
  hands.appear(1, above(4e-3));
  hands.go(0, kDown);
  hands.go(1, kDown);
  for (int turn = 0; turn < 8; ++turn) {
    for (const double way_m : {3e-3, -3e-3}) {
      hands.go(0, way_m * kNormal);
      hands.go(1, way_m * kNormal);
    }
    hands.go(1, 6e-3 * kAlong);
    hands.go(0, 2e-3 * kNormal);
    hands.go(1, -6e-3 * kAlong);
    hands.go(0, -2e-3 * kNormal);
    ASSERT_LE(hands.given_j(), 0) << "turn " << turn;
  }
}

// Round and round, in and out, never all the way: each hand in its own time.
struct Loop {
  double up_m, round_m;

  Vec3 at(double turn) const {
    const Vec3 side = kNormal.cross(kAlong);
    return up_m * std::sin(turn) * kNormal +
           round_m * ((std::cos(turn) - 1) * kAlong + std::sin(turn) * side);
  }
};

TEST_F(TwoTools, LoopsOfBothHandsFeedNone) {
  constexpr int kTurns = 12, kSteps = 400;
  constexpr std::array<std::array<Loop, 2>, 4> kLoops = {{{{{1e-3, 0}, {0, 6e-3}}},
                                                          {{{2e-3, 2e-3}, {2e-3, 3e-3}}},
                                                          {{{3e-3, 3e-3}, {3e-3, 0}}},
                                                          {{{1e-3, 4e-3}, {1e-3, 4e-3}}}}};
  for (const double distance_m : {1e-3, 10e-3}) {
    for (const auto& [a, b] : kLoops) {
      Hands hands(2);
      hands.appear(0, above(0));
      hands.appear(1, above(distance_m));
      hands.go(0, kDown);
      hands.go(1, kDown);
      for (int i = 0; i < kTurns * kSteps; ++i) {
        const double turn = 2 * M_PI / kSteps, before = i * turn, now = (i + 1) * turn;
        hands.go_both(a.at(2 * now) - a.at(2 * before), b.at(now) - b.at(before));
      }
      EXPECT_LE(hands.given_j(), 0) << distance_m << " m apart, " << a.up_m << ' ' << a.round_m << " and "
                                    << b.up_m << ' ' << b.round_m;
    }
  }
}

}  // namespace
}  // namespace omentum::haptic_test
