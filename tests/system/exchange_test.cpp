// The hand's loop and the organ's, with an organ that changes by itself, on one scripted bus: what each tells
// the other comes to a press that both agree on.
#include "tests/system/exchange_session.h"

namespace omentum {
namespace {

using geometry::Vec3;
using test::kPressed;
using test::Session;

TEST(Exchange, AHeldPressIsThatOfTheWholeOrganAtEveryRate) {
  const double whole = test::whole_n();
  ASSERT_GT(whole, 0.1);
  for (const double hand_hz : {300.0, 500.0, 1000.0}) {
    for (const double organ_hz : {60.0, 100.0, 200.0}) {
      Session session(hand_hz, organ_hz);
      session.begin();
      EXPECT_NEAR(session.press().norm(), whole, 0.03 * whole) << hand_hz << " Hz, " << organ_hz << " Hz";
    }
  }
}

TEST(Exchange, APressThatGoesGivesTheHandNoEnergy) {
  for (const double organ_hz : {60.0, 100.0, 200.0}) {
    Session session(1000, organ_hz);
    session.begin();
    session.press();
    const double put_in_j = -session.given_j();
    session.slide_and_leave();
    EXPECT_LT(session.given_j(), 0.02 * put_in_j) << organ_hz << " Hz, of " << put_in_j << " J";
    EXPECT_GT(put_in_j, 1e-4);
  }
}

TEST(Exchange, ForcesMakeNoStepWhileModelsComeAndGo) {
  Session session(1000, 100);
  session.begin();
  const double held = session.press().norm();
  session.slide_to_and_fro();
  EXPECT_LT(session.largest_step_n(), 0.05 * held);
}

TEST(Exchange, WithTheOrganStoppedTheForceGoes) {
  Session session(1000, 100);
  session.begin();
  ASSERT_GT(session.press().norm(), 0.1);
  session.stop_organ();
  EXPECT_GT(session.move_to(kPressed, 0.15).norm(), 0.1);
  EXPECT_EQ(session.move_to(kPressed, 0.15).norm(), 0);
  EXPECT_LE(session.largest_step_n(), 2 + 1e-9) << "2 kN/s at 1 kHz";
}

TEST(Exchange, AStrokeWithinThePressIsCutOnceAndTheHandGoesOnFeeling) {
  Session session(1000, 100);
  session.begin();
  const double held = session.press().norm();
  const Vec3 beside = kPressed + Vec3(0.005, 0, 0);
  EXPECT_GT(session.move_to(beside, 0.25, true).norm(), 0.5 * held) << "while the version rises";
  session.move_to(beside, 0.1);
  const auto topology = session.bus().newest<msg::Topology>();
  ASSERT_TRUE(topology);
  EXPECT_GT(topology->version, 20u) << "a stroke in each tick";
  const auto hand = session.hand_report(), organ = session.organ_report();
  EXPECT_EQ(hand["faults"].size(), 0u) << hand["faults"];
  EXPECT_EQ(organ["faults"].size(), 0u) << organ["faults"];
  EXPECT_EQ(organ["removed_tetrahedra"], topology->version);
}

}  // namespace
}  // namespace omentum
