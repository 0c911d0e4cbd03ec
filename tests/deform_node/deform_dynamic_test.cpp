#include "tests/deform_node/dynamic_beam.h"

#include "physics/stiffness_factor.h"
#include "tests/support/heap_count.h"

#include <gmock/gmock.h>

namespace omentum::deform {
namespace {

using geometry::TetId;
using ::testing::Each;
using ::testing::ElementsAreArray;

TEST_F(DynamicModelTest, AtRestItStaysAtRest) {
  DynamicModel model(parts());
  pass(model, 1);
  EXPECT_THAT(model.view().values, Each(0.0F));
  EXPECT_EQ(model.view().values.size(), 3 * surface_.node.size());
  EXPECT_EQ(model.status().steps, 200u);
  EXPECT_NEAR(model.status().simulated_s, 1, 1e-9);
}

TEST_F(DynamicModelTest, StepsThatDoNotDivideATickFollowTheClock) {
  DynamicModel model(parts(0.003));
  pass(model, 3);
  EXPECT_EQ(model.status().steps, 1000u);
}

// The hand's place is that of the force; what it says of the force itself is 30 % off.
TEST_F(DynamicModelTest, UnderAPressItComesToTheDirectSolution) {
  const NodeId pressed = nearest({kLength_m, kThick_m / 2, kThick_m});
  const Vec3 force(0.01, 0.02, -0.1);
  const physics::FreeDofs dofs = physics::free_dofs(fixed_);
  const physics::Stiffness K = physics::assemble_stiffness(mesh_, material_);
  Eigen::MatrixXd f = Eigen::MatrixXd::Zero(dofs.count, 1);
  for (int axis = 0; axis < 3; ++axis) f(dofs.of(pressed, axis), 0) = force[axis];
  const Eigen::MatrixXd u = physics::StiffnessFactor(K, dofs).solve(f);

  DynamicModel model(parts());
  const std::array<NodeId, 1> nodes{pressed};
  const std::array<Vec3, 1> said{Vec3(0.7 * force)};
  std::array<Vec3, 1> place;
  for (int axis = 0; axis < 3; ++axis) place[0][axis] = u(dofs.of(pressed, axis), 0);
  const ToolLoad load{.tool = 0, .nodes = nodes, .displacements = place, .forces = said};
  pass(model, 10, {.presses = {&load, 1}, .cuts = {}});
  const double largest = u.cwiseAbs().maxCoeff();
  for (const NodeId n : surface_.node)
    for (int axis = 0; axis < 3; ++axis) {
      const double expected = dofs.of(n, axis) < 0 ? 0 : u(dofs.of(n, axis), 0);
      EXPECT_NEAR(shown(model, n)[axis], expected, 1e-5 * largest);
    }
}

// Or what fades would be made up for, up to twice its force, and the organ stay as deep.
TEST_F(DynamicModelTest, APressWhoseHandIsSilentIsLetGoOfAsItFades) {
  DynamicModel model(parts());
  const std::array<NodeId, 1> nodes{nearest({kLength_m, kThick_m / 2, kThick_m})};
  std::array<Vec3, 1> place{Vec3(0, 0, -0.004)}, force{Vec3(0, 0, -0.1)};
  ToolLoad load{.tool = 0, .nodes = nodes, .displacements = place, .forces = force};
  pass(model, 5, {.presses = {&load, 1}, .cuts = {}});
  // as the hand finds it
  LocalPatch patch(model.sizes().local_nodes);
  ASSERT_TRUE(model.local_model({0, mesh_.positions[nodes[0]] + place[0], 0.03}, patch));
  for (std::size_t i = 0; i < patch.node_count; ++i)
    if (NodeId(static_cast<std::size_t>(patch.nodes[i])) == nodes[0]) force[0] = patch.forces[i];
  const double pressed = shown(model, nodes[0]).z();
  EXPECT_NEAR(pressed, -0.004, 1e-6);
  const Vec3 whole = force[0];
  double last = pressed;
  for (double gain : {0.8, 0.6, 0.4, 0.2}) {
    load.gain = gain;
    force[0] = gain * whole;
    pass(model, 5, {.presses = {&load, 1}, .cuts = {}});
    const double now = shown(model, nodes[0]).z();
    EXPECT_GE(now, last - 1e-6);
    EXPECT_NEAR(now / pressed, std::min(1.0, 2 * gain * gain), 0.01) << gain;
    last = now;
  }
}

TEST_F(DynamicModelTest, ItSagsUnderItsWeight) {
  DynamicParts heavy = parts();
  heavy.gravity_m_s2 = Vec3(0, 0, -9.81);
  DynamicModel model(std::move(heavy));
  pass(model, 5);
  EXPECT_LT(shown(model, nearest({kLength_m, 0, 0})).z(), -0.001);
  EXPECT_FALSE(model.status().diverged);
}

TEST_F(DynamicModelTest, AStrokeRemovesWhatItMeetsAndBaresNodes) {
  DynamicModel model(parts());
  const CutStroke stroke = stroke_at(0.05);
  model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  const OrganView view = model.view();
  EXPECT_EQ(view.topology_version, 1u);
  EXPECT_EQ(count_bits(view.removed_bits), static_cast<int>(model.status().removed_tetrahedra));
  geometry::MeshEditor editor(mesh_, {.uncut_surface = surface_.node});
  editor.set_removed(view.removed_bits);
  EXPECT_GT(editor.surface_nodes().size(), surface_.node.size());
  EXPECT_EQ(view.values.size(), 3 * editor.surface_nodes().size());
  EXPECT_EQ(editor.piece_count(), 2) << "a fast stroke leaves no bridge";
  pass(model, 0.1);
  EXPECT_EQ(model.view().topology_version, 1u);
}

TEST_F(DynamicModelTest, ItTellsWhatACutCostsInTissue) {
  DynamicModel model(parts());
  const CutStroke stroke = stroke_at(0.05), beside = stroke_at(0.5);
  model.step({.presses = {}, .cuts = {&beside, 1}}, kTick_s);
  EXPECT_EQ(model.status().cuts.way_m, 0);
  EXPECT_EQ(model.status().cuts.tools, 0u);
  model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  EXPECT_DOUBLE_EQ(model.status().cuts.way_m, 2);
  EXPECT_EQ(model.status().cuts.tools, 1u << stroke.tool);
  const double share =
      static_cast<double>(model.status().removed_tetrahedra) / static_cast<double>(mesh_.tetrahedra.size());
  EXPECT_NEAR(model.status().cuts.lost_m3, share * kLength_m * kThick_m * kThick_m, 1e-12);
}

TEST_F(DynamicModelTest, TissueBurnsThroughAfterItsDelay) {
  DynamicParts slow = parts();
  slow.cut_delay_s = 0.045;
  DynamicModel model(std::move(slow));
  const CutStroke stroke = stroke_at(0.05);
  model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  pass(model, 0.03);
  EXPECT_EQ(model.view().topology_version, 0u);
  pass(model, 0.01);
  EXPECT_EQ(model.view().topology_version, 1u);
}

TEST_F(DynamicModelTest, WhatIsCutOffFallsAndIsDroppedOutOfSight) {
  DynamicParts heavy = parts();
  heavy.gravity_m_s2 = Vec3(0, 0, -9.81);
  DynamicModel model(std::move(heavy));
  pass(model, 1);
  const CutStroke stroke = stroke_at(0.05);
  model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  const auto at_first = model.status().removed_tetrahedra;
  pass(model, 0.1);
  EXPECT_LT(shown(model, nearest({kLength_m, 0, 0})).z(), -0.02);
  EXPECT_EQ(model.status().removed_tetrahedra, at_first);
  pass(model, 2);
  EXPECT_GT(model.status().removed_tetrahedra, at_first);
  geometry::MeshEditor editor(mesh_);
  editor.set_removed(model.view().removed_bits);
  EXPECT_EQ(editor.piece_count(), 1);
  EXPECT_FALSE(model.status().diverged);
}

TEST_F(DynamicModelTest, ACrackRunsThroughWhatIsWeakAndNotAllAtOnce) {
  DynamicParts weak = parts();
  weak.gravity_m_s2 = Vec3(60, 0, 0);
  const auto is_weak = [&](std::size_t t) {
    double x = 0;
    for (const NodeId n : mesh_.tetrahedra[t]) x += mesh_.positions[n].x() / 4;
    return x > 0.04 && x < 0.06;
  };
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t)
    if (is_weak(t)) weak.tears[t].stress_pa = 2000;
  DynamicModel model(std::move(weak));
  std::uint32_t at_first = 0;
  for (int i = 0; i < 100 && at_first == 0; ++i) {
    model.step({}, kTick_s);
    at_first = model.status().removed_tetrahedra;
  }
  EXPECT_GT(at_first, 0u);
  EXPECT_LE(at_first, 8u) << "with what its going leaves hanging";
  geometry::MeshEditor editor(mesh_);
  for (int i = 0; i < 100 && editor.piece_count() == 1; ++i) {
    model.step({}, kTick_s);
    editor.set_removed(model.view().removed_bits);
  }
  EXPECT_EQ(editor.piece_count(), 2);
  std::uint32_t strong_gone = 0;
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t)
    strong_gone += !is_weak(t) && editor.is_removed(TetId(t));
  EXPECT_LE(strong_gone, model.status().repaired_tetrahedra);
}

TEST_F(DynamicModelTest, AResetMakesItWholeInAHigherVersion) {
  DynamicModel model(parts());
  model.reset();
  EXPECT_EQ(model.view().topology_version, 0u) << "it was whole";
  const CutStroke stroke = stroke_at(0.05);
  model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  model.reset();
  EXPECT_EQ(model.view().topology_version, 2u);
  EXPECT_THAT(model.view().removed_bits, Each(std::uint8_t{0}));
  EXPECT_THAT(model.view().values, Each(0.0F));
  EXPECT_EQ(model.view().values.size(), 3 * surface_.node.size());
  EXPECT_EQ(model.status().removed_tetrahedra, 0u);

  // and what it does afterwards is what an organ does that was never cut
  DynamicModel never(parts());
  const std::array<NodeId, 1> nodes{nearest({kLength_m, 0, 0})};
  const std::array<Vec3, 1> forces{Vec3(0, 0, 0.1)};
  const ToolLoad load{.tool = 0, .nodes = nodes, .displacements = forces, .forces = forces};
  pass(model, 0.5, {.presses = {&load, 1}, .cuts = {}});
  pass(never, 0.5, {.presses = {&load, 1}, .cuts = {}});
  for (std::size_t i = 0; i < never.view().values.size(); ++i)
    EXPECT_NEAR(model.view().values[i], never.view().values[i], 1e-8);
}

// What it lived through and lost before counts for nothing.
TEST_F(DynamicModelTest, TakenUpItMovesAsTheOneThatWasCutDoes) {
  const auto heavy = [&] {
    DynamicParts heavy = parts();
    heavy.gravity_m_s2 = Vec3(0, 0, -9.81);
    return heavy;
  };
  DynamicModel cut(heavy()), other(heavy());
  const CutStroke stroke = stroke_at(0.07);
  cut.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  const std::vector<std::uint8_t> removed(cut.view().removed_bits.begin(), cut.view().removed_bits.end());
  const std::vector<std::uint8_t> burnt(cut.view().burnt_bits.begin(), cut.view().burnt_bits.end());
  const CutStroke elsewhere = stroke_at(0.03);
  other.step({.presses = {}, .cuts = {&elsewhere, 1}}, kTick_s);
  other.take_up(removed, burnt, 300);
  EXPECT_EQ(other.view().topology_version, 300u);
  EXPECT_THAT(other.view().removed_bits, ElementsAreArray(removed));
  EXPECT_THAT(other.view().burnt_bits, ElementsAreArray(burnt));
  EXPECT_EQ(other.view().values.size(), cut.view().values.size());
  EXPECT_THAT(other.view().values, Each(0.0F));
  EXPECT_EQ(other.status().removed_tetrahedra, cut.status().removed_tetrahedra);

  pass(cut, 0.2), pass(other, 0.2 + kTick_s);  // a stroke is cut before its tick passes
  for (std::size_t i = 0; i < cut.view().values.size(); ++i)
    EXPECT_NEAR(other.view().values[i], cut.view().values[i], 1e-5 * kLength_m);
}

TEST_F(DynamicModelTest, WhatACutCostIsCountedOverAReset) {
  DynamicModel model(parts());
  // aslant, so that some hang on an edge afterwards
  const CutStroke stroke{.tool = 0,
                         .cut = 1,
                         .from = {Vec3(0.01, -1, -0.01), Vec3(0.07, -1, 0.025)},
                         .to = {Vec3(0.05, 1, -0.01), Vec3(0.11, 1, 0.025)}};
  model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  const ModelStatus cut = model.status();
  ASSERT_GT(cut.repaired_tetrahedra, 0u);
  model.reset();
  EXPECT_EQ(model.status().removed_tetrahedra, 0u);
  EXPECT_EQ(model.status().repaired_tetrahedra, cut.repaired_tetrahedra);
  EXPECT_EQ(model.status().cuts.lost_m3, cut.cuts.lost_m3);
}

TEST_F(DynamicModelTest, AForceOnWhatIsGoneDoesNothing) {
  DynamicModel model(parts());
  const CutStroke all{.tool = 0,
                      .cut = 1,
                      .from = {Vec3(0.06, -1, -1), Vec3(0.06, -1, 1)},
                      .to = {Vec3(0.06, 1, -1), Vec3(0.06, 1, 1)}};
  for (double x = 0; x <= kLength_m; x += 0.004) {
    const CutStroke stroke = stroke_at(x);
    model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  }
  EXPECT_EQ(model.status().removed_tetrahedra, mesh_.tetrahedra.size());
  const std::array<NodeId, 1> nodes{nearest({kLength_m, 0, 0})};
  const std::array<Vec3, 1> forces{Vec3(0, 0, 100)};
  const ToolLoad load{.tool = 0, .nodes = nodes, .displacements = forces, .forces = forces};
  const Vec3 before = shown(model, nodes[0]);
  model.step({.presses = {&load, 1}, .cuts = {&all, 1}}, kTick_s);
  EXPECT_EQ(shown(model, nodes[0]), before);
  EXPECT_FALSE(model.status().diverged);
}

TEST_F(DynamicModelTest, NothingOfItTakesMemory) {
  DynamicParts weak = parts();
  weak.gravity_m_s2 = Vec3(20, 0, -5);
  for (physics::TearLimits& limits : weak.tears) limits.edge_elongation = 0.1;
  DynamicModel model(std::move(weak));
  LocalPatch patch(BodyStepper::kPatchNodes);
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 30; ++i) {
    const CutStroke stroke = stroke_at(0.03 + 0.002 * i);
    model.step({.presses = {}, .cuts = {&stroke, i % 3 == 0 ? 1u : 0u}}, kTick_s);
    (void)model.local_model({0, Vec3(0.05, 0.02, kThick_m), 0.02}, patch);
    if (i == 20) model.reset();
  }
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_GT(model.status().removed_tetrahedra, 0u);
}

}  // namespace
}  // namespace omentum::deform
