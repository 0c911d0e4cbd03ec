#include "transport/topics.h"

#include <gtest/gtest.h>

#include <cctype>
#include <set>

namespace omentum::transport {
namespace {

std::string snake_case(const std::string& type) {
  std::string text;
  for (const char letter : type.substr(type.rfind(':') + 1)) {
    const bool upper = std::isupper(static_cast<unsigned char>(letter));
    if (upper && !text.empty()) text += '_';
    text += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return text;
}

TEST(Topics, NamesCarryTheProtocolVersionAndTheMessage) {
  std::set<std::string> names;
  msg::for_each_topic(msg::AllTopics{}, [&]<class M>(msg::MessageTag<M>) {
    const std::string expected =
        "omentum/" + std::to_string(msg::PROTOCOL_VERSION) + "/" + snake_case(msg::MessageInfo<M>::kTypeName);
    EXPECT_EQ(kTopicSpec<M>.name, expected);
    names.insert(kTopicSpec<M>.name);
  });
  EXPECT_EQ(names.size(), 13U);
}

TEST(Topics, WhatALateJoinerNeedsIsDurable) {
  const auto durable = [](const TopicSpec& spec) { return spec.durability == Durability::kTransientLocal; };
  EXPECT_TRUE(durable(kTopicSpec<msg::DeviceInfo>));
  EXPECT_TRUE(durable(kTopicSpec<msg::Topology>));
  EXPECT_TRUE(durable(kTopicSpec<msg::SceneInfo>));
  EXPECT_TRUE(durable(kTopicSpec<msg::NodeStatus>));
  EXPECT_FALSE(durable(kTopicSpec<msg::SessionCommand>));  // an old "clear fault" must not come again
}

TEST(Topics, ABlockOfAStateFitsOneDatagramOnALan) {
  const std::size_t floats = organ_block_floats(Profile::kLan);
  EXPECT_EQ(floats % 3, 0U);
  EXPECT_GT(floats, 150U);
  EXPECT_LT(floats * sizeof(float), max_message_bytes(Profile::kLan));
  EXPECT_EQ(organ_block_floats(Profile::kLoopback), msg::MAX_BLOCK_FLOATS);
}

}  // namespace
}  // namespace omentum::transport
