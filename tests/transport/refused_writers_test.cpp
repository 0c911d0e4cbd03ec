// A foreign writer that offers less than our readers request: which policy it is, and what is said of it.
#include "transport/refused_writers.h"

#include "tests/transport/peer_process.h"
#include "transport/fast/entities.h"
#include "transport/fast/message_type.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

namespace omentum::transport {
namespace {

using test::eventually;

/// Writers on Fast DDS of any quality of service.
class ForeignWriters {
 public:
  explicit ForeignWriters(int domain) : entities_({.domain = domain, .name = "foreign"}) {}

  template <class M>
  fast::dds::DataWriter* add(const TopicSpec& offered) {
    fast::dds::Topic* topic = entities_.topic(offered, fast::dds::TypeSupport(new fast::MessageType<M>));
    constexpr std::size_t kSmall = 1000;
    return entities_.publisher->create_datawriter(topic,
                                                  fast::writer_qos(offered, Profile::kLoopback, kSmall));
  }

 private:
  fast::Entities entities_;
};

/// What a reader was refused by.
struct Refused {
  std::function<void(QosPolicy)> note() {
    return [this](QosPolicy policy) { policies.fetch_or(1u << static_cast<unsigned>(policy)); };
  }
  bool only(QosPolicy policy) const { return policies == 1u << static_cast<unsigned>(policy); }

  std::atomic<unsigned> policies{0};
};

class RefusedWriters : public testing::TestWithParam<Vendor> {};

TEST_P(RefusedWriters, ThePolicyIsToldAndAGoodOneIsHeardBesideThem) {
  const int domain = test::domain_of_test();
  testing::internal::CaptureStderr();
  Refused poses_by, infos_by, unasked_by;
  std::atomic<int> heard{0};
  {
    const auto bus = Bus::open({.vendor = GetParam(), .domain = domain, .name = "reader"});
    const auto poses = bus->reader<msg::ToolPose>(
        ByWriter<msg::ToolPose>{[&](const msg::ToolPose& pose, const WriterId&) { heard += pose.tool == 1; },
                                [](const WriterId&) {}, poses_by.note()});
    const auto infos = bus->reader<msg::DeviceInfo>(
        ByWriter<msg::DeviceInfo>{[](const msg::DeviceInfo&, const WriterId&) {}, {}, infos_by.note()});
    // who does not ask who is gone requests no lease
    const auto unasked = bus->reader<msg::ToolPose>(
        ByWriter<msg::ToolPose>{[](const msg::ToolPose&, const WriterId&) {}, {}, unasked_by.note()});

    ForeignWriters writers(domain);
    TopicSpec long_lease = kTopicSpec<msg::ToolPose>, no_lease = long_lease,
              forgetful = kTopicSpec<msg::DeviceInfo>;
    long_lease.liveliness_lease *= 2;
    no_lease.liveliness_lease = {};
    writers.add<msg::ToolPose>(long_lease);
    writers.add<msg::ToolPose>(no_lease);
    forgetful.durability = Durability::kVolatile;
    writers.add<msg::DeviceInfo>(forgetful);
    fast::dds::DataWriter* good = writers.add<msg::ToolPose>(kTopicSpec<msg::ToolPose>);
    msg::ToolPose pose{};
    pose.tool = 1;
    fast::SampleRef<msg::ToolPose> sample{&pose};
    EXPECT_TRUE(eventually([&] {
      good->write(&sample);
      return heard > 0 && poses->status().incompatible_qos >= 2 && poses_by.policies != 0 &&
             infos_by.policies != 0 && unasked->status().matched == 3;
    }));
  }
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(poses_by.only(QosPolicy::kLiveliness)) << poses_by.policies;
  EXPECT_TRUE(infos_by.only(QosPolicy::kDurability)) << infos_by.policies;
  EXPECT_EQ(unasked_by.policies, 0u);
  // both vendors are tried by one process, which tells each only once
  static std::string all;
  all += told;
  EXPECT_EQ(
      all.find("tool_pose: a writer is not heard, LIVELINESS must be automatic, a lease of at most 100 ms "
               "(docs/devices.md"),
      all.rfind("tool_pose: "))
      << all;
  EXPECT_THAT(all,
              testing::HasSubstr("device_info: a writer is not heard, DURABILITY must be transient local"));
}

INSTANTIATE_TEST_SUITE_P(Vendors, RefusedWriters, testing::Values(Vendor::kFast, Vendor::kCyclone),
                         [](const auto& info) { return info.param == Vendor::kFast ? "Fast" : "Cyclone"; });

TEST(QosPolicies, AreThoseOfTheNumbersAndNoOther) {
  constexpr std::uint32_t kOwnNumber = 23;
  EXPECT_STREQ(name_of(policy_of(8, kOwnNumber)), "LIVELINESS");
  EXPECT_STREQ(name_of(policy_of(11, kOwnNumber)), "RELIABILITY");
  EXPECT_STREQ(name_of(policy_of(12, kOwnNumber)), "DESTINATION_ORDER");
  EXPECT_STREQ(name_of(policy_of(23, kOwnNumber)), "DATA_REPRESENTATION");
  for (const std::uint32_t other : {0, 1, 7, 9, 10, 13, 22, 24, 1000})
    EXPECT_EQ(policy_of(other, kOwnNumber), QosPolicy::kOther) << other;
}

TEST(WhatToOffer, IsWhatTheTopicsReaderRequests) {
  EXPECT_EQ(what_to_offer(kTopicSpec<msg::Topology>, QosPolicy::kReliability),
            "RELIABILITY must be reliable");
  EXPECT_EQ(what_to_offer(kTopicSpec<msg::ToolPose>, QosPolicy::kDataRepresentation),
            "DATA_REPRESENTATION must be XCDR1 (plain CDR)");
}

}  // namespace
}  // namespace omentum::transport
