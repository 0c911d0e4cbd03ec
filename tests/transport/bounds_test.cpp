#include "transport/bounds.h"

#include "tests/transport/fill.h"

#include <gtest/gtest.h>

namespace omentum::transport {
namespace {

template <class... M>
void expect_known_within(msg::TopicList<M...>) {
  (
      [] {
        for (const M& message : test::known_messages<M>()) EXPECT_TRUE(within_bounds(message));
      }(),
      ...);
}

TEST(Bounds, EveryMessageMayFillItsSequencesToTheBound) {
  expect_known_within(msg::AllTopics{});
}

TEST(Bounds, ASequenceOverItsBoundIsFound) {
  msg::Contact contact;
  contact.forces.resize(msg::MAX_CONTACT_NODES + 1);
  EXPECT_FALSE(within_bounds(contact));
}

TEST(Bounds, AStringOverItsBoundIsFoundAtAnyDepth) {
  msg::SceneInfo scene;
  scene.organs.resize(2);
  EXPECT_TRUE(within_bounds(scene));
  scene.organs[1].hash.assign(65, 'f');
  EXPECT_FALSE(within_bounds(scene));

  msg::NodeStatus status;
  status.faults.assign(3, std::string(msg::MAX_LINE, 'x'));
  EXPECT_TRUE(within_bounds(status));
  status.faults[2] += 'x';
  EXPECT_FALSE(within_bounds(status));
}

TEST(Bounds, AZeroByteInAStringIsFound) {
  msg::DeviceInfo device;
  device.name = std::string("pen\0il", 6);
  EXPECT_FALSE(within_bounds(device));
}

}  // namespace
}  // namespace omentum::transport
