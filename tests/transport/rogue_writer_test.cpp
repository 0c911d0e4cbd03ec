// A foreign writer that does not keep the IDL's bounds.
#include "tests/transport/peer_process.h"
#include "transport/fast/entities.h"
#include "transport/fast/message_type.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>

namespace omentum::transport {
namespace {

using test::eventually;

class RogueWriter : public testing::TestWithParam<Vendor> {};

TEST_P(RogueWriter, ItsSamplesReachNoCallbackAndGoodOnesStillDo) {
  const int domain = test::domain_of_test();
  const auto bus = Bus::open({.vendor = GetParam(), .domain = domain, .name = "reader"});
  std::atomic<std::size_t> good{0}, bad{0};
  const auto reader = bus->reader<msg::Contact>(
      [&](const msg::Contact& contact) { ++(contact.nodes.size() <= msg::MAX_CONTACT_NODES ? good : bad); });

  // below our Writer, which would refuse
  fast::Entities rogue({.domain = domain, .name = "rogue"});
  const TopicSpec& spec = kTopicSpec<msg::Contact>;
  fast::dds::Topic* topic = rogue.topic(spec, fast::dds::TypeSupport(new fast::MessageType<msg::Contact>));
  constexpr std::size_t kSmall = 1000;  // sends within write(), so that no sample replaces the one before it
  fast::dds::DataWriter* writer =
      rogue.publisher->create_datawriter(topic, fast::writer_qos(spec, Profile::kLoopback, kSmall));
  msg::Contact over, within;
  over.nodes.resize(msg::MAX_CONTACT_NODES + 1);
  within.nodes.resize(msg::MAX_CONTACT_NODES);
  fast::SampleRef<msg::Contact> over_ref{&over}, within_ref{&within};

  testing::internal::CaptureStderr();
  // one is written before each good one, so that as many have been refused as good ones came since the match
  constexpr std::size_t kEnough = 10;
  EXPECT_TRUE(eventually([&] {
    writer->write(&over_ref);
    writer->write(&within_ref);
    return good > kEnough;
  }));
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_EQ(bad, 0U);
  EXPECT_GE(reader->status().rejected, kEnough);
  EXPECT_LE(std::count(told.begin(), told.end(), '\n'), 1) << told;
  rogue.publisher->delete_datawriter(writer);
}

INSTANTIATE_TEST_SUITE_P(Vendors, RogueWriter, testing::Values(Vendor::kFast, Vendor::kCyclone),
                         [](const auto& info) { return info.param == Vendor::kFast ? "Fast" : "Cyclone"; });

}  // namespace
}  // namespace omentum::transport
