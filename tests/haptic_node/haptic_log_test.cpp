#include "haptic_node/haptic_log.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

namespace omentum::haptic {
namespace {

TEST(HapticLog, EachTickHasWhatEachToolDidAndFelt) {
  const test::ScratchFolder folder;
  {
    HapticLog log(folder / "log.csv", {0, 3});
    log.push({1000, 0, 7, 0});
    log.tool(1) = {.seq = 5,
                   .stamp_ns = 99,
                   .position = {0.1, -0.2, 0.3},
                   .orientation = {.w = 1, .x = 0, .y = 0.25, .z = 0},
                   .force = {1.5, 0, -2},
                   .torque = {0, 0.125, 0},
                   .state = 12};
    log.push({2000, 1000, 8, 1});
    log.finish();
  }
  std::istringstream lines(test::read_text(folder / "log.csv"));
  std::string header, first, second, more;
  std::getline(lines, header);
  std::getline(lines, first);
  std::getline(lines, second);
  EXPECT_EQ(header,
            "tick,start_ns,period_ns,compute_ns,cause,"
            "tool0_seq,tool0_stamp_ns,tool0_x_m,tool0_y_m,tool0_z_m,tool0_qw,tool0_qx,tool0_qy,tool0_qz,"
            "tool0_fx_n,tool0_fy_n,tool0_fz_n,tool0_tx_nm,tool0_ty_nm,tool0_tz_nm,tool0_state,"
            "tool3_seq,tool3_stamp_ns,tool3_x_m,tool3_y_m,tool3_z_m,tool3_qw,tool3_qx,tool3_qy,tool3_qz,"
            "tool3_fx_n,tool3_fy_n,tool3_fz_n,tool3_tx_nm,tool3_ty_nm,tool3_tz_nm,tool3_state");
  EXPECT_THAT(first, testing::StartsWith("0,1000,0,7,0,0,0,0,0,0,"));
  EXPECT_THAT(second, testing::StartsWith("1,2000,1000,8,1,0,0,"));
  EXPECT_THAT(second, testing::EndsWith(",5,99,0.1,-0.2,0.3,1,0,0.25,0,1.5,0,-2,0,0.125,0,12"));
  EXPECT_FALSE(std::getline(lines, more));
}

}  // namespace
}  // namespace omentum::haptic
