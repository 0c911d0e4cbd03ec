// The hand's loop and the organ's with an organ of two meshes, the precomputed one finer: one body to the
// hand.
#include "organ/build_organ.h"
#include "organ/joined_parts.h"
#include "tests/support/meshes.h"
#include "tests/system/exchange_session.h"

namespace omentum {
namespace {

using geometry::Vec3;
using test::Session;

constexpr double kTiedBorderX_m = 0.05, kOverTied_m = 0.103, kOnTied_m = 0.094;

// A block of 10 cm: the half at small x is held from below, the other one hangs on it.
class TiedBlock {
 public:
  TiedBlock() {
    geometry::TetraMesh coarse = test::make_box_mesh(2, 4, 4, {kTiedBorderX_m, 0.1, 0.1});
    for (Vec3& p : coarse.positions) p.x() += kTiedBorderX_m;
    organ::JoinedParts joined =
        organ::join_parts(test::make_box_mesh(4, 8, 8, {kTiedBorderX_m, 0.1, 0.1}), coarse, 0, "");
    organ::FixedComponents fixed;
    for (const Vec3& p : joined.mesh.positions)
      fixed.push_back(p.z() == 0 && p.x() < 0.04 ? physics::kPinned : 0);
    const organ::Organ organ =
        organ::make_organ("block", std::move(joined.mesh), test::block().organ().material, std::move(fixed),
                          organ::Storage::kFloat, std::move(joined.dynamic), std::move(joined.border));
    organ::build_organ(organ, file(), {});
    std::string text = test::read_text(test::block().scene());
    const auto replace = [&](const std::string& what, const std::string& with) {
      text.replace(text.find(what), what.size(), with);
    };
    replace("young_pa",
            "model = \"hybrid\"\nmass_damping_per_s = 5\ndynamic_mesh = \"coarse.msh\"\nyoung_pa");
    replace("block.h5", file());
    std::ofstream(folder_ / "scene.toml") << text;
  }

  test::ExchangeScene scene() const {
    return {.file = folder_ / "scene.toml", .felt = scene::kOrganModels, .moved = deform::model_table()};
  }

 private:
  std::string file() const { return folder_ / "tied.h5"; }
  test::ScratchFolder folder_;
};

TEST(TiedExchange, AToolThatSlidesAcrossABorderOfTwoMeshesAndBackFeelsNoStep) {
  const TiedBlock block;
  Session session(1000, 100, block.scene());
  session.begin();
  session.move_to({0.03, 0.053, kOverTied_m}, 0.5);
  session.move_to({0.03, 0.053, kOnTied_m}, 0.5);
  const double held = session.move_to({0.03, 0.053, kOnTied_m}, 1).norm();
  EXPECT_GT(held, 0.3);
  double last = held, largest_jump = 0, sideways = 0;
  for (const double end : {0.07, 0.03}) {
    const double begin = 0.1 - end;
    for (int i = 1; i <= 2000; ++i) {
      const Vec3 force = session.step_to({begin + (end - begin) * i / 2000, 0.053, kOnTied_m});
      largest_jump = std::max(largest_jump, std::abs(force.norm() - last));
      sideways = std::max(sideways, std::abs(force.x()) / force.norm());
      last = force.norm();
    }
  }
  RecordProperty("jump", std::to_string(largest_jump / held));
  RecordProperty("sideways", std::to_string(sideways));
  EXPECT_LT(largest_jump, 0.02 * held);
  EXPECT_LT(sideways, 0.5) << "no wall inside: what slides along the tissue is pushed away from it";
  EXPECT_NEAR(last, held, 0.05 * held) << "still under way; a contact that was lost would be a quarter";
  EXPECT_EQ(session.hand_report()["faults"].size(), 0u);
}

}  // namespace
}  // namespace omentum
