// One whole script of the scene's hands: wait, approach, press, hold, slide, release. Force is in newtons,
// not in impulses, so that it does not depend on how often it is computed; and tissue gives back what it got.
// All answers come in time: what a hand may be given after a stall is another bound (hand_energy_test.cpp).
#include "scene_session.h"
#include "tests/support/scene_organ.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <string>

namespace omentum::haptic_test {
namespace {

constexpr double kWithin = 0.02;                 // the issue's
constexpr double kFelt_n = 0.1, kFelt_j = 1e-5;  // it was pressed at all

TEST(SceneRate, PressingAndSlidingFeelTheSameAt300HzAndAt1000Hz) {
  const auto scene = liver_scene(6e3);
  if (!scene) GTEST_SKIP() << "organ_phantom is absent";
  SceneSession slow(*scene, 300), fast(*scene, 1000);
  slow.run();
  fast.run();
  for (std::size_t h = 0; h < fast.hand_count(); ++h) {
    const nlohmann::json felt_slow = slow.hand(h).report(), felt_fast = fast.hand(h).report();
    EXPECT_GT(felt_fast["mean_force_n"].get<double>(), kFelt_n) << "hand " << h;
    for (const char* field : {"mean_force_n", "hold_force_n", "peak_force_n"}) {
      const double expected = felt_fast[field];
      EXPECT_NEAR(felt_slow[field].get<double>(), expected, kWithin * expected)
          << "hand " << h << ' ' << field;
    }
  }
}

struct Tissue {
  const char* name;
  double young_pa;
  double rate_hz;
};
void PrintTo(const Tissue& tissue, std::ostream* out) {
  *out << tissue.name;
}

class SceneEnergy : public testing::TestWithParam<Tissue> {
 protected:
  void SetUp() override {
    scene_ = liver_scene(GetParam().young_pa);
    if (!scene_) GTEST_SKIP() << "organ_phantom is absent";
  }
  static std::string figures_of(const std::string& who, const EnergyAccount& energy) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "%-16s %-15s put in %8.4f mJ, given in all %+.4f mJ (%+.4f %%), at most %+.3f uJ",
                  GetParam().name, who.c_str(), 1e3 * energy.put_in_j, 1e3 * energy.given_j,
                  100 * energy.given_j / energy.put_in_j, 1e6 * energy.most_given_j);
    std::puts(text);
    return text;
  }
  /// A sum of that many terms, each rounded.
  static double rounding_j(const SceneSession& session, const EnergyAccount& energy) {
    return std::numeric_limits<double>::epsilon() * static_cast<double>(session.ticks()) *
           energy.turned_over_j;
  }

  std::optional<scene::Scene> scene_;
};

INSTANTIATE_TEST_SUITE_P(
    Liver, SceneEnergy,
    testing::Values(Tissue{"soft_at_300_hz", 1e3, 300}, Tissue{"soft_at_1000_hz", 1e3, 1000},
                    Tissue{"usual_at_300_hz", 6e3, 300}, Tissue{"usual_at_1000_hz", 6e3, 1000},
                    Tissue{"stiff_at_300_hz", 50e3, 300}, Tissue{"stiff_at_1000_hz", 50e3, 1000}),
    [](const auto& info) { return std::string(info.param.name); });

TEST_P(SceneEnergy, AHandAloneIsNeverGivenMoreThanAHundredthOfWhatItHadPutIn) {
  const std::vector<scene::HandSpec> hands = scene_->hands;
  for (const scene::HandSpec& hand : hands) {
    scene_->hands = {hand};
    SceneSession session(*scene_, GetParam().rate_hz);
    session.run();
    const EnergyAccount& energy = session.hand(0).energy();
    const std::string figures = figures_of("hand " + std::to_string(hand.tool) + " alone", energy);
    EXPECT_GT(energy.put_in_j, kFelt_j) << figures << ": it was meant to press";
    EXPECT_LE(energy.excess_j, rounding_j(session, energy)) << figures;
  }
}

// Where the organ is pressed by one it moves under the other: at its first touch, when it has put in nothing
// yet, a hand may be pushed by its neighbour. Tissue can be asked for the sum only.
TEST_P(SceneEnergy, HandsTogetherAreNeverGivenMoreThanAHundredthOfWhatTheyHadPutIn) {
  SceneSession session(*scene_, GetParam().rate_hz);
  session.run();
  const EnergyAccount& sum = session.together();
  const std::string figures = figures_of("both hands", sum);
  EXPECT_LE(sum.excess_j, rounding_j(session, sum)) << figures;
  for (std::size_t h = 0; h < session.hand_count(); ++h) {
    const EnergyAccount& energy = session.hand(h).energy();
    const std::string its_own = figures_of("hand " + std::to_string(h) + " of both", energy);
    EXPECT_GT(energy.put_in_j, kFelt_j) << its_own << ": it was meant to press";
    EXPECT_LE(energy.most_given_j, EnergyAccount::kGain * energy.put_in_j)
        << its_own << ", over the whole script";
    EXPECT_NEAR(session.channel(h).energy_j(), energy.given_j, rounding_j(session, energy))
        << its_own << ": what the device says itself";
    EXPECT_EQ(session.channel(h).held_back(), 0U) << "the tissue's doing, not the guard's";
  }
  EXPECT_TRUE(session.faults().empty()) << session.faults().front();
}

// Each on an organ of its own: nothing passes between them.
TEST(SceneEnergyOfTwoOrgans, EachHandGetsBackAtMostWhatItPutInAndFeelsItsOwnOrgan) {
  const test::ScratchFolder folder;
  if (!test::build_scene_organs("two_organs", test::Regions::kNone, folder.path()))
    GTEST_SKIP() << "organ_phantom is absent";
  const scene::Scene scene = scene::load_scene(folder / "two_organs.toml");
  SceneSession session(scene, 1000);
  session.run();
  for (std::size_t h = 0; h < session.hand_count(); ++h) {
    const EnergyAccount& energy = session.hand(h).energy();
    EXPECT_GT(energy.put_in_j, kFelt_j) << "hand " << h;
    EXPECT_LE(energy.excess_j, std::numeric_limits<double>::epsilon() * static_cast<double>(session.ticks()) *
                                   energy.turned_over_j)
        << "hand " << h << " was given " << energy.given_j << " J for " << energy.put_in_j << " J";
  }
  EXPECT_TRUE(session.faults().empty()) << session.faults().front();
}

}  // namespace
}  // namespace omentum::haptic_test
