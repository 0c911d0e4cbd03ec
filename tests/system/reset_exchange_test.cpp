// A reset while an instrument stands where the organ was cut: the tissue comes back around it.
#include "tests/system/exchange_session.h"

namespace omentum {
namespace {

using geometry::Vec3;
using test::kAbove;
using test::Session;

constexpr const char* kTearing =
    "mass_damping_per_s = 5\ncut_delay_s = 0\ncut_rate_per_s = 1e6\ngravity_m_s2 = [0, 0, 0]\n"
    "tear_edge_elongation = 0.5";
const Vec3 kInTheGroove(0.048, 0.053, 0.088);

/// A hand that has cut a groove right across the block with its hook, and stands in there.
class HookInAGroove : public Session {
 public:
  explicit HookInAGroove(const std::string& model)
      : Session(1000, 100,
                {.file = test::block().scene_with("young_pa",
                                                  "model = \"" + model + "\"\n" + kTearing + "\nyoung_pa"),
                 .felt = scene::kOrganModels,
                 .moved = deform::model_table()}) {
    begin();
    const double depth_m = 0.085;
    move_to(Vec3(-0.02, 0.053, 0.103), 0.1);
    move_to(Vec3(-0.02, 0.053, depth_m), 0.1);
    move_to(Vec3(0.12, 0.053, depth_m), 0.6, true);
    move_to(kInTheGroove + Vec3(0, 0, 0.03), 0.1);
    move_to(kInTheGroove, 0.2);
    at_ = kInTheGroove;
  }
  void reset() {
    bus().post(msg::SessionCommand{.order = 1, .sender = 1, .command = msg::COMMAND_RESET, .argument = {}});
  }
  /// The hardest that the hand feels on its way, N.
  double hardest_to(const Vec3& tip, double seconds) {
    double hardest_n = 0;
    const Vec3 from = at_;
    const int ticks = static_cast<int>(std::lround(1000 * seconds));
    for (int i = 1; i <= ticks; ++i)
      hardest_n = std::max(hardest_n, step_to(from + (tip - from) * i / ticks).norm());
    at_ = tip;
    return hardest_n;
  }
  bool whole() {
    const auto topology = bus().newest<msg::Topology>();
    return std::ranges::all_of(topology->removed_bits, [](std::uint8_t byte) { return byte == 0; });
  }

 private:
  Vec3 at_ = kAbove;
};

class ResetExchange : public testing::TestWithParam<const char*> {};

// Within the next ticks an organ may answer as it was: less than a hand notices, N.
constexpr double kUnnoticed_n = 0.05;

TEST_P(ResetExchange, AHandThatPressesInACutIsNeitherKickedNorTearsAnything) {
  HookInAGroove hook(GetParam());
  ASSERT_FALSE(hook.whole());
  const Vec3 pressed(0.048, 0.043, kInTheGroove.z());
  ASSERT_GT(hook.hardest_to(pressed, 0.2), 0.1) << "the groove's side";
  hook.reset();
  EXPECT_LT(hook.hardest_to(pressed, 0.3), kUnnoticed_n) << "it stays where it is";
  EXPECT_EQ(hook.hardest_to(pressed + Vec3(0.02, -0.02, 0), 0.2), 0) << "through the tissue";
  EXPECT_EQ(hook.hardest_to(kAbove, 0.2), 0) << "and out";
  EXPECT_GT(hook.hardest_to(test::kPressed, 0.3), 0.3) << "outside it is an instrument again";
  EXPECT_TRUE(hook.whole());
  EXPECT_EQ(hook.hand_report()["faults"].size(), 0u);
  EXPECT_EQ(hook.organ_report()["faults"].size(), 0u);
}

// No skin is near then, and nothing new is told of it.
TEST_P(ResetExchange, AHandDeepInACutLetsGoAtOnce) {
  HookInAGroove hook(GetParam());
  const Vec3 deep(0.048, 0.053, 0.07);
  ASSERT_GT(hook.hardest_to(deep, 0.2), 0.5) << "the groove's bottom";
  hook.reset();
  EXPECT_LT(hook.hardest_to(deep, 0.3), kUnnoticed_n);
  EXPECT_EQ(hook.hardest_to(deep + Vec3(0.02, 0.01, 0.02), 0.2), 0);
  EXPECT_EQ(hook.hardest_to(kAbove, 0.1), 0);
  EXPECT_TRUE(hook.whole());
  EXPECT_EQ(hook.organ_report()["faults"].size(), 0u) << hook.organ_report()["faults"];
}

INSTANTIATE_TEST_SUITE_P(Models, ResetExchange, testing::Values("tensor-mass", "corotational"));

}  // namespace
}  // namespace omentum
