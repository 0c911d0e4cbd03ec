// A beam whose held half is precomputed and can be cut all the same.
#include "deform_node/cut_journal.h"
#include "deform_node/model_table.h"
#include "geometry/mesh_editor.h"
#include "tests/deform_node/hybrid_cut_trials.h"
#include "tests/deform_node/rates.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <fstream>

namespace omentum::deform {
namespace {

using geometry::TetId;

class HybridCutModelTest : public testing::Test {
 protected:
  std::unique_ptr<OrganModel> make(const std::string& model) const {
    return find_model(model_table(), model).make(organ_.source, organ_.spec);
  }
  static void pass(OrganModel& model, double seconds, const TickLoads& loads = {}) {
    for (int i = 0; i < std::lround(seconds / kTick_s); ++i) {
      model.step(loads, kTick_s);
      ASSERT_FALSE(model.status().diverged) << "after " << i << " ticks";
      ASSERT_EQ(model.status().fault, "") << "after " << i << " ticks";
    }
  }
  // A wall through all of the beam at `x`.
  static CutStroke across(double x) {
    return {.tool = 0,
            .cut = 1,
            .from = {Vec3(x, -1, -1), Vec3(x, -1, 1)},
            .to = {Vec3(x, 1, -1), Vec3(x, 1, 1)}};
  }
  static void stroke(OrganModel& model, const CutStroke& stroke) {
    model.step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  }
  const geometry::TetraMesh& mesh() const { return organ_.source.organ.mesh; }
  bool is_gone(const OrganModel& model, std::size_t t) const {
    return (model.view().removed_bits[t / 8] >> t % 8 & 1) != 0;
  }
  std::size_t removed_of_the_precomputed(const OrganModel& model) const {
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh().tetrahedra.size(); ++t)
      count += is_gone(model, t) && organ_.source.organ.split->dynamic[t] == 0;
    return count;
  }
  // Of all nodes that something is left around beyond `x`.
  double lowest_beyond(const OrganModel& model, double x) const {
    double lowest_m = 0;
    for (std::size_t t = 0; t < mesh().tetrahedra.size(); ++t)
      for (const NodeId n : mesh().tetrahedra[t])
        if (!is_gone(model, t) && mesh().positions[n].x() > x)
          lowest_m = std::min(lowest_m, model.view().body_u[3 * static_cast<std::size_t>(n) + 2]);
    return lowest_m;
  }

  test::HybridOrgan organ_ = [] {
    geometry::TetraMesh beam = test::make_box_mesh(8, 2, 2, Vec3(0.12, 0.03, 0.03));
    physics::FixedComponents fixed = test::held_at_low_x(beam, 1e-9);
    return test::HybridOrgan{std::move(beam), std::move(fixed), "plane:x>0.06"};
  }();
};

TEST_F(HybridCutModelTest, UncutItHangsAsTheHybridOnStoredTensorsDoes) {
  for (const char* law : {"linear", "corotational"}) {
    organ_.spec.dynamics->law = law;
    const auto ours = make("hybrid-cut"), stored = make("hybrid");
    for (OrganModel* model : {ours.get(), stored.get()}) pass(*model, 3);
    float most = 0, off = 0;
    for (std::size_t c = 0; c < stored->view().values.size(); ++c) {
      most = std::max(most, std::abs(stored->view().values[c]));
      off = std::max(off, std::abs(stored->view().values[c] - ours->view().values[c]));
    }
    EXPECT_LE(off, 2e-4F * most) << law;
  }
}

TEST_F(HybridCutModelTest, AStrokeThroughBothPartsCutsBoth) {
  for (const char* law : {"linear", "corotational"}) {
    organ_.spec.dynamics->law = law;
    const auto model = make("hybrid-cut");
    pass(*model, 0.5);
    stroke(*model, {.tool = 0,
                    .cut = 1,
                    .from = {Vec3(-1, 0.0147, -1), Vec3(-1, 0.0147, 1)},
                    .to = {Vec3(1, 0.0147, -1), Vec3(1, 0.0147, 1)}});
    const std::size_t precomputed = removed_of_the_precomputed(*model);
    EXPECT_GT(precomputed, 5U);
    EXPECT_GT(model->status().removed_tetrahedra, precomputed + 5U);
    pass(*model, 1);
    model->reset();
    EXPECT_EQ(model->status().removed_tetrahedra, 0U);
    pass(*model, 0.1);
  }
}

TEST_F(HybridCutModelTest, APieceOfBothPartsFallsOrIsDroppedAsTheSceneSays) {
  for (const char* law : {"linear", "corotational"}) {
    for (const char* pieces : {"fall", "drop"}) {
      organ_.spec.dynamics->law = law;
      organ_.spec.dynamics->pieces = pieces;
      const auto model = make("hybrid-cut");
      pass(*model, 1);
      const double before_m = lowest_beyond(*model, 0.05);
      stroke(*model, across(0.0376));
      ASSERT_GT(removed_of_the_precomputed(*model), 0U);
      pass(*model, 0.2);
      const bool falls = std::string_view(pieces) == "fall";
      EXPECT_EQ(lowest_beyond(*model, 0.05) < before_m - 0.1, falls) << law << ", " << pieces;
      EXPECT_EQ(lowest_beyond(*model, 0.05) == 0, !falls) << law << ", " << pieces;
    }
  }
}

// Where a node alone ties a piece to the wall it hangs on, it would swing: it is torn off there.
TEST_F(HybridCutModelTest, NothingSwingsFromASupport) {
  const auto touches = [&](std::size_t t, bool but_the_first) {
    const auto is_held = [&](NodeId n) { return mesh().positions[n].x() == 0 && (!but_the_first || n > 0); };
    return std::ranges::any_of(mesh().tetrahedra[t], is_held);
  };
  ASSERT_EQ(mesh().positions[0].x(), 0);
  std::vector<std::uint8_t> bits((mesh().tetrahedra.size() + 7) / 8);
  std::size_t tied = 0;
  for (std::size_t t = 0; t < mesh().tetrahedra.size(); ++t) {
    if (touches(t, true)) bits[t / 8] = static_cast<std::uint8_t>(bits[t / 8] | 1U << t % 8);
    tied += touches(t, false) && !touches(t, true);
  }
  ASSERT_GT(tied, 0U);
  organ_.spec.dynamics->pieces = "fall";
  const auto model = make("hybrid-cut");
  model->take_up(bits, bits, 1);
  for (std::size_t t = 0; t < mesh().tetrahedra.size(); ++t)
    EXPECT_TRUE(!touches(t, false) || is_gone(*model, t)) << t;
  pass(*model, 0.15);
  constexpr double kFall_s = 0.15, kDrag_per_s = 10;  // the organ's mass damping
  const double fallen_m =
      9.81 / kDrag_per_s * (kFall_s - (1 - std::exp(-kDrag_per_s * kFall_s)) / kDrag_per_s);
  EXPECT_NEAR(lowest_beyond(*model, 0.06), -fallen_m, 0.005);
}

TEST_F(HybridCutModelTest, WhoIsStartedAgainGoesOnWithTheSameCuts) {
  organ_.spec.dynamics->gravity_m_s2.setZero();  // so that both lie as they did
  const auto model = make("hybrid-cut"), other = make("hybrid-cut"), again = make("hybrid-cut");
  stroke(*model, {.tool = 0,
                  .cut = 1,
                  .from = {Vec3(0.02, 0.01, -1), Vec3(0.08, 0.01, -1)},
                  .to = {Vec3(0.02, 0.01, 0.02), Vec3(0.08, 0.01, 0.02)}});
  ASSERT_GT(removed_of_the_precomputed(*model), 0U);
  const OrganView cut = model->view();
  other->take_up(cut.removed_bits, cut.burnt_bits, cut.topology_version + 1);
  EXPECT_TRUE(std::ranges::equal(cut.removed_bits, other->view().removed_bits));
  // who was cut stroke by stroke, and who takes all of it off at once, are one body
  for (int i = 0; i < 5; ++i)
    stroke(*again, {.tool = 0,
                    .cut = 1,
                    .from = {Vec3(0.02, 0.01, -1), Vec3(0.08, 0.01, -1)},
                    .to = {Vec3(0.02, 0.01, 0.004 * (i + 1)), Vec3(0.08, 0.01, 0.004 * (i + 1))}});
  const OrganView strokes = again->view();
  other->take_up(strokes.removed_bits, strokes.burnt_bits, strokes.topology_version + 1);
  LocalPatch ours(model->sizes().local_nodes), theirs(ours);
  const PatchPlace place{0, {0.03, 0.0, 0.03}, 0.02};
  ASSERT_TRUE(again->local_model(place, ours) && other->local_model(place, theirs));
  ASSERT_EQ(ours.nodes, theirs.nodes);
  for (std::size_t i = 0; i < 9 * ours.node_count; ++i)
    EXPECT_NEAR(ours.compliance[i], theirs.compliance[i], 1e-4F * ours.compliance[0]);
}

TEST_F(HybridCutModelTest, AnyCutsAnywhereLeaveASoundOrgan) {
  for (const std::uint32_t seed : {0U, 1U, 2U, 3U}) {
    const HybridTrial trial{.model = "hybrid-cut",
                            .law = seed % 2 == 0 ? "corotational" : "linear",
                            .pieces = seed / 2 == 0 ? "fall" : "drop"};
    EXPECT_EQ(try_hybrid_cuts(organ_, trial, seed, 60), "") << "seed " << seed;
  }
}

TEST_F(HybridCutModelTest, ItsJournalMayNamePrecomputedTissueAndAHybridsMayNot) {
  const organ::Organ& organ = organ_.source.organ;
  for (const char* word : {"hybrid", "hybrid-cut"}) {
    const ModelEntry& entry = find_model(model_table(), word);
    auto source = std::make_unique<node::OrganSource>();
    source->organ = organ::load_organ(organ_.folder / "organ.h5", entry.needs);
    std::vector<ServedOrgan> served;
    served.push_back({std::move(source), nullptr});
    served.back().model = entry.make(*served.back().source, organ_.spec);
    const JournalScene scene = journal_scene("scene", served);
    OrganCuts cuts{.version = 3,
                   .removed_bits = std::vector<std::uint8_t>((organ.mesh.tetrahedra.size() + 7) / 8),
                   .burnt_bits = {}};
    cuts.burnt_bits.resize(cuts.removed_bits.size());
    const auto t = static_cast<std::size_t>(organ.split->parts.precomputed.tetrahedron.front());
    cuts.removed_bits[t / 8] = static_cast<std::uint8_t>(1U << t % 8);
    const auto file = organ_.folder / "cuts.json";
    std::ofstream(file) << journal_text(scene, {&cuts, 1});
    const std::string flaw = read_journal(file, scene).flaw;
    if (std::string_view(word) == "hybrid") {
      EXPECT_THAT(flaw, testing::HasSubstr("which is precomputed"));
    } else {
      EXPECT_EQ(flaw, "");
    }
  }
}

TEST_F(HybridCutModelTest, AnOrganWithoutADynamicPartIsRefused) {
  node::OrganSource whole;
  whole.organ.mesh = test::make_box_mesh(2, 1, 1, Vec3(0.02, 0.01, 0.01));
  organ_.spec.name = "stone";
  try {
    find_model(model_table(), "hybrid-cut").make(whole, organ_.spec);
    FAIL() << "it was made";
  } catch (const geometry::InputError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(testing::HasSubstr("stone"), testing::HasSubstr("no dynamic part")));
  }
}

TEST_F(HybridCutModelTest, ATickWithACutThroughBothAllocatesNothing) {
  const auto model = make("hybrid-cut");
  LocalPatch patch(model->sizes().local_nodes);
  const CutStroke cut = across(0.0376);
  const std::size_t before = test::heap_allocations();
  model->step({.presses = {}, .cuts = {&cut, 1}}, kTick_s);
  const bool offered = model->local_model({0, {0.02, 0.015, 0.03}, 0.02}, patch);
  EXPECT_EQ(test::heap_allocations(), before);
  EXPECT_TRUE(offered);
  EXPECT_GT(removed_of_the_precomputed(*model), 0U);
}

}  // namespace
}  // namespace omentum::deform
