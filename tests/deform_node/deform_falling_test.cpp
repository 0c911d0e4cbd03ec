// An organ in equilibrium whose pieces fall when they are cut off.
#include "tests/deform_node/dynamic_beam.h"

#include "tests/support/heap_count.h"

#include <gmock/gmock.h>

namespace omentum::deform {
namespace {

using geometry::TetId;

const Vec3 kPieceGravity(0, 0, -9.81);

class FallingPieceTest : public DynamicModelTest {
 protected:
  DynamicParts falling_parts() {
    DynamicParts made = parts(kTick_s);
    made.body.inertia.mass_damping_per_s = made.body.inertia.stiffness_damping_s = 0;
    made.stepper = make_static_stepper(made.body, kTick_s, LoosePieces::kFall);
    made.is_static = true;
    made.piece_gravity_m_s2 = kPieceGravity;
    return made;
  }
  static void sever(DynamicModel& model, double x = 0.05) {
    const CutStroke stroke = stroke_at(x);
    model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  }
  Vec3 at(const DynamicModel& model, NodeId n) const {
    return Eigen::Map<const Vec3>(model.view().body_u.data() + 3 * static_cast<std::size_t>(n));
  }
  // Whether it is of the piece that comes off at `x` of sever().
  bool falls(NodeId n, double x = 0.05) const { return mesh_.positions[n].x() > x; }

  /// Of what is left, about where it was at rest.
  Vec3 moment_kg_m(const DynamicModel& model) const {
    geometry::MeshEditor editor(mesh_);
    editor.set_removed(model.view().removed_bits);
    Vec3 sum = Vec3::Zero();
    for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
      if (editor.is_removed(TetId(t))) continue;
      const auto& [a, b, c, d] = mesh_.tetrahedra[t];
      const auto& x = mesh_.positions;
      const double kg = kTissue.density_kg_m3 * geometry::signed_volume(x[a], x[b], x[c], x[d]);
      for (const NodeId n : {a, b, c, d}) sum += kg / 4 * at(model, n);
    }
    return sum;
  }

  const NodeId tip_ = nearest({kLength_m, kThick_m / 2, kThick_m});
  const NodeId root_ = nearest({0.02, kThick_m / 2, kThick_m});
};

TEST_F(FallingPieceTest, WhatIsCutOffFallsAsAWholeAndTheRestStaysInEquilibrium) {
  DynamicModel model(falling_parts());
  sever(model);
  geometry::MeshEditor editor(mesh_);
  editor.set_removed(model.view().removed_bits);
  ASSERT_EQ(editor.piece_count(), 2) << "nothing but the cut is gone";
  EXPECT_EQ(model.view().topology_version, 1U);
  const Vec3 before = at(model, tip_);
  pass(model, 0.1);
  EXPECT_LT(at(model, tip_).z() - before.z(), -0.04);
  for (std::size_t n = 0; n < mesh_.positions.size(); ++n) {
    if (editor.uses(NodeId(n)) == 0) continue;
    if (falls(NodeId(n))) {
      // what pulls a node and what it carries are of the same tissue, at the cut as elsewhere
      EXPECT_LT((at(model, NodeId(n)) - at(model, tip_)).norm(), 1e-4) << n;
    } else {
      EXPECT_EQ(at(model, NodeId(n)), Vec3(Vec3::Zero())) << n;
    }
  }
  EXPECT_FALSE(model.status().diverged);
}

// Backward Euler's, of all its weight; nothing of the organ holds any of it.
TEST_F(FallingPieceTest, ItsMomentumIsItsWeightsImpulse) {
  DynamicModel model(falling_parts());
  sever(model);
  geometry::MeshEditor editor(mesh_);
  editor.set_removed(model.view().removed_bits);
  double weight_n = 0;
  for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
    const auto& [a, b, c, d] = mesh_.tetrahedra[t];
    const auto& x = mesh_.positions;
    if (!editor.is_removed(TetId(t)) && falls(a) && falls(b) && falls(c) && falls(d))
      weight_n += kTissue.density_kg_m3 * geometry::signed_volume(x[a], x[b], x[c], x[d]) * kPieceGravity.z();
  }
  pass(model, 10 * kTick_s);
  const Vec3 before = moment_kg_m(model);
  model.step({}, kTick_s);
  const Vec3 momentum = (moment_kg_m(model) - before) / kTick_s;
  // a step went by with the cut itself
  EXPECT_NEAR(momentum.z(), weight_n * 12 * kTick_s, 1e-3 * std::abs(weight_n) * 12 * kTick_s);
  EXPECT_LT(momentum.head<2>().norm(), 1e-3 * std::abs(momentum.z()));
}

// It would swing there on a sliver.
TEST_F(FallingPieceTest, ASupportThatHoldsAPieceByANodeLetsGoOfIt) {
  fixed_[nearest({kLength_m, 0, 0})] = physics::kPinned;
  DynamicModel model(falling_parts());
  sever(model);
  pass(model, 0.1);
  EXPECT_LT(at(model, nearest({kLength_m, 0, 0})).z(), -0.04);
  for (const CollisionSphere& sphere : model.collidable()) {
    if (sphere.centre.x() > 0.08) {
      EXPECT_TRUE(std::isfinite(sphere.mass_kg));
    }
  }
}

TEST_F(FallingPieceTest, TheStumpIsFeltAsIfThePieceHadBeenDropped) {
  DynamicParts dropping = falling_parts();
  dropping.stepper = make_static_stepper(dropping.body, kTick_s);
  dropping.piece_gravity_m_s2 = {};
  DynamicModel falls(falling_parts()), drops(std::move(dropping));
  sever(falls);
  sever(drops);
  pass(falls, 0.3);
  LocalPatch one(BodyStepper::kPatchNodes), other(BodyStepper::kPatchNodes);
  const PatchPlace place{0, mesh_.positions[root_], 0.015};
  ASSERT_TRUE(falls.local_model(place, one));
  ASSERT_TRUE(drops.local_model(place, other));
  ASSERT_EQ(one.node_count, other.node_count);
  const std::size_t entries = 3 * one.node_count * (3 * one.node_count + 1) / 2;
  for (std::size_t i = 0; i < entries; ++i) EXPECT_FLOAT_EQ(one.compliance[i], other.compliance[i]);
}

TEST_F(FallingPieceTest, AHandThatGraspsThePieceCarriesIt) {
  DynamicModel model(falling_parts());
  sever(model);
  std::vector<NodeId> nodes;
  for (std::size_t n = 0; n < mesh_.positions.size(); ++n)
    if (mesh_.positions[n].x() > kLength_m - 1e-9) nodes.emplace_back(n);
  std::vector<Vec3> places(nodes.size(), Vec3::Zero()), forces(nodes.size());
  // as hard as it needs to stay; half a second: nothing of it would be left in reach
  ToolLoad load{.tool = 0, .nodes = nodes, .displacements = places, .forces = forces, .grasps = true};
  for (int i = 0; i < 100; ++i) {
    LocalPatch patch(BodyStepper::kPatchNodes);
    ASSERT_TRUE(model.local_model({0, mesh_.positions[tip_] + at(model, tip_), 0.03}, patch));
    for (std::size_t k = 0; k < nodes.size(); ++k) forces[k] = Vec3(0, 0, 0.15);
    model.step({.presses = {&load, 1}, .cuts = {}}, kTick_s);
    ASSERT_FALSE(model.status().diverged) << i;
  }
  double lowered_m = 0;
  for (const NodeId n : nodes) lowered_m -= at(model, n).z() / static_cast<double>(nodes.size());
  EXPECT_LT(lowered_m, 2e-3) << "it hangs from the hand";
  EXPECT_LT(at(model, nearest({0.07, kThick_m / 2, 0})).z(), -0.01) << "and swings there";
}

// Both of a patch: what nothing ties does not yield to the other's forces.
TEST_F(FallingPieceTest, APatchAcrossTheGapTellsBothSides) {
  DynamicModel model(falling_parts());
  sever(model);
  LocalPatch patch(BodyStepper::kPatchNodes);
  ASSERT_TRUE(model.local_model({0, Vec3(0.05, kThick_m / 2, kThick_m), 0.06}, patch));
  const std::size_t rows = 3 * patch.node_count;
  std::size_t at = 0, across = 0, along = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = r; c < rows; ++c, ++at) {
      const bool apart = falls(NodeId(static_cast<std::size_t>(patch.nodes[r / 3]))) !=
                         falls(NodeId(static_cast<std::size_t>(patch.nodes[c / 3])));
      if (apart) {
        EXPECT_EQ(patch.compliance[at], 0);
      }
      (apart ? across : along) += patch.compliance[at] != 0 || apart ? 1 : 0;
    }
  }
  EXPECT_GT(across, 0U) << "the patch has to have both sides";
  EXPECT_GT(along, rows);
}

TEST_F(FallingPieceTest, ForOtherOrgansThePieceYieldsAndTheRestIsAWall) {
  DynamicModel model(falling_parts());
  ASSERT_FALSE(model.collidable().empty());
  for (const CollisionSphere& sphere : model.collidable()) EXPECT_TRUE(std::isinf(sphere.mass_kg));
  sever(model);
  std::size_t yielding = 0;
  for (const CollisionSphere& sphere : model.collidable()) {
    yielding += std::isfinite(sphere.mass_kg) ? 1 : 0;
    if (sphere.centre.x() < 0.03 || sphere.centre.x() > 0.08) {
      EXPECT_EQ(std::isfinite(sphere.mass_kg), sphere.centre.x() > 0.08);
    }
  }
  EXPECT_GT(yielding, 0U);
  model.reset();
  for (const CollisionSphere& sphere : model.collidable()) EXPECT_TRUE(std::isinf(sphere.mass_kg));
}

// All of the impulse that the sphere's mass stands for is the piece's, and nothing of it the stump's.
TEST_F(FallingPieceTest, APushMovesThePieceByItsMass) {
  DynamicModel model(falling_parts()), alone(falling_parts());
  sever(model);
  sever(alone);
  const std::span<const CollisionSphere> spheres = model.collidable();
  const auto far =
      std::ranges::max_element(spheres, {}, [](const CollisionSphere& sphere) { return sphere.centre.x(); });
  constexpr double kPush_m_s = 0.5;
  const OrganContact contact{.sphere = static_cast<std::int32_t>(far - spheres.begin()),
                             .normal = Vec3::UnitY(),
                             .velocity = far->velocity,
                             .push_m_s = kPush_m_s};
  const Vec3 impulse_n_s = far->mass_kg * kPush_m_s * contact.normal;
  model.respond({&contact, 1});
  model.step({}, kTick_s);
  alone.step({}, kTick_s);
  const Vec3 gained = (moment_kg_m(model) - moment_kg_m(alone)) / kTick_s;
  EXPECT_LE((gained - impulse_n_s).norm(), 1e-2 * impulse_n_s.norm());
  EXPECT_EQ(at(model, root_), Vec3(Vec3::Zero()));
}

TEST_F(FallingPieceTest, APushMeetsTheMassThatIsLeft) {
  DynamicParts made = parts(kTick_s);
  made.stepper = make_warped_stepper(made.body, kTick_s);  // nothing pulls: all spheres stay where they are
  DynamicModel model(std::move(made));
  const auto uncut = std::vector<CollisionSphere>(model.collidable().begin(), model.collidable().end());
  sever(model);
  std::size_t lighter = 0;
  for (const CollisionSphere& sphere : model.collidable()) {
    const auto before = std::ranges::min_element(
        uncut, {}, [&](const CollisionSphere& other) { return (other.centre - sphere.centre).norm(); });
    // a layer of cells beside the cut at most
    if (std::abs(sphere.centre.x() - 0.05) > 0.03) {
      EXPECT_DOUBLE_EQ(sphere.mass_kg, before->mass_kg);
    }
    EXPECT_LE(sphere.mass_kg, before->mass_kg);
    lighter += sphere.mass_kg < before->mass_kg ? 1 : 0;
  }
  EXPECT_GT(lighter, 0U);
}

TEST_F(FallingPieceTest, WhatFellOutOfReachIsDroppedAndAResetMakesAllWhole) {
  DynamicModel model(falling_parts()), never(falling_parts());
  sever(model);
  const std::uint32_t cut = model.status().removed_tetrahedra;
  pass(model, 1.0);
  EXPECT_GT(model.status().removed_tetrahedra, cut);
  EXPECT_FALSE(model.status().diverged);
  model.reset();
  EXPECT_THAT(model.view().values, testing::Each(0.0F));
  sever(model, 0.07);
  sever(never, 0.07);
  pass(model, 0.05);
  pass(never, 0.05);
  for (std::size_t i = 0; i < never.view().values.size(); ++i)
    EXPECT_FLOAT_EQ(model.view().values[i], never.view().values[i]);
}

// A process that takes the cuts up finds the same piece, at rest, and lets it fall.
TEST_F(FallingPieceTest, ATakenUpPieceFalls) {
  DynamicModel model(falling_parts()), other(falling_parts());
  sever(model);
  other.take_up(model.view().removed_bits, model.view().burnt_bits, 7);
  EXPECT_EQ(other.status().removed_tetrahedra, model.status().removed_tetrahedra);
  pass(other, 0.1);
  EXPECT_LT(at(other, tip_).z(), -0.04);
  EXPECT_EQ(at(other, root_), Vec3(Vec3::Zero()));
}

TEST_F(FallingPieceTest, ThePieceIsCutAgain) {
  DynamicModel model(falling_parts());
  sever(model);
  sever(model, 0.09);
  geometry::MeshEditor editor(mesh_);
  editor.set_removed(model.view().removed_bits);
  EXPECT_EQ(editor.piece_count(), 3);
  pass(model, 0.1);
  EXPECT_FALSE(model.status().diverged);
  EXPECT_LT(at(model, tip_).z(), -0.04);
}

TEST_F(FallingPieceTest, NothingOfItTakesMemory) {
  DynamicModel model(falling_parts());
  LocalPatch patch(BodyStepper::kPatchNodes);
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 20; ++i) {
    const CutStroke stroke = stroke_at(0.11 - 0.004 * i);
    model.step({.presses = {}, .cuts = {&stroke, i % 3 == 0 ? 1U : 0U}}, kTick_s);
    (void)model.local_model({0, Vec3(0.1, 0.02, kThick_m), 0.02}, patch);
    if (i == 12) model.reset();
  }
  EXPECT_EQ(test::heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::deform
