#include "ros_bridge/ros_domain.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace omentum::ros {
namespace {

TEST(RosDomain, IsWhatTheEnvironmentSays) {
  EXPECT_EQ(domain_of(std::nullopt), 0);
  EXPECT_EQ(domain_of(""), 0);
  EXPECT_EQ(domain_of("42"), 42);
  for (const char* wrong : {"abc", "5x", " 5", "-3", "231", "99999999999999999999"})
    EXPECT_THROW(domain_of(wrong), std::runtime_error) << wrong;
}

}  // namespace
}  // namespace omentum::ros
