// The hand's loop and the organ's with an intestine between them.
#include "device_bridge/hand_model.h"
#include "geometry/gut_anatomy.h"
#include "geometry/gut_skin.h"
#include "tests/support/process.h"
#include "tests/system/exchange_session.h"

#include <fstream>
#include <numbers>

namespace omentum {
namespace {

using geometry::Vec3;
using test::Session;

// Of a step in a force that is felt anyway: a hand tells a tenth of a newton apart at best.
constexpr double kUnnoticed_n = 0.1;
constexpr double kDeep_m = 0.006, kSettles_s = 12;

/// An intestine that comes to rest on a plane below where sessions begin.
class GutExchange : public testing::Test {
 protected:
  GutExchange() : gut_(geometry::make_gut(anatomy())), skin_(gut_) {}

  static constexpr const char* kTwoPoints = "[[0,0,0], [0.003,0,0.001]]\n[haptics]\nfriction = 0.5\n";
  static constexpr const char* kBall =
      "[[0,0,0], [0.0026,0,0.0009], [-0.0013,0.0022,0.0009], [-0.0013,-0.0022,0.0009], [0.0039,0,0.0033], "
      "[0,0.0039,0.0033], [-0.0039,0,0.0033], [0,-0.0039,0.0033]]\n";

  test::ExchangeScene scene(const std::string& keys = "", const std::string& points = kTwoPoints) {
    const std::filesystem::path file = folder_ / "scene.toml";
    std::ofstream(file)
        << "name = \"gut\"\n[[organs]]\nname = \"gut\"\nmodel = \"intestine\"\norigin = [0, 0, -0.3]\n"
        << keys
        << "\n[[obstacles]]\nshape = \"plane\"\ncentre = [0, 0, -0.43]\nnormal = [0, 0, 1]\n"
           "[[tools]]\nid = 0\nname = \"grasper\"\nshape = \"grasper\"\ngrip_force_n = 40\n"
           "points = "
        << points;
    return {.file = file, .felt = scene::kOrganModels, .moved = deform::model_table()};
  }
  std::vector<Vec3> skin_now(Session& session) {
    const auto state = session.bus().newest<msg::OrganState>();
    std::vector<Vec3> x, places(skin_.node_count());
    for (std::size_t i = 0; state && i < state->values.size(); i += 3)
      x.emplace_back(state->values[i], state->values[i + 1], state->values[i + 2]);
    EXPECT_EQ(x.size(), gut_.positions.size());
    skin_.place(x, places);
    return places;
  }
  double nearest_m(Session& session, const Vec3& p) {
    double nearest = 1;
    for (const Vec3& place : skin_now(session)) nearest = std::min(nearest, (place - p).norm());
    return nearest;
  }
  /// Of its skin.
  Vec3 highest(Session& session) {
    const std::vector<Vec3> places = skin_now(session);
    return *std::ranges::max_element(places, {}, [](const Vec3& p) { return p.z(); });
  }
  /// Comes down onto its highest place, once the gut lies still, and stays there.
  Vec3 press(Session& session, double settles_s = kSettles_s) {
    session.move_to(test::kAbove, settles_s);
    top_ = highest(session);
    session.move_to(above(), 0.5);
    session.move_to(pressed(), 0.5);
    return session.move_to(pressed(), 1.5);
  }
  Vec3 above() const { return top_ + Vec3(0, 0, 0.02); }
  Vec3 pressed() const { return top_ - Vec3(0, 0, kDeep_m); }

  static geometry::GutAnatomy anatomy() {
    geometry::GutAnatomy anatomy;
    anatomy.origin = {0, 0, -0.3};
    return anatomy;
  }

  test::ScratchFolder folder_;
  geometry::GutShape gut_;
  geometry::GutSkin skin_;
  Vec3 top_ = Vec3::Zero();
};

// Of a gut that has one place to be: stiff and without weight. How soft folds come to lie hangs on the way
// there.
TEST_F(GutExchange, AHeldPressDoesNotDependOnTheHandsRate) {
  const std::string stiff = "gravity_m_s2 = [0, 0, 0]\ngut_bending_n_m2 = 2\nmesentery_stretch_n_m = 5000";
  Session fast(1000, 100, scene(stiff)), slow(300, 100, scene(stiff));
  const double expected = press(fast, 1).norm();
  EXPECT_GT(expected, 0.02);
  EXPECT_LT(expected, 3 * kDeep_m * 300) << "the wall of three nodes in front of a gut that does not move";
  EXPECT_NEAR(press(slow, 1).norm(), expected, 0.03 * expected);
  for (Session* session : {&fast, &slow}) {
    const auto hand = session->hand_report(), organ = session->organ_report();
    EXPECT_EQ(hand["faults"].size(), 0u) << hand["faults"];
    EXPECT_EQ(organ["faults"].size(), 0u) << organ["faults"];
  }
}

TEST_F(GutExchange, APressThatGoesGivesTheHandNoEnergyAndItsForceMakesNoStep) {
  Session session(1000, 100, scene());
  press(session);
  const double put_in_j = -session.given_j();
  EXPECT_GT(put_in_j, 1e-4);
  session.move_to(pressed() + Vec3(0, 0.005, 0), 0.5);
  session.move_to(above(), 0.5);
  EXPECT_LT(session.given_j(), 0.02 * put_in_j) << "of " << put_in_j << " J";
  EXPECT_LT(session.largest_step_n(), kUnnoticed_n);
}

TEST_F(GutExchange, AGraspedLoopIsLiftedAndComesDownWhenItIsLetGo) {
  Session session(1000, 100, scene());
  session.open_jaws(0.5);
  session.move_to(test::kAbove, kSettles_s);
  top_ = highest(session);
  session.move_to(above(), 0.5);
  session.move_to(top_ - Vec3(0, 0, 0.003), 0.5);
  session.open_jaws(0);
  session.move_to(top_ - Vec3(0, 0, 0.003), 0.2);
  const Vec3 lifted = top_ + Vec3(0, 0, 0.06);
  session.move_to(lifted, 1);
  const Vec3 force = session.move_to(lifted, 1);
  EXPECT_LT(force.z(), -0.2) << "its weight, and its mesentery, " << session.given_j();
  EXPECT_LT(nearest_m(session, lifted), 0.02);
  session.open_jaws(0.5);
  EXPECT_LT(session.move_to(lifted, 1).norm(), 0.01);
  EXPECT_GT(nearest_m(session, lifted), 0.02);
  const auto hand = session.hand_report(), organ = session.organ_report();
  EXPECT_EQ(hand["faults"].size(), 0u) << hand["faults"];
  EXPECT_EQ(organ["faults"].size(), 0u) << organ["faults"];
}

/// A hand as the simulated one is: it yields to what it feels, and swings if that swings.
class YieldingHand {
 public:
  YieldingHand(Session& session, const Vec3& begin) : session_(session), at_{begin, Vec3::Zero()} {
    hand_.stiffness_n_m = 300;
  }

  /// Its target goes there evenly.
  Vec3 lead_to(const Vec3& target, double seconds) {
    const int ticks = static_cast<int>(std::lround(seconds / kPeriod_s));
    const Vec3 from = target_, velocity = (target - from) / seconds;
    for (int i = 1; i <= ticks; ++i) {
      target_ = from + i * kPeriod_s * velocity;
      for (int k = 0; k < 4; ++k)
        at_ = device::step_hand(hand_, at_, {target_, velocity}, force_, kPeriod_s / 4);
      force_ = session_.move_to(at_.position, kPeriod_s);
    }
    return force_;
  }

 private:
  static constexpr double kPeriod_s = 1e-3;
  Session& session_;
  scene::HandSpec hand_;
  device::Motion at_;
  Vec3 target_ = at_.position, force_ = Vec3::Zero();
};

// The path is closed: what others of the pile take, and what the mesentery holds, is the hand's loss.
TEST_F(GutExchange, AGraspedLoopThatIsDraggedOverOthersNeverFeedsTheHand) {
  Session session(1000, 100, scene("", kBall));
  session.open_jaws(0.5);
  session.move_to(test::kAbove, 5);
  top_ = highest(session);
  session.move_to(above(), 0.3);
  const Vec3 grasped = top_ - Vec3(0, 0, 0.004), lifted = grasped + Vec3(0, 0, 0.03),
             aside = lifted + Vec3(0.1, 0, 0);
  YieldingHand hand(session, above());
  hand.lead_to(grasped, 0.5);
  session.open_jaws(0);
  hand.lead_to(lifted, 0.7);
  hand.lead_to(aside, 1.5);
  EXPECT_GT(hand.lead_to(aside, 0.5).norm(), 1);
  hand.lead_to(lifted, 1);
  hand.lead_to(grasped, 0.7);
  EXPECT_LT(session.largest_step_n(), 2 * kUnnoticed_n);
  EXPECT_LT(session.most_given_j(), 1e-3);
  EXPECT_LT(session.given_j(), -0.05);
  const auto report = session.hand_report();
  EXPECT_EQ(report["faults"].size(), 0u) << report["faults"];
}

TEST_F(GutExchange, JawsThatCircleFastThroughThePileGetNothing) {
  Session session(1000, 100, scene("", kBall));
  session.open_jaws(0.5);
  session.move_to(test::kAbove, 3);
  top_ = highest(session);
  session.move_to(above(), 0.3);
  const Vec3 grasped = top_ - Vec3(0, 0, 0.004), begin = grasped + Vec3(0, 0, 0.02);
  session.move_to(grasped, 0.5);
  session.open_jaws(0);
  session.move_to(begin, 0.5);
  const double before_j = session.given_j();
  constexpr double kRadius_m = 0.03, kTurn = 0.5 / kRadius_m / 1000;  // half a metre a second
  for (double angle = 0; angle < 4 * std::numbers::pi; angle += kTurn)
    session.move_to(begin + kRadius_m * Vec3(std::cos(angle) - 1, std::sin(angle), 0), 1e-3);
  session.move_to(begin, 0.2);
  EXPECT_LT(session.given_j(), before_j - 0.1);
  EXPECT_LT(session.most_given_j(), 1e-3);
  const auto report = session.hand_report();
  EXPECT_EQ(report["faults"].size(), 0u) << report["faults"];
}

TEST_F(GutExchange, AProbeThatTeleportsThroughTheGutLeavesItWhole) {
  Session session(1000, 100, scene());
  session.move_to(test::kAbove, kSettles_s);
  top_ = highest(session);
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
