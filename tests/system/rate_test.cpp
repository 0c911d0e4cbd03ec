// Force is in newtons, not in impulses: it does not depend on how often it is computed.
#include "tests/system/session_on_trial.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace omentum::test {
namespace {

constexpr double kWithin = 0.02;  // the issue's
constexpr double kFeltN = 0.1;
constexpr std::size_t kSettled = 500;  // samples that agree with each other: the hand has come to rest
const std::string kScript_s = "15";
constexpr double kSettledSpread = 0.005;  // ... within this

/// Mean force of the held hand, N, once it has come to rest; 0 when it never does.
double held_force(const std::string& rate_hz) {
  SessionOnTrial session(held_scene(), all_on("cyclone"));
  Observer observer(session.domain(), transport::Vendor::kCyclone);
  session.start("haptic_node", {"--rate-hz", rate_hz});
  session.start("virtual_device", {"--rate-hz", rate_hz});
  double mean = 0;
  const bool settled = comes_true([&] {
    double sum = 0, least = 1e9, most = 0;
    std::size_t count = 0;
    for (const msg::ToolForce& sample : observer.forces()) {
      if (sample.tool != 0) continue;
      const double force = Eigen::Vector3d(sample.force.x, sample.force.y, sample.force.z).norm();
      sum += force, ++count;
      least = std::min(least, force), most = std::max(most, force);
    }
    mean = count > 0 ? sum / static_cast<double>(count) : 0;
    if (count >= kSettled && mean > kFeltN && most - least < kSettledSpread * mean) return true;
    if (count >= kSettled) observer.forget();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return false;
  });
  EXPECT_TRUE(settled) << "at " << rate_hz << " Hz: " << session["haptic_node"].messages();
  return settled ? mean : 0;
}

TEST(RateTest, TheSameHandFeelsTheSameForceAt300HzAndAt1000Hz) {
  const double slow = held_force("300");
  const double fast = held_force("1000");
  EXPECT_NEAR(slow, fast, kWithin * fast);
}

/// What the right hand says of one whole script: wait, approach, press, hold, slide, release.
nlohmann::json hand_after_script(const std::string& scene, const std::string& rate_hz) {
  SessionOnTrial session(scene, all_on("cyclone"));
  session.start("haptic_node", {"--rate-hz", rate_hz});
  Process& device = session.start("virtual_device", {"--rate-hz", rate_hz, "--seconds", kScript_s});
  EXPECT_EQ(device.wait(), 0) << device.messages();
  return nlohmann::json::parse(read_text(session.report_of("virtual_device")))["hands"][0];
}

// The default script waits a second only; here it must outlast the discovery of the node.
std::string late_liver(const std::filesystem::path& folder) {
  std::string text = read_text(OMENTUM_SOURCE_DIR "/scenes/liver.toml");
  for (std::size_t at = 0; (at = text.find("\nstart_s = ", at)) != std::string::npos;)
    text.replace(at, text.find('.', at) - at, "\nstart_s = 4"), ++at;
  std::ofstream(folder / "late.toml") << text;
  return folder / "late.toml";
}

TEST(RateTest, PressingAndSlidingFeelTheSameAtBothRates) {
  const ScratchFolder folder;
  const std::string scene = prepare_scene(late_liver(folder.path()), {}, folder.path());
  ASSERT_FALSE(scene.empty());
  const nlohmann::json slow = hand_after_script(scene, "300"), fast = hand_after_script(scene, "1000");
  ASSERT_GT(fast["mean_force_n"].get<double>(), kFeltN);
  for (const char* field : {"mean_force_n", "hold_force_n", "peak_force_n"}) {
    const double expected = fast[field].get<double>();
    EXPECT_NEAR(slow[field].get<double>(), expected, kWithin * expected) << field;
  }
}

}  // namespace
}  // namespace omentum::test
