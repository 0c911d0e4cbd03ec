// The hand's loop and the organ's with an intestine between them.
#include "geometry/gut_anatomy.h"
#include "geometry/gut_skin.h"
#include "tests/support/process.h"
#include "tests/system/exchange_session.h"

#include <fstream>

namespace omentum {
namespace {

using geometry::Vec3;
using test::Session;

constexpr double kDeep_m = 0.006, kSettles_s = 5, kPlane_m = -0.38;

/// A short intestine that comes to rest on a plane below where sessions begin.
class GutExchange : public testing::Test {
 protected:
  GutExchange() : gut_(geometry::make_gut(anatomy())), skin_(gut_) {}

  test::ExchangeScene scene(const std::string& keys = "") {
    const std::filesystem::path file = folder_ / "scene.toml";
    std::ofstream(file)
        << "name = \"gut\"\n[[organs]]\nname = \"gut\"\nmodel = \"intestine\"\nlength_m = 1.6\n"
           "legs = 3\ncolumns = 40\norigin = [0, 0, -0.3]\n"
        << keys
        << "\n[[obstacles]]\nshape = \"plane\"\ncentre = [0, 0, -0.38]\nnormal = [0, 0, 1]\n"
           "[[tools]]\nid = 0\nname = \"probe\"\nshape = \"probe\"\n"
           "points = [[0,0,0], [0.003,0,0.001]]\n";
    return {.file = file, .felt = scene::kOrganModels, .moved = deform::model_table()};
  }
  /// On top of a loop that lies on the plane, with nothing above it, in the newest state.
  Vec3 lying(Session& session) {
    const auto state = session.bus().newest<msg::OrganState>();
    std::vector<Vec3> x, places(skin_.node_count());
    for (std::size_t i = 0; state && i < state->values.size(); i += 3)
      x.emplace_back(state->values[i], state->values[i + 1], state->values[i + 2]);
    EXPECT_EQ(x.size(), gut_.positions.size());
    skin_.place(x, places);
    const auto is_free = [&](const Vec3& p) {
      if (std::abs(p.z() - (kPlane_m + 2 * gut_.tube_radius_m)) > 0.002) return false;
      return std::ranges::none_of(places, [&](const Vec3& other) {
        return (other - p).head<2>().norm() < 0.03 && other.z() > p.z() + 5e-4;
      });
    };
    const auto found = std::ranges::find_if(places, is_free);
    EXPECT_NE(found, places.end()) << "a loop on the plane";
    return found != places.end() ? *found : places.front();
  }
  /// Comes down onto it, once the gut lies still, and stays there.
  Vec3 press(Session& session) {
    session.move_to(test::kAbove, kSettles_s);
    top_ = lying(session);
    session.move_to(above(), 0.5);
    session.move_to(pressed(), 0.5);
    return session.move_to(pressed(), 1.5);
  }
  Vec3 above() const { return top_ + Vec3(0, 0, 0.02); }
  Vec3 pressed() const { return top_ - Vec3(0, 0, kDeep_m); }

  static geometry::GutAnatomy anatomy() {
    geometry::GutAnatomy anatomy;
    anatomy.length_m = 1.6;
    anatomy.legs = 3;
    anatomy.columns = 40;
    anatomy.origin = {0, 0, -0.3};
    return anatomy;
  }

  test::ScratchFolder folder_;
  geometry::GutShape gut_;
  geometry::GutSkin skin_;
  Vec3 top_ = Vec3::Zero();
};

TEST_F(GutExchange, AHeldPressOnALoopThatLiesDoesNotDependOnTheRates) {
  Session expected_session(1000, 100, scene());
  const double expected = press(expected_session).norm();
  EXPECT_GT(expected, 0.5 * kDeep_m * 300) << "half of one node's wall";
  EXPECT_LT(expected, 3 * kDeep_m * 300) << "the wall of three nodes";
  for (const auto& [hand_hz, organ_hz] :
       {std::pair{300.0, 100.0}, std::pair{1000.0, 60.0}, std::pair{1000.0, 200.0}}) {
    Session session(hand_hz, organ_hz, scene());
    EXPECT_NEAR(press(session).norm(), expected, 0.03 * expected) << hand_hz << " Hz, " << organ_hz << " Hz";
    const auto hand = session.hand_report(), organ = session.organ_report();
    EXPECT_EQ(hand["faults"].size(), 0u) << hand["faults"];
    EXPECT_EQ(organ["faults"].size(), 0u) << organ["faults"];
  }
}

TEST_F(GutExchange, APressThatGoesGivesTheHandNoEnergyAndItsForceMakesNoStep) {
  Session session(1000, 100, scene());
  const double held = press(session).norm();
  const double put_in_j = -session.given_j();
  EXPECT_GT(put_in_j, 1e-4);
  session.move_to(pressed() + Vec3(0, 0.005, 0), 0.5);
  session.move_to(above(), 0.5);
  EXPECT_LT(session.given_j(), 0.02 * put_in_j) << "of " << put_in_j << " J";
  EXPECT_LT(session.largest_step_n(), 0.1 * held);
}

TEST_F(GutExchange, AProbeThatTeleportsThroughTheGutLeavesItWhole) {
  Session session(1000, 100, scene());
  session.move_to(test::kAbove, kSettles_s);
  top_ = lying(session);
  session.move_to(above(), 0.5);
  for (int i = 0; i < 400; ++i) {
    const Vec3 where = i / 20 % 2 == 0 ? Vec3(top_ - Vec3(0, 0, 0.06)) : above();
    EXPECT_TRUE(session.step_to(where).allFinite());
  }
  session.move_to(above(), 1);
  const auto organ = session.organ_report();
  for (const auto& fault : organ["faults"])
    EXPECT_EQ(fault.dump().find("diverged"), std::string::npos) << fault;
}

}  // namespace
}  // namespace omentum
