// A beam whose held half is precomputed and whose free half moves, as a scene makes it of an organ file.
#include "deform_node/dynamic_maker.h"

#include "deform_node/model_table.h"
#include "deform_node/strain_gauge.h"
#include "geometry/mesh_editor.h"
#include "tests/deform_node/hybrid_organ.h"
#include "tests/deform_node/rates.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <random>

namespace omentum::deform {
namespace {

constexpr double kBeamLength_m = 0.12;
constexpr double kBorder_m = 0.06;

class HybridModelTest : public testing::Test {
 protected:
  std::unique_ptr<OrganModel> make(const std::string& model) const {
    return find_model(model_table(), model).make(source_, spec_);
  }
  static void pass(OrganModel& model, double seconds, const TickLoads& loads = {}) {
    for (int i = 0; i < std::lround(seconds / kTick_s); ++i) {
      model.step(loads, kTick_s);
      ASSERT_FALSE(model.status().diverged) << "after " << i << " ticks";
      ASSERT_EQ(model.status().fault, "") << "after " << i << " ticks";
    }
  }
  NodeId nearest(const Vec3& x) const {
    const auto& positions = source_.organ.mesh.positions;
    const auto less = [&](const Vec3& a, const Vec3& b) { return (a - x).norm() < (b - x).norm(); };
    return NodeId(static_cast<std::size_t>(std::ranges::min_element(positions, less) - positions.begin()));
  }
  /// Of the largest displacement.
  static double difference(const OrganModel& a, const OrganModel& b) {
    float size = 0, off = 0;
    for (std::size_t c = 0; c < b.view().values.size(); ++c) {
      size = std::max(size, std::abs(b.view().values[c]));
      off = std::max(off, std::abs(a.view().values[c] - b.view().values[c]));
    }
    return static_cast<double>(off / size);
  }
  std::size_t removed_of_the_precomputed(const OrganModel& model) const {
    std::size_t count = 0;
    const auto bits = model.view().removed_bits;
    for (std::size_t t = 0; t < source_.organ.mesh.tetrahedra.size(); ++t)
      count += (bits[t / 8] >> t % 8 & 1) != 0 && source_.organ.split->dynamic[t] == 0;
    return count;
  }

  geometry::TetraMesh mesh_ = test::make_box_mesh(8, 2, 2, Vec3(kBeamLength_m, 0.03, 0.03));
  test::HybridOrgan organ_{mesh_, test::held_at_low_x(mesh_, 1e-9), "plane:x>0.06"};
  node::OrganSource& source_ = organ_.source;
  scene::OrganSpec& spec_ = organ_.spec;
};

TEST_F(HybridModelTest, ItHangsAndIsPressedAsAWholeDynamicOrganIs) {
  const auto hybrid = make("hybrid"), whole = make("tensor-mass");
  const std::array<NodeId, 2> nodes{nearest({0.03, 0.015, 0.03}), nearest({0.105, 0.015, 0.03})};
  const std::array<Vec3, 2> forces{Vec3(0.01, 0.02, -0.1), Vec3(0, -0.02, -0.05)};
  const std::array<Vec3, 2> places{Vec3(1e-4, 2e-4, -1e-3), Vec3(0, -2e-3, -2e-2)};
  std::array<ToolLoad, 2> loads;
  for (std::uint32_t i = 0; i < 2; ++i)
    loads[i] = {
        .tool = i, .nodes = {&nodes[i], 1}, .displacements = {&places[i], 1}, .forces = {&forces[i], 1}};
  for (OrganModel* model : {hybrid.get(), whole.get()}) pass(*model, 4);
  EXPECT_LE(difference(*hybrid, *whole), 1e-4) << "under its weight";
  for (OrganModel* model : {hybrid.get(), whole.get()}) pass(*model, 4, {.presses = loads, .cuts = {}});
  EXPECT_LE(difference(*hybrid, *whole), 1e-4) << "under presses too";
  for (OrganModel* model : {hybrid.get(), whole.get()}) pass(*model, 4);
  EXPECT_LE(difference(*hybrid, *whole), 1e-4) << "without them";
}

TEST_F(HybridModelTest, StrainAndStressAreTheWholeOrgansOnBothSides) {
  const auto hybrid = make("hybrid"), whole = make("tensor-mass");
  std::array<std::vector<float>, 2> strain, stress;
  std::size_t i = 0;
  for (OrganModel* model : {hybrid.get(), whole.get()}) {
    pass(*model, 4);
    StrainedShape shape(model->sizes());
    shape.take(model->view());
    strain[i].resize(shape.node_count());
    stress[i].resize(shape.node_count());
    model->strain_gauge()->measure(shape, strain[i], stress[i]);
    ++i;
  }
  const float most = *std::ranges::max_element(stress[1]);
  for (std::size_t s = 0; s < stress[0].size(); ++s) {
    EXPECT_NEAR(strain[0][s], strain[1][s], 1e-3 * *std::ranges::max_element(strain[1]));
    EXPECT_NEAR(stress[0][s], stress[1][s], 1e-3F * most);
  }
}

TEST_F(HybridModelTest, AStrokeThroughBothPartsCutsTheDynamicOneAlone) {
  const auto model = make("hybrid");
  pass(*model, 0.5);
  // lengthwise, through all of the beam
  const CutStroke along{.tool = 0,
                        .cut = 1,
                        .from = {Vec3(-1, 0.015, -1), Vec3(-1, 0.015, 1)},
                        .to = {Vec3(1, 0.015, -1), Vec3(1, 0.015, 1)}};
  model->step({.presses = {}, .cuts = {&along, 1}}, kTick_s);
  EXPECT_GT(model->status().removed_tetrahedra, 10u);
  EXPECT_EQ(removed_of_the_precomputed(*model), 0u);
  pass(*model, 2);
}

TEST_F(HybridModelTest, WhatIsCutOffFallsAndTheRestRisesToWhereThePrecomputedPartIsByItself) {
  const auto model = make("hybrid");
  pass(*model, 2);
  const auto held = source_.organ.surface.of_node[nearest({kBorder_m, 0.015, 0})];
  const float before = model->view().values[3 * static_cast<std::size_t>(held) + 2];
  const CutStroke across{.tool = 0,
                         .cut = 1,
                         .from = {Vec3(0.07, -1, -1), Vec3(0.07, -1, 1)},
                         .to = {Vec3(0.07, 1, -1), Vec3(0.07, 1, 1)}};
  model->step({.presses = {}, .cuts = {&across, 1}}, kTick_s);
  pass(*model, 1);
  const float after = model->view().values[3 * static_cast<std::size_t>(held) + 2];
  EXPECT_LT(before, 3 * after) << "both below zero";
  const auto tip = source_.organ.surface.of_node[nearest({kBeamLength_m, 0.015, 0})];
  EXPECT_LT(model->view().values[3 * static_cast<std::size_t>(tip) + 2], -0.1) << "it falls";
  EXPECT_EQ(removed_of_the_precomputed(*model), 0u);
  model->reset();
  pass(*model, 0.1);
  EXPECT_EQ(model->status().removed_tetrahedra, 0u);
}

// Without weight nothing moves, so that what an edge meets is known from the shape at rest.
TEST_F(HybridModelTest, AllThatIsGoneMetTheEdgeOrWasRepairAndAnotherLineTakesOthers) {
  spec_.dynamics->gravity_m_s2.setZero();
  constexpr int kStrokes = 20;
  std::array<std::vector<std::uint8_t>, 2> gone;
  for (const std::size_t line : {0, 1}) {
    const auto model = make("hybrid");
    const Vec3 begin(0.0752 + 0.005 * static_cast<double>(line), -0.005, 0), way(0.02, 0.04, 0),
        up(0, 0, 0.05);
    const Vec3 across = way.cross(up);
    for (int i = 0; i < kStrokes; ++i) {
      const Vec3 a = begin + way * i / kStrokes, b = begin + way * (i + 1) / kStrokes;
      const CutStroke stroke{.tool = 0, .cut = 1, .from = {a + up, a - up}, .to = {b + up, b - up}};
      model->step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
    }
    geometry::MeshEditor editor(source_.organ.mesh);
    editor.set_removed(model->view().removed_bits);
    EXPECT_EQ(editor.piece_count(), 2) << "the tip is cut off";
    std::uint32_t beside = 0;
    for (std::size_t t = 0; t < source_.organ.mesh.tetrahedra.size(); ++t) {
      double low = 1, high = -1;
      for (const NodeId n : source_.organ.mesh.tetrahedra[geometry::TetId(t)]) {
        const double side = (source_.organ.mesh.positions[n] - begin).dot(across);
        low = std::min(low, side), high = std::max(high, side);
      }
      const bool met = low <= 0 && high >= 0, is_gone = editor.is_removed(geometry::TetId(t));
      EXPECT_TRUE(is_gone || !met) << t << ": the wire went through it";
      beside += is_gone && !met;
    }
    // what hung may be what the wire would have met later
    EXPECT_LE(beside, model->status().repaired_tetrahedra);
    EXPECT_GT(model->status().removed_tetrahedra, 15u + model->status().repaired_tetrahedra);
    gone[line].assign(model->view().removed_bits.begin(), model->view().removed_bits.end());
  }
  EXPECT_NE(gone[0], gone[1]) << "5 mm aside";
}

// Across the border and on both sides of it, until little is left.
TEST_F(HybridModelTest, AnyCutsLeaveASoundOrgan) {
  spec_.dynamics->smallest_piece_m3 = 1e-8;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto model = make("hybrid");
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, 0.03), along(0.04, kBeamLength_m);
    for (int i = 0; i < 40; ++i) {
      const Vec3 a(along(random), place(random), place(random)),
          b(along(random), place(random), place(random));
      const CutStroke stroke{
          .tool = 0, .cut = 1, .from = {a, a + Vec3(0, 0, 0.01)}, .to = {b, b + Vec3(0, 0.01, 0)}};
      model->step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
      ASSERT_FALSE(model->status().diverged) << "seed " << seed << ", stroke " << i;
      ASSERT_EQ(removed_of_the_precomputed(*model), 0u) << "seed " << seed << ", stroke " << i;
      for (const float u : model->view().values) ASSERT_TRUE(std::isfinite(u));
    }
    EXPECT_GT(model->status().removed_tetrahedra, 20u);
  }
}

// Nodes inside the precomputed part stay where they are in a state: what others meet follows the surface.
TEST_F(HybridModelTest, OtherOrgansMeetBothPartsWhereTheyAre) {
  spec_.dynamics->gravity_m_s2 = Vec3(0, 0, -2);  // little turns
  const auto hybrid = make("hybrid"), whole = make("tensor-mass");
  for (OrganModel* model : {hybrid.get(), whole.get()}) pass(*model, 4);
  const auto ours = hybrid->collidable(), theirs = whole->collidable();
  ASSERT_EQ(ours.size(), theirs.size());
  float most_m = 0;
  for (const float u : whole->view().values) most_m = std::max(most_m, std::abs(u));
  for (std::size_t i = 0; i < ours.size(); ++i)
    EXPECT_LE((ours[i].centre - theirs[i].centre).norm(), 0.15 * static_cast<double>(most_m)) << i;
}

TEST_F(HybridModelTest, ATickAllocatesNothing) {
  const auto model = make("hybrid");
  const NodeId node = nearest({0.045, 0.015, 0.03});
  const Vec3 force(0, 0, -0.05), place(0, 0, -1e-3);
  const ToolLoad load{.tool = 0, .nodes = {&node, 1}, .displacements = {&place, 1}, .forces = {&force, 1}};
  const CutStroke stroke{.tool = 0,
                         .cut = 1,
                         .from = {Vec3(0.09, -1, -1), Vec3(0.09, -1, 1)},
                         .to = {Vec3(0.09, 1, -1), Vec3(0.09, 1, 1)}};
  LocalPatch patch(model->sizes().local_nodes);
  const std::size_t before = test::heap_allocations();
  model->step({.presses = {&load, 1}, .cuts = {&stroke, 1}}, kTick_s);
  const bool offered = model->local_model({0, {0.055, 0.015, 0.03}, 0.02}, patch);
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_TRUE(offered);
}

}  // namespace
}  // namespace omentum::deform
