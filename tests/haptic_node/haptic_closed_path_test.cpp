// A frictionless contact is conservative: along a closed path tissue gives back what it got, wherever the
// tool slid (issue 6, A3). benchmarks/contact_energy_bench prints the figures.
#include "tests/support/closed_path.h"
#include "tests/support/trial_organs.h"

#include <gtest/gtest.h>

#include <memory>

namespace omentum::haptic_test {
namespace {

/// Net energy of a closed path, as a share of the most that was put in (issue 6).
constexpr double kNetShare = 0.01;
/// A step of the tip, and the largest change of the force in it, on a liver of 50 kPa (issue 6).
constexpr double kStep_m = 20e-6, kForceStep_n = 0.02;
constexpr double kSlide_m = 0.02;

class ClosedPaths : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const test::OrganRecipe& recipe = test::organ_recipe(GetParam());
    const auto organ = test::make_trial_organ(recipe);
    if (!organ) GTEST_SKIP() << GetParam() << ": ../shared/data or organ_phantom is absent";
    model_ =
        std::make_unique<haptic::HapticModel>(test::trial_model(*organ, {test::scene_tools(false).front()}));
    const auto place = test::find_press_place(model_->organs.front(), recipe.up, kSlide_m);
    ASSERT_TRUE(place);
    place_ = *place;
  }
  template <class Check>
  void for_all_paths(Check&& check) const {
    for (const double depth_m : {0.001, 0.004, 0.008}) {
      for (int degrees = 0; degrees < 360; degrees += 45) {
        SCOPED_TRACE(std::to_string(1e3 * depth_m) + " mm, " + std::to_string(degrees) + " degrees");
        check(test::walk(*model_, {place_, depth_m, static_cast<double>(degrees)}, kStep_m));
      }
    }
  }

  std::unique_ptr<haptic::HapticModel> model_;
  test::PressPlace place_;
};

INSTANTIATE_TEST_SUITE_P(Organs, ClosedPaths,
                         testing::Values("phantom", "openhelp_liver_7k", "openhelp_kidney_left_22k",
                                         "sofamcp_prostate", "openhelp_stomach_15k"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(ClosedPaths, GiveBackWhatTheyGot) {
  for_all_paths([](const test::ClosedPathFigures& found) {
    EXPECT_GT(found.most_put_in_j, 0) << "it was meant to press";
    EXPECT_LE(std::abs(found.net_share()), kNetShare);
  });
}

class StiffLiver : public ClosedPaths {};
INSTANTIATE_TEST_SUITE_P(At50kPa, StiffLiver, testing::Values("openhelp_liver_7k"),
                         [](const auto& info) { return std::string(info.param); });

TEST_P(StiffLiver, IsFeltWithoutSteps) {
  for_all_paths([](const test::ClosedPathFigures& found) {
    EXPECT_LE(found.largest_step_n, kForceStep_n)
        << test::ClosedPath::kLegs[found.leg] << " at " << 1e3 * found.along_m << " mm";
  });
}

}  // namespace
}  // namespace omentum::haptic_test
