// The hand's loop and the organ's with organs that have masses, as scenes choose them: no toy on either side.
#include "tests/system/exchange_session.h"

namespace omentum {
namespace {

using geometry::Vec3;
using test::kAbove;
using test::kPressed;
using test::Session;

/// The block, as it moves by itself.
test::ExchangeScene moving(const std::string& keys) {
  return {.file = test::block().scene_with("young_pa", "gravity_m_s2 = [0, 0, 0]\n" + keys + "\nyoung_pa"),
          .felt = scene::kOrganModels,
          .moved = deform::model_table()};
}
const char* const kTensorMass = "model = \"tensor-mass\"\nmass_damping_per_s = 5";
const char* const kCorotational = "model = \"corotational\"\nmass_damping_per_s = 5";
const char* const kSymplectic =
    "model = \"tensor-mass\"\nintegrator = \"symplectic\"\nmass_damping_per_s = 20\nstiffness_damping_s = "
    "0.002";
const char* const kStatic = "model = \"quasi-static-cut\"";
const char* const kSprings = "model = \"spring-mass\"\nmass_damping_per_s = 20\nstiffness_damping_s = 0.002";

TEST(DynamicExchange, AHeldPressIsThatOfTheWholeOrganAtEveryRate) {
  const double whole = test::whole_n();
  for (const double hand_hz : {300.0, 1000.0}) {
    for (const double organ_hz : {60.0, 150.0, 250.0}) {
      Session session(hand_hz, organ_hz, moving(kTensorMass));
      session.begin();
      EXPECT_NEAR(session.press().norm(), whole, 0.03 * whole) << hand_hz << " Hz, " << organ_hz << " Hz";
    }
  }
}

// Without masses there is nothing to wait for: the force is that of the tensors themselves.
TEST(DynamicExchange, APrecomputedOrganThatCanBeCutIsFeltAsOneThatCannot) {
  const double whole = test::whole_n();
  for (const double hand_hz : {300.0, 1000.0}) {
    for (const double organ_hz : {60.0, 250.0}) {
      Session session(hand_hz, organ_hz, moving(kStatic));
      session.begin();
      EXPECT_NEAR(session.press().norm(), whole, 0.005 * whole) << hand_hz << " Hz, " << organ_hz << " Hz";
    }
  }
}

TEST(DynamicExchange, AHandThatPressesCutsBeneathAndLetsGoGetsNoEnergyAndNoBlow) {
  Session session(1000, 100, moving(kStatic));
  session.begin();
  session.press();
  const double put_in_j = -session.given_j();
  session.move_to(kPressed + Vec3(0.03, 0, 0), 0.6, true);
  session.move_to(kAbove + Vec3(0.03, 0, 0), 0.5);
  session.move_to(kAbove, 0.5);
  EXPECT_LT(session.given_j(), 0.02 * put_in_j) << "of " << put_in_j << " J";
  EXPECT_LE(session.largest_step_n(), 2000 * 0.001 * (1 + 1e-6)) << "beyond the slew limit";
  const auto hand = session.hand_report(), organ = session.organ_report();
  EXPECT_EQ(hand["faults"].size(), 0u) << hand["faults"];
  EXPECT_EQ(organ["faults"].size(), 0u) << organ["faults"];
  EXPECT_GT(organ["removed_tetrahedra"], 2);
}

TEST(DynamicExchange, AHeldPressDoesNotDependOnTheRatesWhateverTheModelIs) {
  for (const char* model : {kCorotational, kSymplectic}) {
    std::vector<double> held;
    for (const double organ_hz : {60.0, 200.0}) {
      Session session(1000, organ_hz, moving(model));
      session.begin();
      held.push_back(session.press().norm());
    }
    EXPECT_GT(held[0], 0.5 * test::whole_n()) << model;
    EXPECT_NEAR(held[0], held[1], 0.03 * held[1]) << model;
  }
}

TEST(DynamicExchange, SpringsAreSeenAndNotFelt) {
  Session session(1000, 100, moving(kSprings));
  session.begin();
  EXPECT_EQ(session.press().norm(), 0);
}

TEST(DynamicExchange, APressThatGoesGivesTheHandNoEnergy) {
  for (const char* model : {kTensorMass, kCorotational, kStatic}) {
    Session session(1000, 100, moving(model));
    session.begin();
    session.press();
    const double put_in_j = -session.given_j();
    session.slide_and_leave();
    EXPECT_LT(session.given_j(), 0.02 * put_in_j) << model << ", of " << put_in_j << " J";
    EXPECT_GT(put_in_j, 1e-4) << model;
  }
}

TEST(DynamicExchange, ForcesMakeNoStepWhileAToolSlidesOverAMovingOrgan) {
  Session session(1000, 100, moving(kTensorMass));
  session.begin();
  const double held = session.press().norm();
  session.slide_to_and_fro();
  EXPECT_LT(session.largest_step_n(), 0.1 * held);
}

TEST(DynamicExchange, APressBesideASupportIsFelt) {
  Session session(1000, 100, moving(kTensorMass));
  const Vec3 outside{-0.004, 0.053, 0.012}, inside{0.003, 0.053, 0.012};
  session.move_to(kAbove, 1.5);
  session.move_to(Vec3(-0.02, 0.053, 0.103), 0.5);
  session.move_to(Vec3(-0.02, 0.053, 0.012), 0.5);
  session.move_to(outside, 0.5);
  session.move_to(inside, 0.5);
  EXPECT_GT(session.move_to(inside, 0.5).norm(), 0.2);
  EXPECT_EQ(session.hand_report()["faults"].size(), 0u);
}

TEST(DynamicExchange, ABladeWithinThePressCutsAndTheHandGoesOnFeeling) {
  Session session(1000, 100, moving(kTensorMass));
  session.begin();
  session.press();
  session.move_to(kPressed + Vec3(0.03, 0, 0), 0.6, true);
  session.move_to(kAbove + Vec3(0.03, 0, 0), 0.3);
  session.move_to(kAbove + Vec3(0.02, 0.03, 0), 0.3);
  const Vec3 beside = kPressed + Vec3(0.02, 0.03, 0);
  session.move_to(beside, 0.5);
  EXPECT_GT(session.move_to(beside, 0.5).norm(), 0.2) << "what is left is still an organ";
  const auto hand = session.hand_report(), organ = session.organ_report();
  EXPECT_EQ(hand["faults"].size(), 0u) << hand["faults"];
  EXPECT_EQ(organ["faults"].size(), 0u) << organ["faults"];
  EXPECT_GT(organ["removed_tetrahedra"], 2);
}

// It heard of no cut: what is left of the organ comes with the models alone.
TEST(DynamicExchange, AHandThatJoinsAfterManyCutsFeelsTheSlitAsTheFirstOneDid) {
  Session session(1000, 100, moving(kTensorMass));
  session.begin();
  const double whole = session.press().norm();
  session.move_to(kPressed + Vec3(0.03, 0, 0), 0.6, true);
  const auto felt = [&session] {
    std::vector<double> felt_n;
    for (const Vec3& aside : {Vec3(0.012, 0, 0), Vec3(0.02, 0.03, 0), Vec3(-0.02, 0.02, 0)}) {
      session.move_to(kAbove + aside, 0.3);
      session.move_to(kPressed + aside, 0.5);
      felt_n.push_back(session.move_to(kPressed + aside, 0.5).norm());
      session.move_to(kAbove + aside, 0.3);
    }
    return felt_n;
  };
  const std::vector<double> first = felt();
  const auto before = session.bus().newest<msg::Topology>();
  session.replace_hand();
  session.begin();
  const std::vector<double> late = felt();
  EXPECT_LT(first[0], 0.5 * whole) << "in the slit";
  EXPECT_GT(first[2], 0.5 * whole) << "beside it";
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_NEAR(late[i], first[i], 0.01 * whole) << i;
  const auto after = session.bus().newest<msg::Topology>();
  ASSERT_TRUE(before && after);
  EXPECT_EQ(after->removed_bits, before->removed_bits) << "who joins cuts nothing";
  session.move_to(kPressed + Vec3(-0.02, 0.02, 0), 0.5);
  EXPECT_EQ(session.bus().newest<msg::Contact>()->topology_version, after->version);
  EXPECT_EQ(session.hand_report()["faults"].size(), 0u);
}

}  // namespace
}  // namespace omentum
