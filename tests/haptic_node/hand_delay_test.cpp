// A hand that presses, on a wire that keeps every answer back: passive, and felt all the same.
#include "hand_bench.h"

#include "node_common/energy_tank.h"

#include <gtest/gtest.h>

namespace omentum::hand_test {
namespace {

constexpr double kLatePeak_n = 4;

// Down to where the spring has kLatePeak_n and back, again and again.
Path press_again(double stiffness_n_m, double press_s) {
  return [=](double t) {
    const double depth_m = kLatePeak_n / stiffness_n_m, turn = 2 * M_PI * std::max(0.0, t - 1) / press_s;
    return Vec3(0, 0, depth_m * std::cos(turn));
  };
}

Model wall(double stiffness_n_m) {
  return [=](const Seen& seen) {
    const double depth = std::max(0.0, -seen.tip.z());
    haptic::ToolOutput output;
    output.force = {0, 0, stiffness_n_m * depth};
    output.stored_j = 0.5 * stiffness_n_m * depth * depth;
    return output;
  };
}

// A spring that answers tau late gives pi k d^2 w tau / 2 in each press, here 0.8 to 8 mJ, twenty times.
TEST(HandDelay, OfAPressIsNoSourceAndItsPeakIsFelt) {
  constexpr int kPresses = 20;
  for (const double late_ms : {0.0, 5.0}) {
    for (const double rate_hz : {300.0, 1000.0}) {
      for (const double stiffness_n_m : {200.0, 1000.0}) {
        for (const double press_s : {0.5, 1.0}) {
          HandBench bench(rate_hz, press_again(stiffness_n_m, press_s), wall(stiffness_n_m),
                          {.kept_back = late_ms > 0 ? 1.0 : 0.0, .late_ms = late_ms});
          bench.run(1 + (kPresses - 1) * press_s);
          bench.forget_peaks();
          const Received& received = bench.run(press_s);
          SCOPED_TRACE(testing::Message() << late_ms << " ms late, " << stiffness_n_m << " N/m, " << rate_hz
                                          << " Hz, " << press_s << " s");
          EXPECT_LE(received.most_j, node::EnergyTank::kBound_j);
          EXPECT_GE(received.largest_n, 0.9 * kLatePeak_n) << "in the last press";
        }
      }
    }
  }
}

}  // namespace
}  // namespace omentum::hand_test
