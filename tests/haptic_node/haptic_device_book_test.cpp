#include "haptic_node/device_book.h"

#include <gtest/gtest.h>

#include <limits>

namespace omentum::haptic {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kTiny = 5e-324;  // the smallest number above 0 that there is
const transport::WriterId kDevice{1}, kStranger{2}, kThird{3};

msg::DeviceInfo info_of(double force_n, double torque_nm = 1, double stiffness_n_m = 1000,
                        std::uint32_t axes = 0) {
  msg::DeviceInfo info{};
  info.max_force_n = force_n;
  info.max_torque_nm = torque_nm;
  info.max_stiffness_n_m = stiffness_n_m;
  info.actuated_axes = axes;
  return info;
}

TEST(DeviceBook, ZeroForceIsMeant) {
  DeviceBook book;
  EXPECT_TRUE(book.hear(info_of(0, 0), kDevice).empty());
  EXPECT_EQ(book.limits().max_force_n, 0);
  EXPECT_EQ(book.limits().max_torque_nm, 0);
}

TEST(DeviceBook, WhatIsNoLimitIsRefusedByNameAndTheLastGoodOneHolds) {
  DeviceBook book;
  ASSERT_TRUE(book.hear(info_of(0.3, 0.02, 500), kDevice).empty());
  for (const double nonsense : {kNan, -1.0, kInf, -kInf, 1e300}) {
    for (const LimitField field : {kMaxForce, kMaxTorque, kMaxStiffness}) {
      msg::DeviceInfo bad = info_of(0.3, 0.02, 500);
      double* const fields[] = {&bad.max_force_n, &bad.max_torque_nm, &bad.max_stiffness_n_m};
      *fields[field] = nonsense;
      const auto refused = book.hear(bad, kDevice);
      ASSERT_EQ(refused.size(), 1u) << nonsense;
      EXPECT_EQ(refused[0].field, field);
      EXPECT_EQ(book.limits().max_force_n, 0.3);
      EXPECT_EQ(book.limits().max_torque_nm, 0.02);
      EXPECT_EQ(book.limits().max_stiffness_n_m, 500);
    }
  }
}

TEST(DeviceBook, FieldByField) {
  DeviceBook book;
  book.hear(info_of(0.3, 0.02, 500), kDevice);
  book.hear(info_of(kNan, 0.01, kTiny), kDevice);
  EXPECT_EQ(book.limits().max_force_n, 0.3);
  EXPECT_EQ(book.limits().max_torque_nm, 0.01) << "what was said well is taken";
  EXPECT_EQ(book.limits().max_stiffness_n_m, 500);
}

TEST(DeviceBook, NothingThatASolverCannotBearIsALimit) {
  DeviceBook book;
  for (const double stiffness : {kTiny, 0.0, 1e-9, 1e12}) book.hear(info_of(1, 1, stiffness), kDevice);
  EXPECT_EQ(book.limits().max_stiffness_n_m, DeviceLimits{}.max_stiffness_n_m);
}

TEST(DeviceBook, NobodyLiftsWhatADeviceAskedFor) {
  DeviceBook book;
  book.hear(info_of(0.5, 0.01, 300), kDevice);
  book.hear(info_of(10, 1, 5000), kStranger);
  EXPECT_EQ(book.limits().max_force_n, 0.5);
  EXPECT_EQ(book.limits().max_torque_nm, 0.01);
  EXPECT_EQ(book.limits().max_stiffness_n_m, 300);
  book.hear(info_of(0.2), kThird);
  EXPECT_EQ(book.limits().max_force_n, 0.2);
  book.gone(kThird);
  book.gone(kStranger);
  EXPECT_EQ(book.limits().max_force_n, 0.5) << "who leaves takes his limits with him";
  EXPECT_EQ(book.limits().max_stiffness_n_m, 300);
}

TEST(DeviceBook, TheLastOnesLimitsHoldUntilAnotherOneSpeaks) {
  DeviceBook book;
  book.hear(info_of(0.5), kDevice);
  book.gone(kDevice);
  EXPECT_EQ(book.limits().max_force_n, 0.5) << "it may only be out of sight";
  book.hear(info_of(kNan), kStranger);
  EXPECT_EQ(book.limits().max_force_n, 0.5) << "who says nothing lifts nothing";
  book.gone(kStranger);
  book.hear(info_of(8), kThird);
  EXPECT_EQ(book.limits().max_force_n, 8) << "the device was exchanged";
}

TEST(DeviceBook, AxesAreThoseThatAllDrive) {
  constexpr std::uint32_t kPlane = msg::AXIS_X | msg::AXIS_Y, kUpright = msg::AXIS_Y | msg::AXIS_Z;
  DeviceBook book;
  book.hear(info_of(1, 1, 1000, 0), kDevice);
  book.hear(info_of(1, 1, 1000, kPlane), kStranger);
  EXPECT_EQ(book.limits().actuated_axes, kPlane) << "who names none is no reason";
  book.hear(info_of(1, 1, 1000, kUpright), kThird);
  EXPECT_EQ(book.limits().actuated_axes, msg::AXIS_Y);
  book.hear(info_of(1, 1, 1000, msg::AXIS_GRIP), kThird);
  EXPECT_EQ(book.limits().max_force_n, 0) << "none in common is not the same as none named";
  EXPECT_EQ(book.limits().max_torque_nm, 0);
}

TEST(DeviceBook, ACrowdTightensAndNeverLifts) {
  DeviceBook book;
  for (std::uint8_t i = 0; i < 200; ++i) {
    const double force_n = 300 - i;
    book.hear(info_of(force_n), transport::WriterId{i});
    EXPECT_EQ(book.limits().max_force_n, force_n) << "the newest is the smallest";
  }
  for (std::uint8_t i = 0; i < 200; ++i) book.gone(transport::WriterId{i});
  EXPECT_EQ(book.limits().max_force_n, 101);
}

}  // namespace
}  // namespace omentum::haptic
