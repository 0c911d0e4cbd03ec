// A Fast DDS participant that is replaced underneath its endpoints.
#include "transport/fast/participant.h"

#include "tests/transport/peer_process.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <mutex>
#include <thread>

namespace omentum::transport {
namespace {

using test::eventually;

/// The Bus' own readers are made so where nobody asks who wrote.
template <class M>
ByWriter<M> from_anybody(std::function<void(const M&)> on_sample) {
  return {[callback = std::move(on_sample)](const M& sample, const WriterId&) { callback(sample); }, {}};
}

class RenewedParticipant : public testing::TestWithParam<Vendor> {
 protected:
  int domain = test::domain_of_test();
  fast::Participant participant{{.domain = domain, .name = "renewed"}};
  std::unique_ptr<Bus> partner = Bus::open({.vendor = GetParam(), .domain = domain, .name = "partner"});
};

TEST_P(RenewedParticipant, SamplesGoOnBothWays) {
  std::atomic<std::uint64_t> there{0}, back{0};
  const auto force_writer = partner->writer<msg::ToolForce>();
  const auto poses = partner->reader<msg::ToolPose>([&](const msg::ToolPose& pose) {
    there = pose.seq;
    force_writer->write({.seq = pose.seq});
  });
  const auto pose_writer = participant.writer<msg::ToolPose>();
  const auto forces = participant.reader(
      from_anybody<msg::ToolForce>([&](const msg::ToolForce& force) { back = force.seq; }));
  std::uint64_t seq = 0;
  for (int turn = 0; turn < 3; ++turn) {
    const std::uint64_t before = seq;
    EXPECT_TRUE(eventually([&] {
      pose_writer->write({.seq = ++seq});
      return there > before && back > before;
    }));
    EXPECT_TRUE(participant.renew());
  }
}

TEST_P(RenewedParticipant, WhatIsDurableIsSaidAgainToLateJoiners) {
  const auto infos = participant.writer<msg::DeviceInfo>();
  for (const std::uint32_t tool : {0U, 1U, 0U})
    EXPECT_TRUE(
        infos->write({.tool = tool, .max_force_n = 3, .max_torque_nm = infos->status().samples + 0.0}));
  EXPECT_TRUE(participant.renew());
  std::mutex mutex;
  std::map<std::uint32_t, double> heard;
  const auto reader = partner->reader<msg::DeviceInfo>([&](const msg::DeviceInfo& info) {
    const std::lock_guard lock(mutex);
    heard[info.tool] = info.max_torque_nm;
  });
  EXPECT_TRUE(eventually([&] {
    const std::lock_guard lock(mutex);
    return heard.size() == 2;
  }));
  const std::lock_guard lock(mutex);
  EXPECT_EQ(heard[0], 2);  // the newest of its key, not the first
  EXPECT_EQ(heard[1], 1);
  EXPECT_EQ(infos->status().samples, 3U);
}

// Who left while nobody listened is not kept for ever; who is still there speaks again, and stays.
TEST_P(RenewedParticipant, WritersHaveLeftAndComeBack) {
  std::mutex mutex;
  std::map<WriterId, double> there;
  int left = 0, said = 0;
  const auto reader =
      participant.reader(ByWriter<msg::DeviceInfo>{[&](const msg::DeviceInfo& info, const WriterId& writer) {
                                                     const std::lock_guard lock(mutex);
                                                     there[writer] = info.max_force_n;
                                                     ++said;
                                                   },
                                                   [&](const WriterId& writer) {
                                                     const std::lock_guard lock(mutex);
                                                     left += static_cast<int>(there.erase(writer));
                                                   }});
  const auto infos = partner->writer<msg::DeviceInfo>();
  infos->write({.tool = 0, .max_force_n = 3});
  for (int turn = 0; turn < 3; ++turn) {
    EXPECT_TRUE(eventually([&] {
      const std::lock_guard lock(mutex);
      return said > turn && left == turn && there.size() == 1;
    })) << "turn "
        << turn;
    EXPECT_TRUE(participant.renew());
  }
}

TEST_P(RenewedParticipant, WritersAndReadersComeAndGoMeanwhile) {
  std::atomic<int> concurrent{0};
  std::atomic<bool> overlapped{false};
  std::atomic<std::uint64_t> arrived{0};
  const auto poses = partner->writer<msg::ToolPose>();
  const auto reader = participant.reader(from_anybody<msg::ToolPose>([&](const msg::ToolPose&) {
    overlapped = overlapped || ++concurrent > 1;
    ++arrived;
    --concurrent;
  }));
  const auto forces = participant.writer<msg::ToolForce>();
  std::jthread writes([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      poses->write({});
      forces->write({});
      (void)forces->status();
      (void)reader->status();
    }
  });
  std::jthread comes_and_goes([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const auto statuses = participant.reader(from_anybody<msg::NodeStatus>([](const msg::NodeStatus&) {}));
      (void)participant.writer<msg::NodeStatus>()->write({});
    }
  });
  for (int turn = 0; turn < 5; ++turn) EXPECT_TRUE(participant.renew());
  comes_and_goes = {};
  const std::uint64_t before = arrived;
  EXPECT_TRUE(eventually([&] { return arrived > before; }));
  EXPECT_FALSE(overlapped);
}

INSTANTIATE_TEST_SUITE_P(Partners, RenewedParticipant, testing::Values(Vendor::kFast, Vendor::kCyclone),
                         [](const auto& info) { return info.param == Vendor::kFast ? "Fast" : "Cyclone"; });

}  // namespace
}  // namespace omentum::transport
