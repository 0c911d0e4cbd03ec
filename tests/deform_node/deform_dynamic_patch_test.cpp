// What an organ with masses tells the hand, and what it does where its integration fails.
#include "tests/deform_node/dynamic_beam.h"

namespace omentum::deform {
namespace {

/// One whose whole steps make energy of nothing, and whose shorter ones do so on demand.
class Exploding final : public BodyStepper {
 public:
  explicit Exploding(bool also_shorter) : also_shorter_(also_shorter) {}

  double step_s() const override { return kTick_s; }
  std::optional<double> step(physics::BodyState& state, std::span<const double>) noexcept override {
    state.v.back() = 1e3;
    return 0;
  }
  std::optional<double> step_shorter(physics::BodyState& state, std::span<const double> f) noexcept override {
    return also_shorter_ ? step(state, f) : 0;
  }
  double elastic_energy(std::span<const double>) noexcept override { return 0; }
  bool remove(std::span<const geometry::TetId>) noexcept override { return true; }
  void restore(std::span<const geometry::TetId>) noexcept override {}
  void compliance(std::span<const NodeId>, std::span<float>) noexcept override {}

 private:
  bool also_shorter_;
};

TEST_F(DynamicModelTest, AStepThatWouldDivergeIsTakenAgainInShorterOnesAndSaid) {
  DynamicParts exploding = parts();
  exploding.stepper = std::make_unique<Exploding>(false);
  DynamicModel model(std::move(exploding));
  model.step({}, kTick_s);
  EXPECT_FALSE(model.status().diverged);
  EXPECT_NE(model.status().fault.find("shorter steps"), std::string_view::npos);
}

TEST_F(DynamicModelTest, WhatDivergesInShorterStepsTooSaysSoUntilItIsReset) {
  DynamicParts exploding = parts();
  exploding.stepper = std::make_unique<Exploding>(true);
  DynamicModel model(std::move(exploding));
  model.step({}, kTick_s);
  EXPECT_TRUE(model.status().diverged);
  model.reset();
  EXPECT_FALSE(model.status().diverged);
}

// What the hand is told is what the next step does.
TEST_F(DynamicModelTest, ALocalModelForetellsTheNextStep) {
  DynamicModel model(parts(kTick_s)), pushed(parts(kTick_s));
  const std::array<NodeId, 1> nodes{nearest({kLength_m, kThick_m / 2, kThick_m})};
  const std::array<Vec3, 1> forces{Vec3(0.01, 0.02, -0.1)};
  const ToolLoad load{.tool = 0, .nodes = nodes, .displacements = forces, .forces = forces};
  pass(model, 0.05, {.presses = {&load, 1}, .cuts = {}});
  pass(pushed, 0.05, {.presses = {&load, 1}, .cuts = {}});
  LocalPatch patch(BodyStepper::kPatchNodes);
  ASSERT_TRUE(model.local_model({0, mesh_.positions[nodes[0]], 0.015}, patch));

  std::size_t at = 0;
  while (at < patch.node_count && patch.nodes[at] != static_cast<std::uint32_t>(mesh_.file_node[nodes[0]]))
    ++at;
  ASSERT_LT(at, patch.node_count);
  EXPECT_EQ(patch.forces[at], forces[0]);
  std::vector<Vec3> foretold;
  for (std::size_t i = 0; i < patch.node_count; ++i)
    foretold.push_back(patch.positions[i] + kTick_s * patch.velocities[i]);
  const Vec3 more(0, 0, -0.05);
  const std::array<Vec3, 1> larger{Vec3(forces[0] + more)};
  const ToolLoad harder{.tool = 0, .nodes = nodes, .displacements = larger, .forces = larger};
  model.step({.presses = {&load, 1}, .cuts = {}}, kTick_s);
  pushed.step({.presses = {&harder, 1}, .cuts = {}}, kTick_s);
  const auto C = [&](std::size_t row, std::size_t column) {
    const std::size_t r = std::min(row, column), c = std::max(row, column), n = patch.node_count;
    return patch.compliance[r * (6 * n - r - 1) / 2 + c];
  };
  for (std::size_t i = 0; i < patch.node_count; ++i) {
    const NodeId n(static_cast<std::size_t>(patch.nodes[i]));
    EXPECT_NEAR((mesh_.positions[n] + shown(model, n) - foretold[i]).norm(), 0, 1e-7) << "the force stayed";
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double foretold = C(3 * i + axis, 3 * at + 2) * more.z();
      const double is = shown(pushed, n)[static_cast<Eigen::Index>(axis)] -
                        shown(model, n)[static_cast<Eigen::Index>(axis)];
      EXPECT_NEAR(is, foretold, 1e-7);
    }
  }
}

TEST_F(DynamicModelTest, ALocalModelIsOfTheCutSurface) {
  DynamicModel model(parts());
  const Vec3 inside(0.05, kThick_m / 2, kThick_m / 2);
  LocalPatch patch(BodyStepper::kPatchNodes);
  EXPECT_FALSE(model.local_model({0, inside, 0.01}, patch));
  const CutStroke stroke = stroke_at(0.05);
  model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  ASSERT_TRUE(model.local_model({0, inside, 0.02}, patch));
  EXPECT_EQ(patch.topology_version, 1u);
  EXPECT_GT(patch.triangle_count, 0u);
  for (std::size_t i = 0; i < patch.triangle_count; ++i)
    for (const std::uint8_t corner : patch.triangles[i]) EXPECT_LT(corner, patch.node_count);
}

}  // namespace
}  // namespace omentum::deform
