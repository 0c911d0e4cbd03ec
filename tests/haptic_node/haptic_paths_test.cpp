// Forces that should not be there: hands that go through, around and along organs by continuous motion. The
// suite tries a few random paths an organ; OMENTUM_PATHS=1000 tries so many in all.
#include "hand_paths.h"
#include "path_trial.h"
#include "tests/support/trial_organs.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <numeric>
#include <string_view>
#include <tuple>

namespace omentum::haptic_test {
namespace {

using geometry::Vec3;

constexpr double kPath_s = 4;
constexpr std::array<double, 4> kStalls_s = {0.005, 0.015, 0.025, 0.04};

// Paths that once were wrong. Those that hook a thin border from inside carry it along for a while: the
// deformed surface is where the tool is, though the way back would be free.
struct KnownPath {
  std::string_view organ;
  int path;
  bool hooks;
};
constexpr KnownPath kKnown[] = {{"phantom", 82, true},
                                {"phantom", 187, true},
                                {"openhelp_liver_7k", 29, false},
                                {"openhelp_liver_7k", 52, false},
                                {"openhelp_liver_7k", 59, false},
                                {"openhelp_liver_7k", 101, false},
                                {"openhelp_liver_7k", 111, false},
                                {"openhelp_liver_7k", 128, false},
                                {"openhelp_liver_7k", 165, true},
                                {"openhelp_liver_7k", 172, true},
                                {"openhelp_liver_7k", 174, false},
                                {"openhelp_liver_7k", 184, true},
                                {"openhelp_kidney_left_22k", 98, false},
                                {"sofamcp_prostate", 77, true},
                                {"sofamcp_prostate", 128, false},
                                {"sofamcp_prostate", 156, false},
                                {"sofamcp_prostate", 203, false}};

class ContinuousPaths : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    model_ = test::scene_model(GetParam());
    if (!model_) GTEST_SKIP() << GetParam() << ": ../shared/data or organ_phantom is absent";
  }
  /// The first paths of this organ, and those that once were wrong.
  static std::vector<int> paths() {
    const char* all = std::getenv("OMENTUM_PATHS");
    constexpr int kOrgans = 4;
    std::vector<int> paths(all ? static_cast<std::size_t>(std::atoi(all) + kOrgans - 1) / kOrgans : 3);
    std::iota(paths.begin(), paths.end(), 1);
    for (const KnownPath& known : kKnown) {
      if (GetParam() == known.organ && known.path > paths.back()) paths.push_back(known.path);
    }
    return paths;
  }
  /// Paths that may hook a border, of all: the known ones, and one in fifty.
  static std::size_t most_hooks() {
    const auto hooks = [](const KnownPath& known) { return known.hooks && GetParam() == known.organ; };
    return paths().size() / 50 + static_cast<std::size_t>(std::ranges::count_if(kKnown, hooks));
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
        const auto hand = std::make_shared<HandPath>(model_->organs.front(), seed, kPath_s, path % 2 == 0);
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
    if (fails) which_ += " " + std::to_string(path);
    if (value <= worst_) return;
    worst_ = value;
    where_ = "path " + std::to_string(path) + context;
  }
  std::size_t failed() const { return failed_; }
  std::string text(const std::string& unit) const {
    return std::to_string(failed_) + " of " + std::to_string(tried_) + " paths (" + which_ + " ); worst " +
           std::to_string(worst_) + " " + unit + ": " + where_;
  }

 private:
  std::size_t tried_ = 0, failed_ = 0;
  double worst_ = 0;
  std::string which_, where_;
};

TEST_P(ContinuousPaths, LeaveNoForceInTheAir) {
  Tally air, dragged, not_finite;
  for (const int path : paths()) {
    const Findings& found = go(path);
    air.add(found.air_force_n > 0, found.air_force_n, path, found.air);
    dragged.add(found.dragged_n > 0, found.dragged_n, path, found.dragged);
    not_finite.add(!found.finite, !found.finite, path, found.not_finite);
  }
  EXPECT_EQ(air.failed(), 0U) << air.text("N");
  EXPECT_LE(dragged.failed(), most_hooks()) << dragged.text("N");
  EXPECT_EQ(not_finite.failed(), 0U) << not_finite.text("not finite");
}

TEST_P(ContinuousPaths, LeaveNoForceInTheAirWhereTicksStall) {
  Tally air;
  for (const int path : paths()) {
    const Findings& found = go(path, Coupling::kBare, kStalls_s);
    air.add(found.air_force_n > 0, found.air_force_n, path, found.air);
  }
  EXPECT_EQ(air.failed(), 0U) << air.text("N");
}

// The model alone: what both hands together may get.
TEST_P(ContinuousPaths, GiveTheHandsNoEnergy) {
  Tally all, in_contact;
  for (const int path : paths()) {
    const Findings& found = go(path);
    all.add(found.given_j > kGivenBound_j, found.given_j, path);
    in_contact.add(found.given_in_contact_j > kGivenBound_j, found.given_in_contact_j, path, found.energy);
  }
  EXPECT_EQ(all.failed(), 0U) << all.text("J");
  EXPECT_EQ(in_contact.failed(), 0U) << in_contact.text("J");
}

// What arrives at a hand behind safety and its device's hold.
TEST_P(ContinuousPaths, LeaveNothingToAHandBehindSafety) {
  Tally hand, air;
  for (const int path : paths()) {
    const Findings& found = go(path, Coupling::kSafe);
    hand.add(found.hand_given_j > kGivenBound_j, found.hand_given_j, path);
    air.add(found.air_force_n > 0, found.air_force_n, path, found.air);
  }
  EXPECT_EQ(air.failed(), 0U) << air.text("N");
  EXPECT_EQ(hand.failed(), 0U) << hand.text("J");
}

}  // namespace
}  // namespace omentum::haptic_test
