// Through the scene's liver and back by continuous motion: what was left behind in the air (issue 6, A1).
#include "device_bridge/hand_model.h"
#include "path_trial.h"
#include "scene/scene.h"
#include "tests/support/trial_organs.h"

#include <gtest/gtest.h>

#include <numbers>

namespace omentum::haptic_test {
namespace {

using geometry::Vec3;

constexpr double kAbove_m = 0.04, kDip_m = 0.03, kCircle_m = 0.02;

struct Passage {
  const char* name;
  int hand;           // of the scene: whose press point, and whose tool
  double deep_m;      // below the surface
  bool along_normal;  // else straight down
  double speed_m_s;
};
void PrintTo(const Passage& passage, std::ostream* out) {
  *out << passage.name;
}

// From above the press point into the organ and back; then in the air: a dip to 10 mm above the skin, and a
// circle.
class ThereAndBack {
 public:
  ThereAndBack(const scene::HandSpec& hand, const Passage& passage)
      : normal_(hand.press_normal.data()), speed_m_s_(passage.speed_m_s) {
    const Vec3 point(hand.press_point.data());
    out_ = passage.along_normal ? normal_ : Vec3::UnitZ();
    top_ = point + kAbove_m * out_;
    deep_m_ = kAbove_m + passage.deep_m;
  }
  double back_s() const { return 2 * deep_m_ / speed_m_s_; }
  double end_s() const { return back_s() + (2 * kDip_m + 2 * std::numbers::pi * kCircle_m) / speed_m_s_; }
  haptic::ToolFrame at(double t_s) const {
    double way_m = speed_m_s_ * t_s;
    Vec3 tip = top_;
    if (way_m < 2 * deep_m_) {
      tip -= out_ * (deep_m_ - std::abs(deep_m_ - way_m));
    } else if ((way_m -= 2 * deep_m_) < 2 * kDip_m) {
      tip -= out_ * (kDip_m - std::abs(kDip_m - way_m));
    } else {
      const double turn = (way_m - 2 * kDip_m) / kCircle_m;
      tip += kCircle_m * Vec3(1 - std::cos(turn), std::sin(turn), 0);
    }
    return {tip, device::shaft_orientation(normal_)};
  }

 private:
  Vec3 normal_, out_, top_;
  double deep_m_, speed_m_s_;
};

class Passages : public testing::TestWithParam<Passage> {
 protected:
  void SetUp() override {
    model_ = test::scene_model("phantom");
    if (!model_) GTEST_SKIP() << "organ_phantom is absent";
    const auto scene = scene::load_scene(OMENTUM_SOURCE_DIR "/scenes/liver.toml");
    hand_ = scene.hands[static_cast<std::size_t>(GetParam().hand)];
    way_ = std::make_unique<ThereAndBack>(hand_, GetParam());
  }
  /// The other tool waits far away.
  std::vector<Way> ways() const {
    std::vector<Way> ways(2, [](double) { return haptic::ToolFrame{Vec3(0, 0, 0.3), {}}; });
    ways[hand_.tool] = [this](double t) { return way_->at(t); };
    return ways;
  }
  /// Most that the hand got from when it was back in the air, J.
  double given_in_the_air_j(Coupling coupling) const {
    PathTrial trial(*model_, ways(), coupling);
    double before_j = 0, most_j = 0;
    trial.watch = [&](double t, std::span<const haptic::ToolOutput>, const haptic::HapticState&) {
      if (t < way_->back_s()) before_j = trial.given_j(hand_.tool);
      most_j = std::max(most_j, trial.given_j(hand_.tool) - before_j);
    };
    static_cast<void>(trial.run(way_->end_s()));
    return most_j;
  }

  const haptic::HapticModel* model_ = nullptr;
  scene::HandSpec hand_;
  std::unique_ptr<ThereAndBack> way_;
};

INSTANTIATE_TEST_SUITE_P(Liver, Passages,
                         testing::Values(Passage{"right_lobe_60_mm_slowly", 0, 0.06, true, 0.1},
                                         Passage{"right_lobe_60_mm_fast", 0, 0.06, true, 0.4},
                                         Passage{"straight_down_55_mm_slowly", 0, 0.055, false, 0.1},
                                         Passage{"straight_down_55_mm_fast", 0, 0.055, false, 0.4},
                                         Passage{"left_lobe_50_mm_slowly", 1, 0.05, true, 0.1},
                                         Passage{"left_lobe_50_mm_fast", 1, 0.05, true, 0.4}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(Passages, ATipThatCameBackFeelsNothing) {
  PathTrial trial(*model_, ways());
  double in_the_air_n = 0, in_the_organ_n = 0;
  trial.watch = [&](double t, std::span<const haptic::ToolOutput> outputs, const haptic::HapticState&) {
    double& force_n = t < way_->back_s() ? in_the_organ_n : in_the_air_n;
    force_n = std::max(force_n, outputs[hand_.tool].force.norm());
  };
  const Findings& found = trial.run(way_->end_s());
  EXPECT_GT(in_the_organ_n, 1) << "it was meant to press";
  EXPECT_EQ(in_the_air_n, 0) << "back above the press point";
  EXPECT_EQ(found.dragged_n, 0) << found.dragged;
}

TEST_P(Passages, ATipThatCameBackIsGivenNothing) {
  EXPECT_LE(given_in_the_air_j(Coupling::kBare), kGivenBound_j);
  EXPECT_LE(given_in_the_air_j(Coupling::kSafe), kGivenBound_j);
}

}  // namespace
}  // namespace omentum::haptic_test
