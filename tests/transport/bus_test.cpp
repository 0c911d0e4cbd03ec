#include "transport/bus.h"

#include "tests/transport/peer_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

namespace omentum::transport {
namespace {

using test::eventually;
using testing::HasSubstr;

template <class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no exception";
}

TEST(ParseVendor, NamesTheChoices) {
  EXPECT_EQ(parse_vendor("fast"), Vendor::kFast);
  EXPECT_EQ(parse_vendor("cyclone"), Vendor::kCyclone);
  EXPECT_THAT(message_of([] { parse_vendor("rti"); }),
              testing::AllOf(HasSubstr("rti"), HasSubstr("fast or cyclone")));
}

TEST(ParseProfile, NamesTheChoices) {
  EXPECT_EQ(parse_profile("loopback"), Profile::kLoopback);
  EXPECT_EQ(parse_profile("lan"), Profile::kLan);
  EXPECT_THAT(message_of([] { parse_profile("wifi"); }),
              testing::AllOf(HasSubstr("wifi"), HasSubstr("loopback or lan")));
}

class EachVendor : public testing::TestWithParam<Vendor> {
 protected:
  BusOptions options() const { return {.vendor = GetParam(), .domain = domain, .name = "bus_test"}; }
  int domain = test::domain_of_test();
};

TEST_P(EachVendor, AKeyStoreIsRefusedNotIgnored) {
  BusOptions secured = options();
  secured.keystore = "keys";
  EXPECT_THAT(message_of([&] { Bus::open(secured); }), HasSubstr("key store 'keys'"));
}

TEST_P(EachVendor, ADomainWithoutPortsIsRefused) {
  BusOptions wrong = options();
  wrong.domain = 231;
  EXPECT_THAT(message_of([&] { Bus::open(wrong); }), HasSubstr("expected 0 to 230"));
  wrong.domain = -1;
  EXPECT_THAT(message_of([&] { Bus::open(wrong); }), HasSubstr("expected 0 to 230"));
}

TEST_P(EachVendor, ABreachedBoundIsRefusedByTheWriter) {
  const auto bus = Bus::open(options());
  const auto writer = bus->writer<msg::Contact>();
  msg::Contact contact;
  contact.nodes.resize(msg::MAX_CONTACT_NODES + 1);
  EXPECT_FALSE(writer->write(contact));
  contact.nodes.resize(msg::MAX_CONTACT_NODES);
  EXPECT_TRUE(writer->write(contact));
  EXPECT_EQ(writer->status().rejected, 1U);
  EXPECT_EQ(writer->status().samples, 1U);
}

TEST_P(EachVendor, TwoBusesOfOneProcessShareADomain) {
  const auto first = Bus::open(options());
  auto second = Bus::open(options());
  std::atomic<int> samples{0};
  const auto reader = first->reader<msg::SessionCommand>([&](const msg::SessionCommand&) { ++samples; });
  auto writer = second->writer<msg::SessionCommand>();
  EXPECT_TRUE(eventually([&] { return writer->write({}) && samples > 0; }));
  writer.reset();
  second.reset();
  // the first goes on when the second ends
  const auto third = Bus::open(options());
  const auto again = third->writer<msg::SessionCommand>();
  const int before = samples;
  EXPECT_TRUE(eventually([&] { return again->write({}) && samples > before; }));
}

TEST_P(EachVendor, OneProcessMayReadWhatItWrites) {
  const auto bus = Bus::open(options());
  std::atomic<int> samples{0};
  const auto reader = bus->reader<msg::ToolForce>([&](const msg::ToolForce&) { ++samples; });
  const auto writer = bus->writer<msg::ToolForce>();
  EXPECT_TRUE(eventually([&] { return writer->write({}) && samples > 0; }));
}

TEST_P(EachVendor, ACallbackMayWrite) {
  const auto bus = Bus::open(options());
  const auto force_writer = bus->writer<msg::ToolForce>();
  std::atomic<int> forces{0};
  const auto forces_reader = bus->reader<msg::ToolForce>([&](const msg::ToolForce&) { ++forces; });
  const auto poses = bus->reader<msg::ToolPose>(
      [&](const msg::ToolPose& pose) { force_writer->write({.tool = pose.tool}); });
  const auto pose_writer = bus->writer<msg::ToolPose>();
  EXPECT_TRUE(eventually([&] { return pose_writer->write({}) && forces > 0; }));
}

TEST_P(EachVendor, TheUsersVendorSettingsDoNotBreakIt) {
  setenv("CYCLONEDDS_URI", "file:///no/such/file.xml", 1);
  setenv("FASTRTPS_DEFAULT_PROFILES_FILE", "/no/such/file.xml", 1);
  const auto bus = Bus::open(options());
  EXPECT_TRUE(bus->writer<msg::ToolPose>()->write({}));
  unsetenv("CYCLONEDDS_URI");
  unsetenv("FASTRTPS_DEFAULT_PROFILES_FILE");
}

TEST_P(EachVendor, OpensAndClosesAgainAndAgain) {
  for (int round = 0; round < 5; ++round) {
    const auto bus = Bus::open(options());
    const auto writer = bus->writer<msg::OrganState>();
    const auto reader = bus->reader<msg::OrganState>([](const msg::OrganState&) {});
  }
}

TEST_P(EachVendor, OnALanTheSameTopicsWork) {
  BusOptions lan = options();
  lan.profile = Profile::kLan;
  const auto bus = Bus::open(lan);
  std::atomic<int> samples{0};
  const auto reader = bus->reader<msg::Contact>(
      [&](const msg::Contact& contact) { samples += contact.forces.size() == msg::MAX_CONTACT_NODES; });
  const auto other = Bus::open(lan);
  const auto writer = other->writer<msg::Contact>();
  msg::Contact contact;
  contact.forces.resize(msg::MAX_CONTACT_NODES);  // more than one datagram
  EXPECT_TRUE(eventually([&] { return writer->write(contact) && samples > 0; }));
}

INSTANTIATE_TEST_SUITE_P(Vendors, EachVendor, testing::Values(Vendor::kFast, Vendor::kCyclone),
                         [](const auto& info) { return info.param == Vendor::kFast ? "Fast" : "Cyclone"; });

TEST(CycloneBus, OneProcessCannotUseADomainWithTwoProfiles) {
  const BusOptions loopback{.vendor = Vendor::kCyclone, .domain = test::domain_of_test()};
  BusOptions lan = loopback;
  lan.profile = Profile::kLan;
  const auto bus = Bus::open(loopback);
  EXPECT_THAT(message_of([&] { Bus::open(lan); }), HasSubstr("other profile"));
}

}  // namespace
}  // namespace omentum::transport
