// The bytes of each message, laid out by hand after CDR (OMG, DDSI-RTPS 2.3, section 10; plain CDR of DDS):
// an encapsulation of 4 bytes, then every field at a multiple of its own size, counted from there; a text is
// its length with the final zero, and its letters.
#include "ros_bridge/crtk.h"
#include "ros_bridge/wire/fast_type.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <vector>

namespace omentum::ros {
namespace {

static_assert(std::endian::native == std::endian::little);  // what the bytes below are

using Bytes = std::vector<std::uint8_t>;

// Written by hand, byte after byte; nothing of a CDR library.
struct Layout {
  Bytes bytes{0, 1, 0, 0};  // CDR_LE, no options

  Layout& raw(std::initializer_list<int> values) {
    for (const int value : values) bytes.push_back(static_cast<std::uint8_t>(value));
    return *this;
  }
  Layout& number(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
    return *this;
  }
  Layout& numbers(std::initializer_list<double> values) {
    for (const double value : values) number(value);
    return *this;
  }
};

template <class M>
Bytes on_the_wire(const M& message) {
  const FastType<M> type;
  Bytes bytes(type.bytes_of(&message));
  bytes.resize(type.write(&message, reinterpret_cast<char*>(bytes.data()), type.most_bytes()));
  return bytes;
}

// 0x12345678 s and 0x0a0b0c0d ns, "world": 4 + 4 + 4 + 6 bytes, and 6 up to the next multiple of 8.
constexpr std::int64_t kAt_ns = std::int64_t{0x12345678} * 1'000'000'000 + 0x0a0b0c0d;
Layout stamped_world() {
  Layout layout;
  layout.raw({0x78, 0x56, 0x34, 0x12, 0x0d, 0x0c, 0x0b, 0x0a, 6, 0, 0, 0, 'w', 'o', 'r', 'l', 'd', 0});
  return layout;
}

struct RosBytesTest : ::testing::Test {
  RosBytesTest() {
    pose.valid = true;
    pose.position = {1, 2, 3};
    pose.orientation = {0.5, 0.1, 0.2, 0.3};
    pose.linear_velocity = {4, 5, 6};
    pose.angular_velocity = {7, 8, 9};
    force.force = {-1, -2, -3};
    force.torque = {0.25, 0.5, 0.75};
    tool = {&pose, &force, kAt_ns, kAt_ns};
  }
  msg::ToolPose pose;
  msg::ToolForce force;
  ToolNow tool;
  std::string frame = "world";
};

TEST_F(RosBytesTest, PoseStamped) {
  Layout expected = stamped_world().raw({0, 0, 0, 0, 0, 0}).numbers({1, 2, 3, 0.1, 0.2, 0.3, 0.5});
  EXPECT_EQ(on_the_wire(measured_cp(tool, frame)), expected.bytes);
  EXPECT_EQ(expected.bytes.size(), 4U + 24 + 7 * 8);
}

TEST_F(RosBytesTest, AnInvalidPoseHasTheStampZero) {
  pose.valid = false;
  Layout expected;
  expected.raw({0, 0, 0, 0, 0, 0, 0, 0, 6, 0, 0, 0, 'w', 'o', 'r', 'l', 'd', 0, 0, 0, 0, 0, 0, 0})
      .numbers({0, 0, 0, 0, 0, 0, 1});
  EXPECT_EQ(on_the_wire(measured_cp(tool, frame)), expected.bytes);
}

TEST_F(RosBytesTest, WrenchStamped) {
  Layout expected = stamped_world().raw({0, 0, 0, 0, 0, 0}).numbers({-1, -2, -3, 0.25, 0.5, 0.75});
  EXPECT_EQ(on_the_wire(servo_cf(tool, frame)), expected.bytes);
}

TEST_F(RosBytesTest, CartesianState) {
  Layout expected = stamped_world().raw({0, 0, 0, 0, 0, 0}).numbers({1, 2, 3, 0.1, 0.2, 0.3, 0.5});
  expected.raw({1, 0, 0, 0, 0, 0, 0, 0}).numbers({4, 5, 6, 7, 8, 9});
  expected.raw({1, 0, 0, 0, 0, 0, 0, 0}).numbers({0, 0, 0, 0, 0, 0}).raw({0});
  EXPECT_EQ(on_the_wire(measured_cs(tool, frame)), expected.bytes);
}

TEST_F(RosBytesTest, OperatingState) {
  Layout expected = stamped_world().raw({0, 0, 7, 0, 0, 0, 'P', 'A', 'U', 'S', 'E', 'D', 0, 1, 0});
  EXPECT_EQ(on_the_wire(operating_state(Operating::kPaused, true, kAt_ns, frame)), expected.bytes);
}

TEST_F(RosBytesTest, ACommandIsReadFromItsBytes) {
  Layout bytes = stamped_world().raw({0, 0, 6, 0, 0, 0, 'p', 'a', 'u', 's', 'e', 0});
  const FastType<StringStamped> type;
  auto* data = reinterpret_cast<char*>(bytes.bytes.data());
  const auto length = static_cast<std::uint32_t>(bytes.bytes.size());
  auto* command = static_cast<StringStamped*>(type.make());
  ASSERT_TRUE(type.read(data, length, command));
  EXPECT_STREQ(command->string_, "pause");
  EXPECT_EQ(command->header_.stamp_.sec_, 0x12345678);
  EXPECT_FALSE(type.read(data, length - 3, command));  // cut off in the middle of the word
  type.destroy(command);
}

TEST_F(RosBytesTest, TheNamesAreThoseOfRos) {
  EXPECT_STREQ(FastType<PoseStamped>().name(), "geometry_msgs::msg::dds_::PoseStamped_");
  EXPECT_STREQ(FastType<WrenchStamped>().name(), "geometry_msgs::msg::dds_::WrenchStamped_");
  EXPECT_STREQ(FastType<CartesianState>().name(), "crtk_msgs::msg::dds_::CartesianState_");
  EXPECT_STREQ(FastType<OperatingState>().name(), "crtk_msgs::msg::dds_::OperatingState_");
  EXPECT_STREQ(FastType<StringStamped>().name(), "crtk_msgs::msg::dds_::StringStamped_");
}

}  // namespace
}  // namespace omentum::ros
