// A hybrid organ whose dynamic part turns far, random cuts of it, and what a journal may not say of it.
#include "deform_node/cut_journal.h"
#include "deform_node/dynamic_maker.h"
#include "files/whole_file.h"
#include "tests/deform_node/hybrid_cut_trials.h"
#include "tests/deform_node/rates.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <map>

namespace omentum::deform {
namespace {

using ::testing::HasSubstr;

class WarpedHybridModelTest : public testing::Test {
 protected:
  std::unique_ptr<OrganModel> make(const std::string& law) {
    organ_.spec.dynamics->law = law;
    return make_hybrid(organ_.source, organ_.spec);
  }
  NodeId nearest(const Vec3& x) const {
    const auto& positions = organ_.source.organ.mesh.positions;
    const auto less = [&](const Vec3& a, const Vec3& b) { return (a - x).norm() < (b - x).norm(); };
    return NodeId(static_cast<std::size_t>(std::ranges::min_element(positions, less) - positions.begin()));
  }
  Vec3 place(const OrganModel& model, NodeId n) const {
    return organ_.source.organ.mesh.positions[n] +
           Vec3(model.view().body_u.data() + 3 * static_cast<std::size_t>(n));
  }

  geometry::TetraMesh mesh_ = test::make_box_mesh(8, 2, 2, Vec3(0.12, 0.03, 0.03));
  test::HybridOrgan organ_{mesh_, test::held_at_low_x(mesh_, 1e-9), "plane:x>0.06"};
};

// A hand takes the end by a corner and brings it 6 cm up and 4 cm back.
TEST_F(WarpedHybridModelTest, WhatAHandLiftsAndTurnsKeepsItsSize) {
  const NodeId held = nearest({0.12, 0.015, 0.015}), above = nearest({0.12, 0.015, 0.03});
  std::map<std::string, double> height;  // of the end's upper half, in its own
  for (const std::string law : {"linear", "corotational"}) {
    const auto model = make(law);
    for (int i = 0; i < 300; ++i) {
      const Vec3 way = std::min(1.0, i / 150.0) * Vec3(-0.04, 0, 0.06), force(-2, 0, 3);
      const ToolLoad load{.tool = 0, .nodes = {&held, 1}, .displacements = {&way, 1}, .forces = {&force, 1}};
      model->step({.presses = {&load, 1}, .cuts = {}}, kTick_s);
      ASSERT_FALSE(model->status().diverged) << law << ", tick " << i;
    }
    EXPECT_GT(place(*model, held).z(), 0.06) << law;
    height[law] = (place(*model, above) - place(*model, held)).norm() / 0.015;
  }
  EXPECT_GT(height["linear"], 1.3) << "it swells as it turns";
  EXPECT_NEAR(height["corotational"], 1, 0.15);
}

TEST_F(WarpedHybridModelTest, AnyCutsLeaveASoundOrganUnderAPull) {
  for (std::uint32_t seed = 0; seed < 8; ++seed)
    EXPECT_EQ(try_hybrid_cuts(organ_, {.law = seed % 2 == 0 ? "corotational" : "linear"}, seed, 60), "")
        << "seed " << seed;
}

TEST_F(WarpedHybridModelTest, NobodyElsesCutsTakePrecomputedTissueAway) {
  const std::vector<std::uint8_t>& dynamic = organ_.source.organ.split->dynamic;
  std::vector<std::uint8_t> everything((dynamic.size() + 7) / 8, 0xff);
  const auto model = make("corotational");
  model->take_up(everything, everything, 7);
  const OrganView view = model->view();
  EXPECT_EQ(view.topology_version, 7u);
  for (std::size_t t = 0; t < dynamic.size(); ++t) {
    EXPECT_EQ(view.removed_bits[t / 8] >> t % 8 & 1, dynamic[t]) << t;
    EXPECT_EQ(view.burnt_bits[t / 8] >> t % 8 & 1, dynamic[t]) << t;
  }
  for (int i = 0; i < 10; ++i) model->step({}, kTick_s);
  EXPECT_FALSE(model->status().diverged);
}

TEST_F(WarpedHybridModelTest, AJournalThatNamesPrecomputedTissueIsRefused) {
  std::vector<ServedOrgan> served(1);
  served[0].source = std::make_unique<node::OrganSource>(std::move(organ_.source));
  served[0].model = make_hybrid(*served[0].source, organ_.spec);
  const JournalScene scene = journal_scene("5ce9e", served);
  const auto file = organ_.folder / "cuts.json";
  const auto read_without = [&](std::size_t t) {
    std::vector<std::uint8_t> bits((scene.organs[0].kept.size() + 7) / 8);
    bits[t / 8] = static_cast<std::uint8_t>(1 << t % 8);
    files::write_whole(file, journal_text(scene, std::vector<OrganCuts>{{3, bits, bits}}));
    return read_journal(file, scene);
  };
  const auto moves = std::ranges::find(scene.organs[0].kept, 0),
             stays = std::ranges::find(scene.organs[0].kept, 1);
  EXPECT_EQ(read_without(static_cast<std::size_t>(moves - scene.organs[0].kept.begin())).flaw, "");
  const std::size_t wrong = static_cast<std::size_t>(stays - scene.organs[0].kept.begin());
  const JournalContents contents = read_without(wrong);
  EXPECT_THAT(contents.flaw, HasSubstr("organs[0].removed: found tetrahedron " + std::to_string(wrong) +
                                       ", which is precomputed"));
  EXPECT_TRUE(contents.organs[0].removed_bits.empty());
  EXPECT_EQ(contents.organs[0].version, 4u);
}

}  // namespace
}  // namespace omentum::deform
