// Several bodies, bodies that come and go, and a body of another kind than any the product knows.
#include "haptic_fixtures.h"
#include "haptic_node/body_change.h"
#include "haptic_node/enclosed_tool.h"

#include <algorithm>
#include <numbers>

namespace omentum::haptic_test {
namespace {

using haptic::Body;
using haptic::BodyId;
using haptic::SurfacePoint;

// Of sums in another order, relative.
constexpr double kSameForce = 1e-6;
constexpr double kTop_m = 0.04;  // of the block

// ---- a toy: a bed of springs that fills z <= height, without a mesh; its one node bears what all points
// bear

class SpringBed final : public Body {
 public:
  SpringBed(double height_m, double stiffness_n_m)
      : Body({}, 1), height_m_(height_m), compliance_(1 / stiffness_n_m), node_(0, 0, height_m) {}

  void restore_rest() noexcept override { force_.setZero(); }
  void propose(std::span<const SurfaceId> nodes, std::span<const Vec3> forces) noexcept override {
    proposed_ = nodes.empty() ? Vec3(0, 0, 0) : forces[0];
  }
  void accept() noexcept override {
    moved_m_ = compliance_ * (proposed_ - force_).norm();
    force_ = proposed_;
  }
  double motion_bound(const SurfacePoint&) const noexcept override {
    return compliance_ * (proposed_ - force_).norm();
  }
  Eigen::Matrix3f block(SurfaceId, SurfaceId) const noexcept override {
    return static_cast<float>(compliance_) * Eigen::Matrix3f::Identity();
  }
  double beyond_neighbours(SurfaceId) const noexcept override { return compliance_; }
  int loaded_nodes() const noexcept override { return force_.isZero(0) ? 0 : 1; }
  int evaluated_nodes() const noexcept override { return 1; }

  void evaluate(const haptic::Region&) noexcept override {}
  haptic::Encounter meet(const Vec3& p, const Vec3& q, double radius_m, bool outside) noexcept override {
    const double before_m = p.z() - surface_m(), now_m = q.z() - surface_m();
    haptic::Encounter met{std::nullopt, std::min(std::abs(now_m), radius_m), std::nullopt};
    if (outside && (before_m < 0 || now_m < 0)) met.touched = point_below(q);
    if (now_m >= 0 && now_m <= radius_m) met.nearest = point_below(q);
    return met;
  }
  std::optional<haptic::Immersion> immersion(const Vec3& p, double reach_m) noexcept override {
    const double depth_m = surface_m() - p.z();
    if (depth_m <= 0 || depth_m > reach_m) return std::nullopt;
    return haptic::Immersion{point_below(p), depth_m};
  }
  double known_motion() const noexcept override { return moved_m_; }
  double entered_motion() const noexcept override { return 0; }

  SurfacePoint slide(const SurfacePoint&, const Vec3& p) noexcept override { return point_below(p); }
  void find_place(const SurfacePoint& point, haptic::Place& place) noexcept override {
    const Vec3 rest(point.barycentric.x(), point.barycentric.y(), height_m_);
    place = {rest + compliance_ * force_, rest, Vec3::UnitZ(), {{SurfaceId(0)}, Vec3(1, 0, 0), 1}};
  }
  Vec3 position(const SurfacePoint& point) noexcept override { return place_of(point).position; }
  double tissue_ahead(const SurfacePoint&, const Vec3&) noexcept override { return 1; }
  std::optional<SurfacePoint> nearest_at_rest(const Vec3& p, double reach_m) noexcept override {
    if (std::abs(p.z() - height_m_) > reach_m) return std::nullopt;
    return point_below(p);
  }
  const Vec3& position(SurfaceId) noexcept override { return node_; }
  double longest_edge(SurfaceId) const noexcept override { return 0; }

 private:
  double surface_m() const { return height_m_ + compliance_ * force_.z(); }
  // what the points of a mesh keep as barycentric coordinates are coordinates of the plane here
  static SurfacePoint point_below(const Vec3& p) { return {TriangleId(0), Vec3(p.x(), p.y(), 0)}; }

  double height_m_, compliance_;
  Vec3 node_, force_ = Vec3::Zero(), proposed_ = Vec3::Zero();
  double moved_m_ = 0;
};

TEST(Bodies, OneOfAnotherKindIsPressedLikeAny) {
  haptic::HapticModel model;
  model.tools = {needle()};
  Bench bench(with_spare_place(std::move(model)));
  constexpr double kStiffness_n_m = 500, kDepth_m = 0.003;
  bench.work().doors[0].post(std::make_unique<SpringBed>(0.0, kStiffness_n_m));
  bench.step_to({0, 0, 0.01});
  const Vec3 pressed = bench.move_to({0, 0, -kDepth_m}, 200);
  EXPECT_NEAR(pressed.z(), kStiffness_n_m * kDepth_m, 1e-3 * pressed.z());
  EXPECT_NEAR(bench.move_to({0.05, 0, -kDepth_m}, 500).z(), pressed.z(), 1e-3 * pressed.z());
  EXPECT_EQ(bench.move_to({0.05, 0, 0.01}, 200), Vec3(0, 0, 0));
}

// ---- several organs

class TwoBlocks : public testing::Test {
 protected:
  // the block, and beside it the same one again
  static haptic::HapticModel both(std::vector<haptic::ToolModel> tools) {
    haptic::HapticModel model = make_model(block(), std::move(tools));
    model.organs.push_back(elastic_surface(block()));
    for (Vec3& x : model.organs.back().rest) x += kBeside;
    return model;
  }

  static inline const Vec3 kBeside{0.12, 0, 0};
};

TEST_F(TwoBlocks, EachIsPressedAsIfItWereAlone) {
  Bench alone(make_model(block(), {round_tool(), round_tool()}));
  Bench bench(both({round_tool(), round_tool()}));
  const Vec3 left(0.043, 0.052, 0.05), right(0.06, 0.055, 0.05), down(0, 0, -0.014);
  Bench elsewhere(make_model(block(), {round_tool()}));
  alone.place(1, {0, 0, 1});
  for (int i = 0; i <= 300; ++i) {
    const Vec3 way = down * i / 300;
    const Vec3 one = alone.step_to(left + way);
    const Vec3 other = elsewhere.step_to(right + way);
    bench.place(0, left + way).place(1, right + kBeside + way).step();
    EXPECT_LE((bench.output(0).force - one).norm(), kSameForce * (1 + one.norm()));
    EXPECT_LE((bench.output(1).force - other).norm(), kSameForce * (1 + other.norm()));
  }
  EXPECT_GT(bench.output(0).force.z(), 0.1);
  EXPECT_GT(bench.output(1).force.z(), 0.1);
}

TEST_F(TwoBlocks, OneToolMayTouchBothAtOnce) {
  haptic::ToolModel bar;
  bar.points = {Vec3(-0.03, 0, 0), Vec3(0.03, 0, 0)};
  Bench bench(both({bar}));
  const Vec3 over(0.11, 0.05, kTop_m + 0.002);
  bench.step_to(over);
  bench.move_to(over - Vec3(0, 0, 0.006), 200);
  std::array<double, 2> pushed{};
  for (const haptic::NodeForce& entry : bench.state().forces())
    pushed[static_cast<std::size_t>(entry.body)] -= entry.force.z();
  EXPECT_GT(pushed[0], 0.05);
  EXPECT_GT(pushed[1], 0.05);
  EXPECT_NEAR(pushed[0] + pushed[1], bench.output().force.z(), 0.02 * bench.output().force.z());
}

TEST_F(TwoBlocks, PointsBetweenThemBearBothSides) {
  // a sphere wider than the gap, pushed down into it
  haptic::ToolModel ball;
  constexpr double kRadius_m = 0.015;
  for (int i = 0; i < 8; ++i) {
    const double turn = i * std::numbers::pi / 4;
    ball.points.emplace_back(kRadius_m * std::cos(turn), 0, kRadius_m * std::sin(turn));
  }
  Bench bench(both({ball}));
  const Vec3 over(0.11, 0.05, kTop_m + 0.02);
  bench.step_to(over);
  const Vec3 force = bench.move_to(over - Vec3(0, 0, 0.023), 400);
  EXPECT_GT(force.z(), 0.05);
  EXPECT_LT(std::abs(force.x()), 0.5 * force.z()) << "both sides push";
  for (const haptic::ToolContact& contact : bench.state().active())
    EXPECT_EQ(contact.body, BodyId(contact.place.rest.x() < 0.11 ? 0 : 1));
}

TEST_F(TwoBlocks, MoreNearPointsThanContactsLoseNoPress) {
  // two blocks at one place: every point is near both
  haptic::HapticModel model = make_model(block(), {round_tool(), round_tool(), round_tool(), round_tool()});
  model.organs.push_back(model.organs.front());
  Bench bench(std::move(model));
  const std::array<Vec3, 4> places = {Vec3(0.03, 0.03, 0), Vec3(0.07, 0.03, 0), Vec3(0.03, 0.07, 0),
                                      Vec3(0.07, 0.07, 0)};
  for (int i = 0; i <= 400; ++i) {
    for (std::size_t t = 0; t < 4; ++t) bench.place(t, places[t] + Vec3(0, 0, kTop_m + 0.004 - 2.5e-5 * i));
    bench.step();
    ASSERT_LE(bench.state().contact_count, physics::kMaxContacts);
  }
  for (std::size_t t = 0; t < 4; ++t) EXPECT_GT(bench.output(t).force.z(), 0.05) << "tool " << t;
}

// ---- bodies that come and go

std::unique_ptr<Body> body_of(const haptic::ElasticSurface& organ) {
  return std::make_unique<haptic::DeformedSurface>(organ.surface, organ.rest, organ.compliance);
}

class Exchange : public testing::Test {
 protected:
  Bench bench_{with_spare_place(make_model(block(), {round_tool()}))};
  const Vec3 over_{0.05, 0.05, kTop_m + 0.003}, pressed_{0.05, 0.05, kTop_m - 0.004};
};

TEST_F(Exchange, AHandFeelsNothingOfAnEqualBody) {
  Bench undisturbed(make_model(block(), {round_tool()}));
  for (Bench* bench : {&bench_, &undisturbed}) {
    bench->step_to(over_);
    bench->move_to(pressed_, 200);
  }
  bench_.work().doors[0].post(body_of(bench_.model().organs[0]));
  for (int i = 0; i < 50; ++i) {
    const Vec3 expected = undisturbed.step_to(pressed_);
    EXPECT_LE((bench_.step_to(pressed_) - expected).norm(), 1e-5 * expected.norm()) << "tick " << i;
  }
  EXPECT_LE((bench_.move_to(over_, 200)).norm(), 1e-9);
}

TEST_F(Exchange, WhoTouchesABodyThatGoesLetsGo) {
  bench_.step_to(over_);
  ASSERT_GT(bench_.move_to(pressed_, 200).norm(), 0.1);
  bench_.work().doors[0].post(nullptr);
  EXPECT_EQ(bench_.step_to(pressed_), Vec3(0, 0, 0));
  EXPECT_EQ(bench_.state().contact_count, 0);
}

TEST_F(Exchange, AToolInsideOfABodyThatComesIsHeldWhereItIs) {
  bench_.work().doors[0].post(nullptr);
  bench_.step_to(pressed_);
  bench_.work().doors[0].post(body_of(bench_.model().organs[0]));
  for (int i = 0; i < 5; ++i) EXPECT_LE(bench_.step_to(pressed_).norm(), 1e-6);
  EXPECT_GT(bench_.move_to(pressed_ - Vec3(0, 0, 0.002), 100).z(), 0.05) << "it is pressed from there";
}

// A person reset the session: nothing was pressed on the way in.
TEST_F(Exchange, ATipAroundWhichAResetBringsTissueBackPressesNothingUntilItWasOutside) {
  const Vec3 deeper = pressed_ - Vec3(0, 0, 0.01), beside = pressed_ + Vec3(0.02, 0.01, 0);
  bench_.work().doors[0].post(nullptr);
  bench_.step_to(deeper);
  haptic::expect_tissue_back(bench_.state().now_ns, bench_.state());
  bench_.work().doors[0].post(body_of(bench_.model().organs[0]));
  bench_.step_to(deeper);
  bench_.state().now_ns += 1'000'000'000;
  for (const Vec3& place : {beside, pressed_, deeper, pressed_}) {
    for (int i = 0; i < 100; ++i) {
      const Vec3 from = bench_.input().frame.p_WT;
      ASSERT_EQ(bench_.step_to(from + (place - from) / (100 - i)), Vec3(0, 0, 0)) << place.transpose();
    }
  }
  EXPECT_EQ(bench_.move_to(over_, 100), Vec3(0, 0, 0));
  EXPECT_GT(bench_.move_to(pressed_, 100).z(), 0.1) << "from outside it is a press";
}

TEST_F(Exchange, WhoPressesSoonAfterAResetIsNotTakenForEnclosed) {
  haptic::expect_tissue_back(bench_.state().now_ns, bench_.state());
  bench_.step_to(over_);
  EXPECT_GT(bench_.move_to(pressed_, 100).z(), 0.1);
  bench_.state().now_ns += 1'000'000'000;
  bench_.step_to(pressed_);
  haptic::ToolState& tool = bench_.state().tools[0];
  for (std::size_t p = 0; p < tool.now.size(); ++p) EXPECT_FALSE(tool.memory(BodyId(0), p).enclosed);
}

TEST_F(Exchange, WhatGrewOverATipHoldsItWhereItIs) {
  bench_.step_to(over_);
  haptic::ElasticSurface grown = bench_.model().organs[0];
  for (Vec3& x : grown.rest) x.z() += 0.004;  // a millimetre above the tip
  bench_.work().doors[0].post(body_of(grown));
  for (int i = 0; i < 5; ++i) EXPECT_LE(bench_.step_to(over_).norm(), 1e-6);
  EXPECT_GT(bench_.move_to(over_ - Vec3(0, 0, 0.003), 150).z(), 0.05) << "it is pressed from there";
  bench_.work().doors[0].post(nullptr);
  bench_.step();
}

TEST_F(Exchange, ATipThatLosesItsTissueIsHeldWhenTissueComesBack) {
  bench_.step_to(over_);
  ASSERT_GT(bench_.move_to(pressed_, 200).norm(), 0.1);
  haptic::ElasticSurface elsewhere = bench_.model().organs[0];
  for (Vec3& x : elsewhere.rest) x.x() += 0.3;
  bench_.work().doors[0].post(body_of(elsewhere));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(bench_.step_to(pressed_), Vec3(0, 0, 0));
  bench_.work().doors[0].post(nullptr);
  bench_.step();
  bench_.work().doors[0].post(body_of(bench_.model().organs[0]));
  for (int i = 0; i < 5; ++i) EXPECT_LE(bench_.step_to(pressed_).norm(), 1e-6);
  EXPECT_GT(bench_.move_to(pressed_ - Vec3(0, 0, 0.002), 100).z(), 0.05);
}

TEST_F(Exchange, JawsDoNotHoldWhatIsGone) {
  haptic::ToolModel grasper = round_tool();
  grasper.grasps = true;
  Bench bench(make_model(block(), {grasper}));
  bench.place(0, over_, 0.3).step();
  for (int i = 1; i <= 200; ++i) bench.place(0, over_ + (pressed_ - over_) * i / 200, 0.3).step();
  bench.place(0, pressed_, 0.05).step();
  ASSERT_TRUE(bench.output().grasping);
  bench.work().doors[0].post(nullptr);
  bench.place(0, pressed_, 0.05).step();
  EXPECT_FALSE(bench.output().grasping);
}

TEST_F(Exchange, WhatStoodThereIsFreedByWhoHandsOver) {
  struct Counted final : haptic::DeformedSurface {
    Counted(const haptic::ElasticSurface& organ, int& alive_)
        : DeformedSurface(organ.surface, organ.rest, organ.compliance), alive(alive_) {
      ++alive;
    }
    ~Counted() override { --alive; }
    int& alive;
  };
  int alive = 0;
  for (int i = 0; i < 20; ++i) {
    bench_.work().doors[0].post(std::make_unique<Counted>(bench_.model().organs[0], alive));
    const int before = alive;
    bench_.step_to(over_);
    EXPECT_EQ(alive, before) << "the loop freed one";
    EXPECT_LE(alive, 4);
  }
}

}  // namespace
}  // namespace omentum::haptic_test
