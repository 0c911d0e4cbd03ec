// Forceps and a hook at an organ half of which is precomputed, and what two clumsy hands do to it: haptic
// step and organ together.
#include "organ/build_organ.h"
#include "organ/dynamic_spec.h"
#include "tests/system/exchange_session.h"

namespace omentum {
namespace {

using geometry::Vec3;
using test::Session;

constexpr double kWide_rad = 0.5, kHybridTop_m = test::BlockScene::kSide;
// A tick of the scene's slew limit, and its largest force, N.
constexpr double kSteepest_n = 2000.0 / 1000, kStrongest_n = 10;
// Of the block's parts: beyond it in x, above it in z tissue has masses.
constexpr double kBorderX_m = 0.045, kBorderZ_m = 0.03;
const Vec3 kOnDynamic(0.075, 0.05, kHybridTop_m), kOnBorder(0.05, 0.05, kHybridTop_m);

/// A block of which the upper part at one side moves, forceps, and a wire as long as the block is wide.
class CutBlock {
 public:
  CutBlock() {
    const std::string part = "box:0.045,-1,0.03,1,1,1";
    organ::Organ whole = block_.organ();
    std::vector<std::uint8_t> dynamic = organ::parse_dynamic(std::vector<std::string>{part}, whole.mesh);
    const std::string file = folder_ / "cut.h5";
    organ::build_organ(organ::make_organ("block", std::move(whole.mesh), whole.material, whole.fixed,
                                         organ::Storage::kFloat, std::move(dynamic)),
                       file, {});
    std::string text = test::read_text(block_.scene());
    const auto replace = [&](const std::string& what, const std::string& with) {
      text.replace(text.find(what), what.size(), with);
    };
    replace("block.h5", file);
    replace("young_pa", "model = \"hybrid\"\ndynamic = \"" + part +
                            "\"\nmass_damping_per_s = 5\ncut_delay_s = 0.02\nyoung_pa");
    std::ofstream(folder_ / "cut.toml") << text;
  }
  test::ExchangeScene scene() const {
    return {.file = folder_ / "cut.toml", .felt = scene::kOrganModels, .moved = deform::model_table()};
  }

 private:
  test::BlockScene block_{
      6,
      "[[tools]]\nid = 0\nname = \"forceps\"\nshape = \"grasper\"\n"
      "points = [[0.003,0.002,0], [0.003,-0.002,0], [-0.003,0.002,0], [-0.003,-0.002,0]]\n"
      "[[tools]]\nid = 1\nname = \"wire\"\nshape = \"probe\"\npoints = [[0,0,0]]\n"
      "cuts = true\nedge = [[0,0.01,0], [0,0.15,0]]\n"};
  test::ScratchFolder folder_;
};

class HybridGraspExchange : public testing::Test {
 protected:
  HybridGraspExchange() : session_(1000, 100, scene()) {}

  static test::ExchangeScene scene() {
    static const CutBlock block;
    return block.scene();
  }
  void grasp(const Vec3& top) {
    session_.open_jaws(kWide_rad);
    session_.move_to(top + Vec3(0, 0, 0.01), test::kListens_s + 0.5);
    session_.move_to(top - Vec3(0, 0, 0.003), 0.3);
    for (int i = 0; i <= 300; ++i) {
      session_.open_jaws(kWide_rad * (1 - i / 300.0));
      session_.move_to(top - Vec3(0, 0, 0.003), 1e-3);
    }
  }
  /// The wire, along y, goes from one place in x and z to another.
  void cut(const Vec3& from, const Vec3& to, double seconds, const Vec3& held) {
    const int ticks = static_cast<int>(std::lround(1000 * seconds));
    for (int i = 0; i <= ticks; ++i) {
      const Vec3 at = from + (to - from) * i / ticks;
      session_.place_other(1, Vec3(at.x(), -0.03, at.z()), true);
      strongest_n_ = std::max(strongest_n_, session_.move_to(held, 1e-3).norm());
    }
  }
  /// Takes both reports: nothing may follow.
  void expect_no_harm() {
    EXPECT_LE(session_.largest_step_n(), kSteepest_n);
    EXPECT_LE(strongest_n_, kStrongest_n);
    const double put_in_j = -lowest_given_j_;
    EXPECT_LT(session_.given_j(), 0.02 * put_in_j) << "of " << put_in_j << " J";
    hand_ = session_.hand_report(), organ_ = session_.organ_report();
    EXPECT_EQ(hand_["faults"].size(), 0u) << hand_["faults"];
    EXPECT_EQ(organ_["faults"].size(), 0u) << organ_["faults"];
    EXPECT_LE(hand_["hands"][0]["force_max_n"], kStrongest_n);
  }
  void note_work() { lowest_given_j_ = std::min(lowest_given_j_, session_.given_j()); }

  Session session_;
  double strongest_n_ = 0, lowest_given_j_ = 0;
  nlohmann::json hand_, organ_;
};

TEST_F(HybridGraspExchange, APieceThatIsCutOffUnderTensionIsLiftedAway) {
  const Vec3 pulled = kOnDynamic + Vec3(0, 0, 0.012);
  grasp(kOnDynamic);
  session_.move_to(pulled, 0.5);
  const double whole_n = session_.move_to(pulled, 0.3).norm();
  EXPECT_GT(whole_n, 0.4);
  note_work();
  cut({0.13, 0, 0.065}, {0.055, 0, 0.065}, 1, pulled);
  EXPECT_GT(session_.move_to(pulled, 0.3).norm(), 0.1 * whole_n) << "a bridge is left";
  cut({0.055, 0, 0.065}, {0.055, 0, 0.12}, 1, pulled);
  EXPECT_LT(session_.move_to(pulled, 0.5).norm(), 0.05 * whole_n) << "the last bridge went";
  const Vec3 away = pulled + Vec3(0.02, 0, 0.06);
  session_.move_to(away, 0.8);
  session_.move_to(away, 0.5);
  const auto state = session_.bus().newest<msg::OrganState>();
  float highest_m = 0;
  for (std::size_t i = 2; state && i < state->values.size(); i += 3)
    highest_m = std::max(highest_m, state->values[i]);
  EXPECT_GT(highest_m, 0.06F);
  expect_no_harm();
  EXPECT_GT(organ_["removed_tetrahedra"], 30);
  EXPECT_EQ(hand_["hands"][0]["grasps"]["lost"], 0);
}

TEST_F(HybridGraspExchange, ForcepsThatTearAtTheTissueLoseIt) {
  grasp(kOnDynamic);
  note_work();
  // 20 cm in 0.1 s: twenty times as fast as a surgeon
  session_.move_to(kOnDynamic + Vec3(0.05, 0, 0.19), 0.1);
  note_work();
  session_.move_to(kOnDynamic + Vec3(0.05, 0, 0.19), 0.5);
  expect_no_harm();
  EXPECT_EQ(hand_["hands"][0]["grasps"]["torn"], 1);
}

TEST_F(HybridGraspExchange, JawsThatOpenInTheMiddleOfTheCutLetGo) {
  const Vec3 pulled = kOnDynamic + Vec3(0, 0, 0.012);
  grasp(kOnDynamic);
  session_.move_to(pulled, 0.5);
  note_work();
  cut({0.13, 0, 0.065}, {0.08, 0, 0.065}, 0.6, pulled);
  session_.open_jaws(kWide_rad);
  cut({0.08, 0, 0.065}, {0.055, 0, 0.065}, 0.4, pulled);
  EXPECT_LT(session_.move_to(pulled, 0.2).norm(), 0.02);
  // and take it again
  grasp(kOnDynamic);
  session_.move_to(pulled, 0.5);
  note_work();
  expect_no_harm();
  EXPECT_EQ(hand_["hands"][0]["grasps"]["begun"], 2);
}

TEST_F(HybridGraspExchange, JawsThatCloseOnTheBorderHoldBothParts) {
  const Vec3 pulled = kOnBorder + Vec3(0, 0, 0.01);
  grasp(kOnBorder);
  session_.move_to(pulled, 0.5);
  const double whole_n = session_.move_to(pulled, 0.3).norm();
  EXPECT_GT(whole_n, 0.4);
  note_work();
  cut({0.13, 0, 0.065}, {0.055, 0, 0.065}, 1, pulled);
  cut({0.055, 0, 0.065}, {0.055, 0, 0.12}, 1, pulled);
  EXPECT_GT(session_.move_to(pulled, 0.3).norm(), 0.1 * whole_n) << "the precomputed part still is held";
  session_.move_to(kOnBorder + Vec3(0, 0, 0.15), 0.3);
  note_work();
  expect_no_harm();
}

TEST_F(HybridGraspExchange, AHookInTheWrongPlaceTakesNothingThatIsPrecomputed) {
  const Vec3 pulled = kOnDynamic + Vec3(0, 0, 0.01);
  grasp(kOnDynamic);
  session_.move_to(pulled, 0.5);
  note_work();
  cut({-0.03, 0, 0.015}, {0.13, 0, 0.015}, 1, pulled);
  cut({0.02, 0, -0.02}, {0.02, 0, 0.13}, 1, pulled);
  const double whole_n = session_.move_to(pulled, 0.3).norm();
  EXPECT_GT(whole_n, 0.3);
  // through the border, and through what is held
  cut({kBorderX_m, 0, 0.12}, {kBorderX_m, 0, kBorderZ_m}, 1, pulled);
  cut({0.13, 0, 0.095}, {0.03, 0, 0.095}, 1, pulled);
  EXPECT_LT(session_.move_to(pulled, 0.3).norm(), 0.2 * whole_n);
  expect_no_harm();
  EXPECT_GT(organ_["removed_tetrahedra"], 30);
}

}  // namespace
}  // namespace omentum
