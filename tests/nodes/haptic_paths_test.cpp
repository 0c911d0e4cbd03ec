// Forces that should not be there: hands that go through, around and along organs by continuous motion. The
// suite tries a few random paths an organ; OMENTUM_PATHS=1000 tries so many in all.
#include "hand_paths.h"
#include "path_trial.h"
#include "tests/support/trial_organs.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <tuple>

namespace omentum::haptic_test {
namespace {

using geometry::Vec3;

constexpr double kPath_s = 4;
constexpr std::array<double, 4> kStalls_s = {0.005, 0.015, 0.025, 0.04};

class ContinuousPaths : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    model_ = test::scene_model(GetParam());
    if (!model_) GTEST_SKIP() << GetParam() << ": ../shared/data or organ_phantom is absent";
  }
  /// Paths of this organ: 1, 2, ...
  static int count() {
    const char* all = std::getenv("OMENTUM_PATHS");
    constexpr int kOrgans = 4;
    return all ? (std::atoi(all) + kOrgans - 1) / kOrgans : 3;
  }
  /// Each path is gone once in a process, whatever is asked of it. Every other one turns the tools.
  const Findings& go(int path, Coupling coupling = Coupling::kBare,
                     std::span<const double> stalls_s = {}) const {
    static std::map<std::tuple<const haptic::HapticModel*, int, Coupling, std::size_t>, Findings> known;
    const auto [entry, is_new] = known.try_emplace({model_, path, coupling, stalls_s.size()});
    if (is_new) {
      std::vector<Way> ways;
      for (std::uint32_t tool = 0; tool < 2; ++tool) {
        const auto seed = 2 * static_cast<std::uint32_t>(path) + tool;
        const auto hand = std::make_shared<HandPath>(*model_, seed, kPath_s, path % 2 == 0);
        ways.emplace_back([hand](double t) { return hand->at(t); });
      }
      entry->second = PathTrial(*model_, std::move(ways), coupling).run(kPath_s, stalls_s);
    }
    return entry->second;
  }

  const haptic::HapticModel* model_ = nullptr;
};

INSTANTIATE_TEST_SUITE_P(Organs, ContinuousPaths,
                         testing::Values("phantom", "openhelp_liver_7k", "openhelp_kidney_left_22k",
                                         "sofamcp_prostate"),
                         [](const auto& info) { return std::string(info.param); });

// Counts what failed, and says the worst.
class Tally {
 public:
  void add(bool fails, double value, int path, const std::string& context = "") {
    ++tried_;
    failed_ += fails;
    if (value <= worst_) return;
    worst_ = value;
    where_ = "path " + std::to_string(path) + context;
  }
  int failed() const { return failed_; }
  std::string text(const std::string& unit) const {
    return std::to_string(failed_) + " of " + std::to_string(tried_) + " paths; worst " +
           std::to_string(worst_) + " " + unit + ": " + where_;
  }

 private:
  int tried_ = 0, failed_ = 0;
  double worst_ = 0;
  std::string where_;
};

TEST_P(ContinuousPaths, LeaveNoForceInTheAir) {
  Tally air, not_finite;
  for (int path = 1; path <= count(); ++path) {
    const Findings& found = go(path);
    air.add(found.air_force_n > 0, found.air_force_n, path, found.air);
    not_finite.add(!found.finite, !found.finite, path, found.not_finite);
  }
  EXPECT_EQ(air.failed(), 0) << air.text("N");
  EXPECT_EQ(not_finite.failed(), 0) << not_finite.text("not finite");
}

TEST_P(ContinuousPaths, LeaveNoForceInTheAirWhereTicksStall) {
  Tally air;
  for (int path = 1; path <= count(); ++path) {
    const Findings& found = go(path, Coupling::kBare, kStalls_s);
    air.add(found.air_force_n > 0, found.air_force_n, path, found.air);
  }
  EXPECT_EQ(air.failed(), 0) << air.text("N");
}

// The model alone: what both hands together may get.
TEST_P(ContinuousPaths, GiveTheHandsNoEnergy) {
  Tally all, in_contact;
  for (int path = 1; path <= count(); ++path) {
    const Findings& found = go(path);
    all.add(found.given_j > kGivenBound_j, found.given_j, path);
    in_contact.add(found.given_in_contact_j > kGivenBound_j, found.given_in_contact_j, path, found.energy);
  }
  EXPECT_EQ(all.failed(), 0) << all.text("J");
  EXPECT_EQ(in_contact.failed(), 0) << in_contact.text("J");
}

// What arrives at a hand behind safety and its device's hold.
TEST_P(ContinuousPaths, LeaveNothingToAHandBehindSafety) {
  Tally hand, air;
  for (int path = 1; path <= count(); ++path) {
    const Findings& found = go(path, Coupling::kSafe);
    hand.add(found.hand_given_j > kGivenBound_j, found.hand_given_j, path);
    air.add(found.air_force_n > 0, found.air_force_n, path, found.air);
  }
  EXPECT_EQ(air.failed(), 0) << air.text("N");
  EXPECT_EQ(hand.failed(), 0) << hand.text("J");
}

}  // namespace
}  // namespace omentum::haptic_test
