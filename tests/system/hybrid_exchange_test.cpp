// The hand's loop and the organ's with an organ half of which is precomputed: one body to the hand.
#include "organ/build_organ.h"
#include "organ/dynamic_spec.h"
#include "tests/system/exchange_session.h"

namespace omentum {
namespace {

using geometry::Vec3;
using test::Session;

// The block, which has masses in a quarter of it, above the side that holds it; beside its tensor-mass scene.
class HybridBlock {
 public:
  HybridBlock() {
    organ::Organ whole = test::block().organ();
    std::vector<std::uint8_t> dynamic =
        organ::parse_dynamic(std::vector<std::string>{"box:0.05,-1,0.034,1,1,1"}, whole.mesh);
    const organ::Organ hybrid = organ::make_organ("block", std::move(whole.mesh), whole.material, whole.fixed,
                                                  organ::Storage::kFloat, std::move(dynamic));
    organ::build_organ(hybrid, file(), {});
  }

  test::ExchangeScene scene(const std::string& model) const {
    std::string text = test::read_text(test::block().scene());
    const auto replace = [&](const std::string& what, const std::string& with) {
      text.replace(text.find(what), what.size(), with);
    };
    replace("young_pa", "model = \"" + model + "\"\nmass_damping_per_s = 5\nyoung_pa");
    if (model.starts_with("hybrid")) {
      replace("block.h5", file());
      replace("young_pa", "dynamic = \"box:0.05,-1,0.034,1,1,1\"\nyoung_pa");
    } else {
      replace("block.h5", test::block().file("block.h5"));
    }
    const std::filesystem::path written = folder_ / (model + ".toml");
    std::ofstream(written) << text;
    return {.file = written, .felt = scene::kOrganModels, .moved = deform::model_table()};
  }

 private:
  std::string file() const { return folder_ / "hybrid.h5"; }
  test::ScratchFolder folder_;
};

const HybridBlock& hybrid_block() {
  static const HybridBlock block;
  return block;
}

constexpr double kAbove_m = 0.103, kPressed_m = 0.094;

double press_at(Session& session, double x) {
  session.move_to({x, 0.053, kAbove_m}, 0.2);
  session.move_to({x, 0.053, kPressed_m}, 0.3);
  const double felt = session.move_to({x, 0.053, kPressed_m}, 0.6).norm();
  session.move_to({x, 0.053, kAbove_m}, 0.3);
  return felt;
}

TEST(HybridExchange, AHeldPressIsThatOfTheWholeOrganOnBothSidesAndOnTheBorder) {
  Session hybrid(1000, 100, hybrid_block().scene("hybrid"));
  Session anywhere(1000, 100, hybrid_block().scene("hybrid-cut"));
  Session whole(1000, 100, hybrid_block().scene("tensor-mass"));
  for (Session* session : {&hybrid, &anywhere, &whole}) session->begin();
  for (const double x : {0.025, 0.048, 0.08}) {
    const double expected = press_at(whole, x);
    EXPECT_GT(expected, 0.3);
    EXPECT_NEAR(press_at(hybrid, x), expected, 0.02 * expected) << x;
    EXPECT_NEAR(press_at(anywhere, x), expected, 0.02 * expected) << x << ", cut anywhere";
  }
  for (Session* session : {&hybrid, &anywhere}) EXPECT_EQ(session->hand_report()["faults"].size(), 0u);
}

TEST(HybridExchange, AToolThatSlidesAcrossTheBorderAndBackFeelsNoStep) {
  Session session(1000, 100, hybrid_block().scene("hybrid"));
  session.begin();
  session.move_to({0.03, 0.053, kAbove_m}, 0.5);
  session.move_to({0.03, 0.053, kPressed_m}, 0.5);
  const double held = session.move_to({0.03, 0.053, kPressed_m}, 1).norm();
  double last = held, largest_jump = 0;
  for (const double end : {0.07, 0.03}) {
    const double begin = 0.1 - end;
    for (int i = 1; i <= 2000; ++i) {
      const double force = session.step_to({begin + (end - begin) * i / 2000, 0.053, kPressed_m}).norm();
      largest_jump = std::max(largest_jump, std::abs(force - last));
      last = force;
    }
  }
  EXPECT_GT(held, 0.3);
  RecordProperty("jump", std::to_string(largest_jump / held));
  EXPECT_LT(largest_jump, 0.02 * held);
}

}  // namespace
}  // namespace omentum
