// An organ that is always in equilibrium, cut.
#include "tests/deform_node/dynamic_beam.h"
#include "tests/deform_node/static_cut_trials.h"

#include "physics/direct_solve.h"
#include "tests/support/heap_count.h"

#include <gmock/gmock.h>

namespace omentum::deform {
namespace {

using geometry::TetId;
using ::testing::Each;

class StaticModelTest : public DynamicModelTest {
 protected:
  DynamicParts static_parts() {
    DynamicParts made = parts(kTick_s);
    made.stepper = make_static_stepper(made.body, kTick_s);
    made.is_static = true;
    return made;
  }

  // What holds one node there, and where all others then are, in the rest of the beam.
  physics::StaticSolution directly(const DynamicModel& model, NodeId n, const Vec3& u) {
    geometry::MeshEditor editor(mesh_);
    editor.set_removed(model.view().removed_bits);
    geometry::TetraMesh left = mesh_;
    std::erase_if(left.tetrahedra, [&, t = 0](const auto&) mutable { return editor.is_removed(TetId(t++)); });
    physics::FixedComponents fixed = fixed_;
    for (std::size_t i = 0; i < fixed.size(); ++i)
      if (editor.uses(NodeId(i)) == 0) fixed[i] = physics::kPinned;
    const std::array imposed{physics::ImposedDisplacement{n, u}};
    return physics::direct_solve(physics::assemble_stiffness(left, material_), fixed, imposed, {});
  }

  void expect_rests(const DynamicModel& model, const physics::StaticSolution& solution) const {
    for (const NodeId n : surface_.node)
      EXPECT_LE((shown(model, n) - solution.displacements[n]).norm(), 1e-5 * 2e-3) << n;
  }

  // Presses the middle of the beam's upper side.
  const NodeId pressed_ = nearest({0.06, kThick_m / 2, kThick_m});
  const std::array<NodeId, 1> nodes_{pressed_};
  const std::array<Vec3, 1> place_{Vec3(0, 0, -2e-3)};
  std::array<Vec3, 1> force_{Vec3(0, 0, -1)};
  ToolLoad load_{.tool = 0, .nodes = nodes_, .displacements = place_, .forces = force_};
  const TickLoads press_{.presses = {&load_, 1}, .cuts = {}};

  // The force along z that holds the press by `model`, in a patch of its own.
  double held_n(const DynamicModel& model) const {
    LocalPatch patch(BodyStepper::kPatchNodes);
    EXPECT_TRUE(model.local_model({0, mesh_.positions[pressed_] + place_[0], 0.03}, patch));
    for (std::size_t i = 0; i < patch.node_count; ++i)
      if (NodeId(static_cast<std::size_t>(patch.nodes[i])) == pressed_) return patch.forces[i].z();
    ADD_FAILURE() << "the press is not in its patch";
    return 0;
  }
};

// As far as one component alone can say: the others of the node are free.
TEST_F(StaticModelTest, APressIsAtOnceWhatADirectSolveSays) {
  DynamicModel model(static_parts());
  const physics::StaticSolution free = directly(model, pressed_, place_[0]);
  force_[0] = free.holding_forces[0];  // then the place that the hand says is the node's in all components
  model.step(press_, kTick_s);
  expect_rests(model, free);
  EXPECT_NEAR(held_n(model), free.holding_forces[0].z(), 1e-5 * std::abs(free.holding_forces[0].z()));
}

TEST_F(StaticModelTest, CutBeneathAPressItIsInEquilibriumWithWhatIsLeft) {
  DynamicModel model(static_parts());
  force_[0] = directly(model, pressed_, place_[0]).holding_forces[0];
  model.step(press_, kTick_s);
  const double before_n = held_n(model);
  // a slit from below, half way through
  const CutStroke slit{.tool = 0,
                       .cut = 1,
                       .from = {Vec3(0.03, -1, -0.01), Vec3(0.03, 1, -0.01)},
                       .to = {Vec3(0.03, -1, 0.018), Vec3(0.03, 1, 0.018)}};
  model.step({.presses = {&load_, 1}, .cuts = {&slit, 1}}, kTick_s);
  EXPECT_GT(model.status().removed_tetrahedra, 0U);
  EXPECT_LT(std::abs(held_n(model)), 0.8 * std::abs(before_n)) << "what is left is softer";
  // until hand and organ agree
  for (int i = 0; i < 20; ++i) {
    force_[0] = directly(model, pressed_, place_[0]).holding_forces[0];
    model.step(press_, kTick_s);
  }
  expect_rests(model, directly(model, pressed_, place_[0]));
}

TEST_F(StaticModelTest, WhatIsCutOffIsDroppedInTheSameTick) {
  DynamicModel model(static_parts());
  const CutStroke stroke = stroke_at(0.05);
  model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  EXPECT_EQ(model.view().topology_version, 1U);
  geometry::MeshEditor editor(mesh_);
  editor.set_removed(model.view().removed_bits);
  EXPECT_EQ(editor.piece_count(), 1);
  EXPECT_EQ(editor.uses(nearest({kLength_m, 0, 0})), 0);
  EXPECT_GT(editor.uses(nearest({0, 0, 0})), 0);
  EXPECT_LT(model.status().cuts.lost_m3, kLength_m * kThick_m * kThick_m);
}

// The compliance of inner nodes that came to the surface is there with it.
TEST_F(StaticModelTest, ThePatchOfACutIsThatOfAFreshPrecomputation) {
  DynamicModel model(static_parts());
  const CutStroke notch{.tool = 0,
                        .cut = 1,
                        .from = {Vec3(0.07, -1, 0.03), Vec3(0.07, 1, 0.03)},
                        .to = {Vec3(0.07, -1, 0.05), Vec3(0.07, 1, 0.05)}};
  model.step({.presses = {}, .cuts = {&notch, 1}}, kTick_s);
  LocalPatch patch(BodyStepper::kPatchNodes);
  ASSERT_TRUE(model.local_model({0, Vec3(0.07, 0.02, 0.02), 0.03}, patch));
  bool is_bared = false;
  std::size_t at = 0;
  const std::size_t rows = 3 * patch.node_count;
  for (std::size_t i = 0; i < patch.node_count; ++i) {
    const NodeId n(static_cast<std::size_t>(patch.nodes[i]));
    is_bared |= !surface_.of_node[n].valid();
    EXPECT_EQ(patch.topology_version, 1U);
    // of a unit force along x alone
    physics::StaticSolution unit = directly(model, n, Vec3::UnitX());
    Eigen::Matrix3d holding;
    for (int axis = 0; axis < 3; ++axis)
      holding.col(axis) = directly(model, n, Vec3::Unit(axis)).holding_forces[0];
    const Eigen::Matrix3d C = holding.inverse();
    if (fixed_[n] == 0) {
      EXPECT_NEAR(patch.compliance[at], C(0, 0), 1e-5 * C.norm()) << i;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) at += rows - (3 * i + axis);
  }
  EXPECT_TRUE(is_bared);
}

// As of a piece that hangs by its last tetrahedron.
TEST_F(StaticModelTest, WhatIsSofterThanTissueIsNotToldToAHand) {
  material_ = physics::Material{.young_pa = 0.01, .poisson = 0.4, .density_kg_m3 = 1000};
  DynamicModel model(static_parts());
  LocalPatch patch(BodyStepper::kPatchNodes);
  EXPECT_FALSE(model.local_model({0, mesh_.positions[pressed_], 0.03}, patch));
}

TEST_F(StaticModelTest, OtherOrgansMeetAWall) {
  DynamicModel model(static_parts());
  ASSERT_FALSE(model.collidable().empty());
  for (const CollisionSphere& sphere : model.collidable()) EXPECT_TRUE(std::isinf(sphere.mass_kg));
}

TEST_F(StaticModelTest, AResetMakesItWholeAndATakenUpOneIsTheSame) {
  DynamicModel model(static_parts()), other(static_parts());
  const CutStroke stroke = stroke_at(0.07);
  model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  other.take_up(model.view().removed_bits, model.view().burnt_bits, 7);
  model.step(press_, kTick_s);
  other.step(press_, kTick_s);
  ASSERT_EQ(other.view().values.size(), model.view().values.size());
  for (std::size_t i = 0; i < model.view().values.size(); ++i)
    EXPECT_NEAR(other.view().values[i], model.view().values[i], 1e-5 * 2e-3);
  DynamicModel never(static_parts());
  model.reset();
  EXPECT_THAT(model.view().values, Each(0.0F));
  model.step(press_, kTick_s);
  never.step(press_, kTick_s);
  for (std::size_t i = 0; i < never.view().values.size(); ++i)
    EXPECT_FLOAT_EQ(model.view().values[i], never.view().values[i]);
}

TEST_F(StaticModelTest, NothingOfItTakesMemory) {
  DynamicModel model(static_parts());
  LocalPatch patch(BodyStepper::kPatchNodes);
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 20; ++i) {
    const CutStroke stroke = stroke_at(0.11 - 0.004 * i);
    model.step({.presses = {&load_, 1}, .cuts = {&stroke, i % 3 == 0 ? 1U : 0U}}, kTick_s);
    (void)model.local_model({0, Vec3(0.02, 0.02, kThick_m), 0.02}, patch);
    if (i == 12) model.reset();
  }
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_GT(model.status().removed_tetrahedra, 0U);
}

// The command static_cut_fuzz runs many more of them.
TEST(StaticCuts, RandomSequencesLeaveAWholeModel) {
  const std::array organs{HeldOrgan(test::make_box_mesh(8, 3, 3, {0.12, 0.04, 0.04}), 0.001),
                          HeldOrgan(test::make_box_mesh(7, 7, 1, {0.1, 0.1, 0.01}), 0.02),
                          HeldOrgan(test::make_box_mesh(5, 4, 4, {0.06, 0.06, 0.06}), 0.001)};
  for (std::uint32_t seed = 0; seed < 6; ++seed)
    EXPECT_EQ(try_static_cuts(organs[seed % organs.size()], seed, 60), "") << "seed " << seed;
}

TEST(StaticCuts, RandomSequencesWhosePiecesFallDoSoToo) {
  const HeldOrgan beam(test::make_box_mesh(8, 3, 3, {0.12, 0.04, 0.04}), 0.001);
  for (std::uint32_t seed = 0; seed < 3; ++seed)
    EXPECT_EQ(try_falling_cuts(beam, seed, 60), "") << "seed " << seed;
}

}  // namespace
}  // namespace omentum::deform
