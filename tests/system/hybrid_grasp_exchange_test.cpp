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
constexpr double kSteepest_n = (1 + 1e-9) * 2000 / 1000, kStrongest_n = (1 + 1e-9) * 10;
// Of the block's parts: beyond it in x, above it in z tissue has masses.
constexpr double kBorderX_m = 0.045, kBorderZ_m = 0.03;
const Vec3 kOnDynamic(0.085, 0.05, kHybridTop_m), kOnBorder(0.05, 0.05, kHybridTop_m);

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
    replace("young_pa", "model = \"hybrid\"\nlaw = \"corotational\"\ndynamic = \"" + part +
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
  /// The forceps go there, evenly; the force on their hand at the end.
  Vec3 go(const Vec3& to, double seconds) {
    const Vec3 from = tip_;
    const int ticks = static_cast<int>(std::lround(1000 * seconds));
    for (int i = 1; i <= ticks; ++i) {
      tip_ = from + (to - from) * i / ticks;
      const Vec3 force = session_.move_to(tip_, 1e-3);
      // what a hand must not be given falls at once, beyond any slew
      if (force.norm() > force_.norm()) steepest_n_ = std::max(steepest_n_, (force - force_).norm());
      strongest_n_ = std::max(strongest_n_, force.norm());
      force_ = force;
      put_in_j_ = std::max(put_in_j_, -session_.given_j());
    }
    return force_;
  }
  void grasp(const Vec3& top) {
    session_.open_jaws(kWide_rad);
    go(top + Vec3(0, 0, 0.01), test::kListens_s + 0.5);
    go(top - Vec3(0, 0, 0.003), 0.3);
    turn_jaws(kWide_rad, 0, 0.3);
  }
  void turn_jaws(double from_rad, double to_rad, double seconds) {
    const int ticks = static_cast<int>(std::lround(1000 * seconds));
    for (int i = 1; i <= ticks; ++i) {
      session_.open_jaws(from_rad + (to_rad - from_rad) * i / ticks);
      go(tip_, 1e-3);
    }
  }
  /// The wire, along y, goes to one place in x and z, and cuts from there to another; the forceps stay.
  void cut(const Vec3& from, const Vec3& to, double seconds) {
    move_wire(from, 0.3, false);
    move_wire(to, seconds, true);
  }
  void move_wire(const Vec3& to, double seconds, bool cuts) {
    const Vec3 from = wire_;
    const int ticks = static_cast<int>(std::lround(1000 * seconds));
    for (int i = 1; i <= ticks; ++i) {
      wire_ = from + (to - from) * i / ticks;
      session_.place_other(1, wire_ + Vec3(0, -0.03, 0), cuts);
      go(tip_, 1e-3);
    }
  }
  /// Takes both reports: nothing may follow.
  void expect_no_harm() {
    EXPECT_LE(steepest_n_, kSteepest_n);
    EXPECT_LE(strongest_n_, kStrongest_n);
    EXPECT_LT(session_.given_j(), 0.02 * put_in_j_) << "of " << put_in_j_ << " J";
    hand_ = session_.hand_report(), organ_ = session_.organ_report();
    EXPECT_EQ(hand_["faults"].size(), 0u) << hand_["faults"];
    EXPECT_EQ(organ_["faults"].size(), 0u) << organ_["faults"];
  }

  Session session_;
  Vec3 tip_ = test::kAbove, wire_ = Vec3(0.2, 0, 0.05), force_ = Vec3::Zero();
  double steepest_n_ = 0, strongest_n_ = 0, put_in_j_ = 0;
  nlohmann::json hand_, organ_;
};

TEST_F(HybridGraspExchange, APieceThatIsCutOffUnderTensionIsLiftedAway) {
  const Vec3 pulled = kOnDynamic + Vec3(0, 0, 0.012);
  grasp(kOnDynamic);
  go(pulled, 0.5);
  const double whole_n = go(pulled, 0.3).norm();
  EXPECT_GT(whole_n, 0.4);
  cut({0.13, 0, 0.065}, {0.055, 0, 0.065}, 1);
  EXPECT_GT(go(pulled, 0.3).norm(), 0.1 * whole_n) << "a bridge is left";
  cut({0.055, 0, 0.065}, {0.055, 0, 0.12}, 1);
  EXPECT_LT(go(pulled, 0.5).norm(), 0.05 * whole_n) << "the last bridge went";
  const Vec3 away = pulled + Vec3(0.02, 0, 0.06);
  go(away, 2);
  go(away, 0.5);
  const auto state = session_.bus().newest<msg::OrganState>();
  float highest_m = 0;
  for (std::size_t i = 2; state && i < state->values.size(); i += 3)
    highest_m = std::max(highest_m, state->values[i]);
  EXPECT_GT(highest_m, 0.06F);
  expect_no_harm();
  EXPECT_GT(organ_["removed_tetrahedra"], 30);
  EXPECT_EQ(hand_["hands"][0]["grasps"]["lost"], 0);
}

class HybridYankExchange : public HybridGraspExchange, public testing::WithParamInterface<double> {};
TEST_P(HybridYankExchange, ForcepsThatTearAtTheTissueLoseIt) {
  grasp(kOnDynamic);
  const Vec3 away = kOnDynamic + Vec3(0.05, 0, 0.19);
  go(away, 0.2 / GetParam());
  go(away, 0.5);
  expect_no_harm();
  EXPECT_EQ(hand_["hands"][0]["grasps"]["torn"], 1);
}
INSTANTIATE_TEST_SUITE_P(Speeds, HybridYankExchange, testing::Values(0.2, 0.5));

TEST_F(HybridGraspExchange, JawsThatOpenInTheMiddleOfTheCutLetGo) {
  const Vec3 pulled = kOnDynamic + Vec3(0, 0, 0.012);
  grasp(kOnDynamic);
  go(pulled, 0.5);
  cut({0.13, 0, 0.065}, {0.08, 0, 0.065}, 0.6);
  turn_jaws(0, kWide_rad, 0.05);
  cut({0.08, 0, 0.065}, {0.055, 0, 0.065}, 0.4);
  EXPECT_LT(go(pulled, 0.2).norm(), 0.02);
  // and take it again
  grasp(kOnDynamic);
  go(pulled, 0.5);
  expect_no_harm();
  EXPECT_EQ(hand_["hands"][0]["grasps"]["begun"], 2);
}

TEST_F(HybridGraspExchange, JawsThatCloseOnTheBorderHoldBothParts) {
  const Vec3 pulled = kOnBorder + Vec3(0, 0, 0.01);
  grasp(kOnBorder);
  go(pulled, 0.5);
  const double whole_n = go(pulled, 0.3).norm();
  EXPECT_GT(whole_n, 0.4);
  cut({0.13, 0, 0.065}, {0.055, 0, 0.065}, 1);
  cut({0.055, 0, 0.065}, {0.055, 0, 0.12}, 1);
  EXPECT_GT(go(pulled, 0.3).norm(), 0.1 * whole_n) << "the precomputed part still is held";
  go(kOnBorder + Vec3(0, 0, 0.15), 0.3);
  expect_no_harm();
}

TEST_F(HybridGraspExchange, AHookInTheWrongPlaceTakesNothingThatIsPrecomputed) {
  const Vec3 pulled = kOnDynamic + Vec3(0, 0, 0.01);
  grasp(kOnDynamic);
  go(pulled, 0.5);
  cut({-0.03, 0, 0.015}, {0.13, 0, 0.015}, 1);
  cut({0.02, 0, -0.02}, {0.02, 0, 0.13}, 1);
  const double whole_n = go(pulled, 0.3).norm();
  EXPECT_GT(whole_n, 0.3);
  // through the border, and through what is held
  cut({kBorderX_m, 0, 0.12}, {kBorderX_m, 0, kBorderZ_m}, 1);
  cut({0.13, 0, 0.095}, {0.03, 0, 0.095}, 1);
  EXPECT_LT(go(pulled, 0.3).norm(), 0.2 * whole_n);
  expect_no_harm();
  EXPECT_GT(organ_["removed_tetrahedra"], 30);
}

}  // namespace
}  // namespace omentum
