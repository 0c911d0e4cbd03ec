// Force is in newtons, not in impulses: it does not depend on how often it is computed.
#include "tests/system/session_on_trial.h"

#include <gtest/gtest.h>

#include <cmath>

namespace omentum::test {
namespace {

const std::string kScene = OMENTUM_HELD_SCENE;
constexpr double kWithin = 0.02;  // the issue's
constexpr double kFeltN = 0.1;
constexpr std::size_t kSettled = 500;     // samples that agree with each other: the hand has come to rest
constexpr double kSettledSpread = 0.005;  // ... within this

/// Mean force of the held hand, N, once it has come to rest; 0 when it never does.
double held_force(const std::string& rate_hz) {
  SessionOnTrial session(kScene, all_on("cyclone"));
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

}  // namespace
}  // namespace omentum::test
