// The scene hepatectomy, played by its own hands on a scripted bus: what they cut off, and what they feel of
// it.
#include "geometry/mesh_editor.h"
#include "organ/organ.h"
#include "tests/system/hurried_scene.h"
#include "tests/system/played_scene.h"

namespace omentum::test {
namespace {

/// Of the liver's pieces that are left: how many tetrahedra, and how far its surface rose in the mean, m.
struct Piece {
  int tetrahedra = 0, corners = 0;
  double risen_m = 0;
};
std::map<std::int32_t, Piece> pieces_of(const organ::Organ& organ, const msg::Topology& topology,
                                        const msg::OrganState& state) {
  geometry::MeshEditor editor(organ.mesh, {.smallest_piece_m3 = 0, .uncut_surface = organ.surface.node});
  editor.set_removed(topology.removed_bits);
  std::map<std::int32_t, Piece> pieces;
  for (std::size_t t = 0; t < organ.mesh.tetrahedra.size(); ++t) {
    if (editor.is_removed(geometry::TetId(t))) continue;
    Piece& piece = pieces[editor.piece_of(geometry::TetId(t))];
    ++piece.tetrahedra;
    for (const geometry::NodeId n : organ.mesh.tetrahedra[geometry::TetId(t)]) {
      const geometry::SurfaceId s = editor.surface_of(n);
      if (!s.valid()) continue;
      ++piece.corners;
      piece.risen_m += static_cast<double>(state.values.at(3 * static_cast<std::size_t>(s) + 2));
    }
  }
  for (auto& [id, piece] : pieces) piece.risen_m /= piece.corners;
  return pieces;
}

TEST(Hepatectomy, TheSegmentIsCutOffUnderTensionAndLiftedAwayAndNoHandIsHurt) {
  constexpr double kHurry = 2, kPulled_s = 6.6, kBridge_s = 12.6, kFree_s = 14.2, kEnd_s = 17.8;
  const ScratchFolder folder;
  const scene::Scene scene = scene::load_scene(prepare_hurried("hepatectomy", kHurry, folder.path()));
  const organ::Organ organ = organ::load_organ(scene.organs[0].file, organ::Load::kMeshOnly);
  PlayedScene play(scene);
  const auto pull_at = [&](double scene_s) {
    play.play(scene_s / kHurry - play.seconds());
    return play.felt(0).force.norm();
  };
  const double whole_n = pull_at(kPulled_s);
  EXPECT_GT(whole_n, 1);
  EXPECT_GT(pull_at(kBridge_s), 0.2 * whole_n) << "a bridge is left";
  EXPECT_LT(pull_at(kFree_s), 0.05 * whole_n) << "the last bridge went";
  pull_at(kEnd_s);
  ASSERT_TRUE(play.topology() && play.state());
  const auto pieces = pieces_of(organ, *play.topology(), *play.state());
  ASSERT_EQ(pieces.size(), 2u);
  const auto [segment, rest] =
      std::minmax({pieces.begin()->second, pieces.rbegin()->second},
                  [](const Piece& a, const Piece& b) { return a.tetrahedra < b.tetrahedra; });
  EXPECT_GT(segment.tetrahedra, 400);
  EXPECT_GT(segment.risen_m, 0.03);
  EXPECT_LT(std::abs(rest.risen_m), 0.01);

  EXPECT_LE(play.largest_step_n(), scene.haptics.max_slew_n_s / PlayedScene::kHand_hz);
  const nlohmann::json hand = play.hand_report(), cut = play.organ_report(), device = play.device_report();
  for (const nlohmann::json* report : {&hand, &cut, &device})
    EXPECT_EQ((*report)["faults"].size(), 0u) << (*report)["faults"];
  EXPECT_EQ(hand["hands"][0]["grasps"],
            (nlohmann::json{{"begun", 1}, {"empty", 0}, {"torn", 0}, {"lost", 0}}));
  EXPECT_GT(hand["hands"][0]["grip_torque_max_nm"], 1e-3) << "the edge resists the jaws";
  EXPECT_LT(hand["hands"][0]["force_max_n"], scene.score.pull_limit_n);
  EXPECT_GT(hand["hands"][1]["force_max_n"], 0.1) << "the hook rides on the tissue";
  EXPECT_GT(cut["removed_tetrahedra"], 200);
  EXPECT_LT(cut["repaired_tetrahedra"], 0.2 * cut["removed_tetrahedra"].get<double>());
  EXPECT_LT(cut["score"]["outside_cm3"], 0.2 * cut["score"]["removed_cm3"].get<double>());
  for (const nlohmann::json& of_hand : device["hands"])
    EXPECT_LE(of_hand["most_energy_j"], 0.01 * -device["energy_j"].get<double>());
}

}  // namespace
}  // namespace omentum::test
