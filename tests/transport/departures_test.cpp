// A reader that tells writers apart: who wrote a sample, and who has left.
#include "transport/departures.h"

#include "tests/transport/peer_process.h"

#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <set>

namespace omentum::transport {
namespace {

using test::eventually;

TEST(Departures, EveryWriterLeavesOnceAndAllWhenTheReaderJoinsAnew) {
  const WriterId one{1}, two{2}, three{3};
  Departures departures;
  for (const WriterId& writer : {one, two, one}) departures.delivered(writer);
  EXPECT_TRUE(departures.take().empty());
  departures.left(one);
  departures.left(three);  // whose samples are still to be taken
  EXPECT_EQ(departures.take(), (std::vector<WriterId>{one, three}));
  EXPECT_TRUE(departures.take().empty());
  departures.left(three);
  EXPECT_EQ(departures.take_all(), (std::vector<WriterId>{three, two}));
  EXPECT_TRUE(departures.take_all().empty());
}

using Pair = std::pair<Vendor, Vendor>;  // of the reader, of the writers

class ByWriterTest : public testing::TestWithParam<Pair> {
 protected:
  bool present(double force_n) {
    const std::lock_guard lock(mutex_);
    return std::any_of(said_.begin(), said_.end(), [&](const auto& said) { return said.second == force_n; });
  }
  std::size_t count() {
    const std::lock_guard lock(mutex_);
    return said_.size();
  }
  std::unique_ptr<Bus> open(Vendor vendor) {
    return Bus::open({.vendor = vendor, .domain = domain_, .name = "departures_test"});
  }

  int domain_ = test::domain_of_test();
  std::mutex mutex_;
  std::map<WriterId, double> said_;  // by those that are there
  std::unique_ptr<Bus> bus_ = open(GetParam().first);
  std::unique_ptr<Reader<msg::DeviceInfo>> reader_ = bus_->reader<msg::DeviceInfo>(
      ByWriter<msg::DeviceInfo>{[this](const msg::DeviceInfo& info, const WriterId& writer) {
                                  const std::lock_guard lock(mutex_);
                                  said_[writer] = info.max_force_n;
                                },
                                [this](const WriterId& writer) {
                                  const std::lock_guard lock(mutex_);
                                  said_.erase(writer);
                                }});
};

msg::DeviceInfo info_of(double force_n) {
  msg::DeviceInfo info{};
  info.max_force_n = force_n;
  return info;
}

TEST_P(ByWriterTest, TwoWritersOfOneKeyAreTwoAndOneThatLeavesIsOneLess) {
  auto one = open(GetParam().second), two = open(GetParam().second);
  auto weak = one->writer<msg::DeviceInfo>(), strong = two->writer<msg::DeviceInfo>();
  weak->write(info_of(0.5));
  strong->write(info_of(10));
  EXPECT_TRUE(eventually([&] { return present(0.5) && present(10); })) << "neither replaces the other";
  strong->write(info_of(8));
  EXPECT_TRUE(eventually([&] { return present(8); }));
  EXPECT_EQ(count(), 2u);
  // its participant as well: Fast DDS does not hear of a Cyclone writer that ends alone
  strong.reset();
  two.reset();
  EXPECT_TRUE(eventually([&] { return count() == 1; }));
  EXPECT_TRUE(present(0.5));
  weak.reset();
  one.reset();
  EXPECT_TRUE(eventually([&] { return count() == 0; }));
}

TEST_P(ByWriterTest, OfAKilledOneIsSaidThatItLeft) {
  test::PeerProcess peer("durable", GetParam().second, domain_);
  ASSERT_TRUE(eventually([&] { return count() == 1; }));
  peer.kill_it();
  EXPECT_TRUE(eventually([&] { return count() == 0; }));
}

TEST_P(ByWriterTest, WhatOneParticipantWritesHasItsNameWhateverTheTopic) {
  std::map<ParticipantId, std::set<std::uint64_t>> moved;  // tools, by who moves them
  const auto poses = bus_->reader<msg::ToolPose>(
      ByWriter<msg::ToolPose>{[&](const msg::ToolPose& pose, const WriterId& writer) {
                                const std::lock_guard lock(mutex_);
                                moved[participant_of(writer)].insert(pose.tool);
                              },
                              [](const WriterId&) {}});
  auto one = open(GetParam().second), two = open(GetParam().second);
  auto weak = one->writer<msg::DeviceInfo>(), strong = two->writer<msg::DeviceInfo>();
  auto left = one->writer<msg::ToolPose>(), right = two->writer<msg::ToolPose>();
  weak->write(info_of(0.5));
  strong->write(info_of(10));
  msg::ToolPose pose_of_left{}, pose_of_right{};
  pose_of_right.tool = 1;
  EXPECT_TRUE(eventually([&] {
    left->write(pose_of_left);
    right->write(pose_of_right);
    const std::lock_guard lock(mutex_);
    return moved.size() == 2 && said_.size() == 2;
  }));
  const std::lock_guard lock(mutex_);
  for (const auto& [writer, force_n] : said_)
    EXPECT_EQ(moved[participant_of(writer)], (std::set<std::uint64_t>{force_n < 1 ? 0U : 1U}));
}

INSTANTIATE_TEST_SUITE_P(
    Vendors, ByWriterTest,
    testing::Values(Pair{Vendor::kFast, Vendor::kFast}, Pair{Vendor::kFast, Vendor::kCyclone},
                    Pair{Vendor::kCyclone, Vendor::kFast}, Pair{Vendor::kCyclone, Vendor::kCyclone}),
    [](const auto& info) {
      return std::string(test::word(info.param.first)) + "Hears" + test::word(info.param.second);
    });

}  // namespace
}  // namespace omentum::transport
