// Topics of ROS 2 over either vendor, without ROS.
#pragma once

#include "ros_bridge/wire/ros_types.h"
#include "transport/topics.h"

#include <functional>
#include <memory>
#include <string>

namespace omentum::ros {

/// Writes one topic. One thread at a time.
template <class M>
class Publisher {
 public:
  virtual ~Publisher() = default;
  /// Texts of `message` are read during the call only. False: the vendor refused. Never throws.
  virtual bool publish(const M& message) noexcept = 0;
};

/// Reads one topic until destroyed; `take` runs on the vendor's thread, and the message lives during the
/// call.
class Subscription {
 public:
  virtual ~Subscription() = default;
};

/// How nodes of ROS ask for a topic: reliable; `latched` (transient local) where who comes later needs the
/// newest one, too. A reader or writer of best effort that ROS has is served as well, or not heard: DDS
/// matches no reliable reader with a writer of best effort.
struct TopicName {
  std::string name;  // with "rt/" before it, as ROS 2 names topics on the wire
  bool latched = false;
};

/// One participant in a domain of ROS (ROS_DOMAIN_ID). Destroy publishers and subscriptions before it. Not
/// for real-time threads.
class RosPort {
 public:
  /// Joins, in the vendor's and profile's way of transport::Bus. Throws std::runtime_error saying what was
  /// refused.
  static std::unique_ptr<RosPort> open(const transport::BusOptions& options);
  virtual ~RosPort() = default;

  /// Both throw std::runtime_error. M: one of OMENTUM_FOR_EACH_ROS.
  template <class M>
  std::unique_ptr<Publisher<M>> publisher(const TopicName& topic) {
    return make_publisher(topic, static_cast<M*>(nullptr));
  }
  template <class M>
  std::unique_ptr<Subscription> subscription(const TopicName& topic, std::function<void(const M&)> take) {
    return make_subscription(topic, std::move(take));
  }

 private:
#define OMENTUM_MAKES_ENDS(M, name)                                                                   \
  virtual std::unique_ptr<Publisher<ros::M>> make_publisher(const TopicName& topic, ros::M* tag) = 0; \
  virtual std::unique_ptr<Subscription> make_subscription(const TopicName& topic,                     \
                                                          std::function<void(const ros::M&)> take) = 0;
  OMENTUM_FOR_EACH_ROS(OMENTUM_MAKES_ENDS)
#undef OMENTUM_MAKES_ENDS
};

/// The same for each vendor.
std::unique_ptr<RosPort> open_fast_port(const transport::BusOptions& options);
std::unique_ptr<RosPort> open_cyclone_port(const transport::BusOptions& options);

/// The topic as transport/ takes it; `topic` must outlive it.
transport::TopicSpec spec_of(const TopicName& topic);

}  // namespace omentum::ros
