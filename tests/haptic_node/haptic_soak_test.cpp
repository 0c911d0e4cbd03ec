// The scene's simulated hands on soft and on stiff organs: masses on springs that yield to what they feel,
// coupled to the bare step. What tissue gives back is at most what it got. (What else stands between them:
// haptic_scene_test.cpp.)
#include "device_bridge/virtual_hand.h"
#include "haptic_node/haptic_step.h"
#include "scene/scene.h"
#include "tests/support/trial_organs.h"

#include <gtest/gtest.h>

#include <memory>

namespace omentum::haptic_test {
namespace {

using geometry::Vec3;

/// What a hand may gain in a round of its script, as a share of the most that it had put in (issue 6).
constexpr double kGain = 0.01;

struct Soak {
  const char* name;
  double young_pa;
  double rate_hz;
};
void PrintTo(const Soak& soak, std::ostream* out) {
  *out << soak.name;
}

// A simulated hand and the work of what it feels.
class SoakedHand {
 public:
  SoakedHand(const scene::HandSpec& hand, const scene::ToolSpec& tool, double rate_hz)
      : round_s_(device::script_period_s(hand)), hand_(hand, tool, rate_hz), info_(hand_.info()) {}
  haptic::ToolInput move(std::int64_t now_ns) {
    hand_.command(wrench_);
    const device::Measurement measured = hand_.measure(now_ns);
    way_ = moved_ ? Vec3(measured.position - tip_) : Vec3::Zero();
    given_j_ += wrench_.force.dot(way_);
    put_in_j_ = std::max(put_in_j_, -given_j_);
    tip_ = measured.position;
    moved_ = true;
    const haptic::ToolFrame frame{measured.position, measured.orientation};
    return {.engaged = true, .frame = frame, .max_stiffness_n_m = info_.max_stiffness_n_m};
  }
  void feel(const haptic::ToolOutput& output) {
    models_j_ += 0.5 * (model_force_ + output.force).dot(way_);
    model_force_ = output.force;
    wrench_ = {output.force, Vec3::Zero(), 0};  // it has no motors for torques
  }

  double round_s() const { return round_s_; }
  double given_j() const { return given_j_; }
  /// The same of the model's force without a hold: what is beyond it comes from sampling.
  double models_j() const { return models_j_; }
  double put_in_j() const { return put_in_j_; }
  double peak_force_n() const { return hand_.report()["peak_force_n"]; }

 private:
  double round_s_;
  device::VirtualHand hand_;
  msg::DeviceInfo info_;
  device::Wrench wrench_;
  Vec3 tip_ = Vec3::Zero(), way_ = Vec3::Zero(), model_force_ = Vec3::Zero();
  bool moved_ = false;
  double given_j_ = 0, models_j_ = 0, put_in_j_ = 0;
};

class EnergySoak : public testing::TestWithParam<Soak> {
 protected:
  void SetUp() override {
    test::OrganRecipe recipe = test::organ_recipe("phantom");
    recipe.young_pa = GetParam().young_pa;
    const auto organ = test::make_trial_organ(recipe);
    if (!organ) GTEST_SKIP() << "organ_phantom is absent";
    model_ = std::make_unique<haptic::HapticModel>(test::trial_model(*organ, test::scene_tools(true)));
  }

  // Every hand of the scene plays its script twice.
  std::vector<std::unique_ptr<SoakedHand>> soak() const {
    constexpr int kRounds = 2;
    const auto scene = scene::load_scene(OMENTUM_SOURCE_DIR "/scenes/liver.toml");
    const double rate_hz = GetParam().rate_hz;
    std::vector<std::unique_ptr<SoakedHand>> hands;
    for (const scene::HandSpec& hand : scene.hands)
      hands.push_back(std::make_unique<SoakedHand>(hand, scene.tools[hand.tool], rate_hz));
    double seconds = 0;
    for (const auto& hand : hands) seconds = std::max(seconds, kRounds * hand->round_s());
    haptic::HapticState state(*model_);
    haptic::HapticWorkspace work(*model_);
    std::vector<haptic::ToolInput> inputs(hands.size());
    std::vector<haptic::ToolOutput> outputs(hands.size());
    const int ticks = static_cast<int>(seconds * rate_hz);
    for (int i = 0; i < ticks; ++i) {
      const auto now_ns = static_cast<std::int64_t>(1e9 * (1 + i / rate_hz));
      for (std::size_t h = 0; h < hands.size(); ++h) inputs[h] = hands[h]->move(now_ns);
      haptic::haptic_step(*model_, inputs, state, work, outputs);
      for (std::size_t h = 0; h < hands.size(); ++h) hands[h]->feel(outputs[h]);
    }
    return hands;
  }

  std::unique_ptr<haptic::HapticModel> model_;
};

INSTANTIATE_TEST_SUITE_P(Liver, EnergySoak,
                         testing::Values(Soak{"soft_at_300_hz", 1e3, 300}, Soak{"soft_at_1000_hz", 1e3, 1000},
                                         Soak{"stiff_at_300_hz", 50e3, 300},
                                         Soak{"stiff_at_1000_hz", 50e3, 1000}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(EnergySoak, AHandGainsNothing) {
  double given_j = 0, put_in_j = 0;
  for (const auto& hand : soak()) {
    std::printf(
        "%-16s put in %.3f mJ, given in all %+.4f mJ (%+.2f %%, %+.2f %% by the model), peak %.2f N\n",
        GetParam().name, 1e3 * hand->put_in_j(), 1e3 * hand->given_j(),
        100 * hand->given_j() / hand->put_in_j(), 100 * hand->models_j() / hand->put_in_j(),
        hand->peak_force_n());
    EXPECT_GT(hand->put_in_j(), 1e-5) << "it was meant to press";
    // a bare force that is held from sample to sample gives energy of its own: the line's to mend
    given_j += hand->models_j();
    put_in_j += hand->put_in_j();
  }
  EXPECT_LE(given_j, kGain * put_in_j) << "the hands together: one may push the other through the tissue";
}

}  // namespace
}  // namespace omentum::haptic_test
