// What an organ with masses tells the hand, and what it does where its integration fails.
#include "tests/deform_node/dynamic_beam.h"

namespace omentum::deform {
namespace {

/// One whose whole steps make energy of nothing, and whose shorter ones do so on demand.
class Exploding final : public BodyStepper {
 public:
  Exploding(std::vector<double> mass, bool also_shorter)
      : mass_(std::move(mass)), also_shorter_(also_shorter) {}

  double step_s() const override { return kTick_s; }
  std::span<const double> mass() const noexcept override { return mass_; }
  std::optional<double> step(physics::BodyState& state, BodyLoads&) noexcept override {
    state.v.back() = 1e3;
    return 0;
  }
  std::optional<double> step_shorter(physics::BodyState& state, BodyLoads& f) noexcept override {
    return also_shorter_ ? step(state, f) : 0;
  }
  double elastic_energy(std::span<const double>) noexcept override { return 0; }
  bool remove(std::span<const geometry::TetId>) noexcept override { return true; }
  void restore(std::span<const geometry::TetId>) noexcept override {}
  void compliance(std::span<const NodeId>, std::span<float>) noexcept override {}
  void foresee(const physics::BodyState&, std::span<const double>, std::span<double>) noexcept override {}
  void yield_to(std::span<const double>, std::span<double>) noexcept override {}

 private:
  std::vector<double> mass_;
  bool also_shorter_;
};

TEST_F(DynamicModelTest, AStepThatWouldDivergeIsTakenAgainInShorterOnesAndSaid) {
  DynamicParts exploding = parts();
  exploding.stepper = std::make_unique<Exploding>(exploding.body.inertia.mass, false);
  DynamicModel model(std::move(exploding));
  model.step({}, kTick_s);
  EXPECT_FALSE(model.status().diverged);
  EXPECT_NE(model.status().fault.find("shorter steps"), std::string_view::npos);
}

TEST_F(DynamicModelTest, WhatDivergesInShorterStepsTooSaysSoUntilItIsReset) {
  DynamicParts exploding = parts();
  exploding.stepper = std::make_unique<Exploding>(exploding.body.inertia.mass, true);
  DynamicModel model(std::move(exploding));
  model.step({}, kTick_s);
  EXPECT_TRUE(model.status().diverged);
  model.reset();
  EXPECT_FALSE(model.status().diverged);
}

// A hand that presses harder, as far as the local model lets it come by that, ends the step where it
// foretold.
TEST_F(DynamicModelTest, ALocalModelForetellsTheNextStep) {
  DynamicModel model(parts(kTick_s));
  const std::array<NodeId, 1> nodes{nearest({kLength_m, kThick_m / 2, kThick_m})};
  const std::array<Vec3, 1> forces{Vec3(0.01, 0.02, -0.1)}, place{Vec3(1e-4, 2e-4, -1e-3)};
  const ToolLoad load{.tool = 0, .nodes = nodes, .displacements = place, .forces = forces};
  pass(model, 0.05, {.presses = {&load, 1}, .cuts = {}});
  LocalPatch patch(BodyStepper::kPatchNodes);
  ASSERT_TRUE(model.local_model({0, mesh_.positions[nodes[0]], 0.015}, patch));

  const auto pressed = std::ranges::find(patch.nodes, static_cast<std::uint32_t>(mesh_.file_node[nodes[0]]));
  const auto at = static_cast<std::size_t>(pressed - patch.nodes.begin());
  ASSERT_LT(at, patch.node_count);
  const Vec3 more(0.01, 0, -0.05);
  const auto C = [&](std::size_t row, std::size_t column) {
    const std::size_t r = std::min(row, column), c = std::max(row, column), n = patch.node_count;
    return patch.compliance[r * (6 * n - r - 1) / 2 + c];
  };
  const auto foretold = [&](std::size_t i) {
    Vec3 x = patch.positions[i] + kTick_s * patch.velocities[i];
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t of = 0; of < 3; ++of)
        x[static_cast<int>(axis)] += C(3 * i + axis, 3 * at + of) * more[static_cast<int>(of)];
    return x;
  };
  const std::array<Vec3, 1> harder{Vec3(patch.forces[at] + more)},
      deeper{Vec3(foretold(at) - mesh_.positions[nodes[0]])};
  const ToolLoad next{.tool = 0, .nodes = nodes, .displacements = deeper, .forces = harder};
  model.step({.presses = {&next, 1}, .cuts = {}}, kTick_s);
  for (std::size_t i = 0; i < patch.node_count; ++i) {
    const NodeId n(static_cast<std::size_t>(patch.nodes[i]));
    const Vec3 is = mesh_.positions[n] + shown(model, n);
    EXPECT_LE((is - foretold(i)).norm(), 1e-7) << is.transpose() << " for " << foretold(i).transpose();
  }
}

// The hand is ahead of an organ that fell behind the clock: what its jaws hold is told all the same.
TEST_F(DynamicModelTest, ALocalModelHasWhatItsToolGraspsHoweverFarItIs) {
  DynamicModel model(parts());
  const geometry::MeshEditor editor(mesh_);
  const auto& nodes = editor.faces().front().nodes;
  const std::array<Vec3, 3> forces{Vec3(0, 0, 1e-3), Vec3(0, 0, 1e-3), Vec3(0, 0, 1e-3)}, places{};
  ToolLoad load{.tool = 1, .nodes = nodes, .displacements = places, .forces = forces, .grasps = true};
  const PatchPlace far{1, mesh_.positions[nodes[0]] + Vec3(0, 0, 0.1), 0.015};
  LocalPatch patch(BodyStepper::kPatchNodes);
  model.step({.presses = {&load, 1}, .cuts = {}}, kTick_s);
  ASSERT_TRUE(model.local_model(far, patch));
  ASSERT_EQ(patch.node_count, nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_EQ(patch.nodes[i], static_cast<std::uint32_t>(mesh_.file_node[nodes[i]]));
  EXPECT_FALSE(model.local_model({0, far.centre, far.radius_m}, patch)) << "another tool holds nothing";
  load.grasps = false;
  model.step({.presses = {&load, 1}, .cuts = {}}, kTick_s);
  EXPECT_FALSE(model.local_model(far, patch)) << "what only touches is where the tool is";
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
