// What the vendors write to their logs.
#include "transport/complaints.h"

#include "transport/cyclone/complaints.h"
#include "transport/cyclone/entities.h"
#include "transport/fast/complaints.h"
#include "transport/fast/entities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace omentum::transport {
namespace {

constexpr int kOften = 1000;

template <class Act>
std::string told_by(Act&& act) {
  testing::internal::CaptureStderr();
  act();
  return testing::internal::GetCapturedStderr();
}

TEST(Complaints, EachKindIsToldOnce) {
  const std::string told = told_by([] {
    for (int i = 0; i < kOften; ++i) {
      tell_once("we", "a kind", "one");
      tell_once("we", "another kind", "two");
      complain_once("they", "a kind", "three\nand more of it\n");
    }
  });
  EXPECT_EQ(told, "we: one\nwe: two\nthey: three (further ones are not told)\n");
}

TEST(Complaints, OfFastAreOnePlainLine) {
  fast::tell_complaints_once();
  const std::string told = told_by([] {
    for (int i = 0; i < kOften; ++i) EPROSIMA_LOG_ERROR(A_CATEGORY, "failure " << i);
    eprosima::fastdds::dds::Log::Flush();
  });
  EXPECT_EQ(told, "Fast DDS: failure 0 (further ones are not told)\n");
}

void fail_to_write(const char* address, std::uint32_t line) {
  dds_log(DDS_LC_WARNING, __FILE__, line, __func__, "ddsi_udp_conn_write to udp/%s failed with retcode -1\n",
          address);
}

TEST(Complaints, OfCycloneNameAPeerThatCannotBeReachedOnce) {
  cyclone::tell_complaints_once();
  const std::string told = told_by([] {
    for (std::uint32_t i = 0; i < kOften; ++i) {
      fail_to_write("10.8.0.7:7650", i);
      fail_to_write("10.8.0.7:7651", i);
    }
  });
  EXPECT_EQ(
      told,
      "Cyclone DDS: 10.8.0.7 cannot be reached: nothing that is sent there arrives (further ones are not "
      "told)\n");
}

}  // namespace
}  // namespace omentum::transport
