#include "ros_bridge/wire/ros_port.h"

namespace omentum::ros {
namespace {

// What a late or slow node finds: ROS' own default.
constexpr int kDepth = 10;

}  // namespace

std::unique_ptr<RosPort> RosPort::open(const transport::BusOptions& options) {
  return options.vendor == transport::Vendor::kFast ? open_fast_port(options) : open_cyclone_port(options);
}

transport::TopicSpec spec_of(const TopicName& topic) {
  return {
      .name = topic.name.c_str(),
      .reliability = transport::Reliability::kReliable,
      .durability = topic.latched ? transport::Durability::kTransientLocal : transport::Durability::kVolatile,
      .depth = topic.latched ? 1 : kDepth};
}

}  // namespace omentum::ros
