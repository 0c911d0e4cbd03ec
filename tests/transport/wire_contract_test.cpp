// What holds between two processes, whichever vendor each of them uses.
#include "runtime/clock.h"
#include "tests/transport/fill.h"
#include "tests/transport/peer_process.h"
#include "transport/latest.h"
#include "transport/topics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <tuple>

namespace omentum::transport {
namespace {

using test::eventually;
using test::PeerProcess;

struct Pairing {
  Vendor writer;
  Vendor reader;
};

class WireContract : public testing::TestWithParam<Pairing> {
 protected:
  explicit WireContract(Profile with = Profile::kLoopback) : profile(with) {}

  std::unique_ptr<PeerProcess> peer(const std::string& what) {
    return std::make_unique<PeerProcess>(what, GetParam().writer, domain, profile);
  }
  std::unique_ptr<Bus> open() {
    return Bus::open(
        {.vendor = GetParam().reader, .domain = domain, .profile = profile, .name = "wire_contract_test"});
  }

  // the only readers that are told of a writer's liveliness
  static std::unique_ptr<Reader<msg::ToolPose>> asks_who_is_gone(Bus& bus) {
    return bus.reader<msg::ToolPose>(
        ByWriter<msg::ToolPose>{[](const msg::ToolPose&, const WriterId&) {}, [](const WriterId&) {}});
  }

  int domain = test::domain_of_test();
  Profile profile;
};

/// The same machine twice, but through a network's interface and with a network's message sizes.
class LanContract : public WireContract {
 protected:
  LanContract() : WireContract(Profile::kLan) {}
  void SetUp() override {
    if (!test::has_lan()) GTEST_SKIP() << "no interface but lo is up and does multicast, which `lan` needs";
  }
};

/// Collects which of the known messages arrived, and whether any other did.
template <class M>
class KnownCollector {
 public:
  explicit KnownCollector(Bus& bus)
      : expected_(test::known_messages<M>()),
        reader_(bus.reader<M>([this](const M& message) { take(message); })) {}

  std::size_t expected() const { return expected_.size(); }
  std::size_t arrived() const {
    const std::lock_guard lock(mutex_);
    return arrived_.size();
  }
  std::size_t foreign() const {
    const std::lock_guard lock(mutex_);
    return foreign_;
  }
  EndpointStatus status() const { return reader_->status(); }

 private:
  void take(const M& message) {
    const auto found = std::find(expected_.begin(), expected_.end(), message);
    const std::lock_guard lock(mutex_);
    if (found == expected_.end()) {
      ++foreign_;
    } else {
      arrived_.insert(static_cast<std::size_t>(found - expected_.begin()));
    }
  }

  const std::vector<M> expected_;
  mutable std::mutex mutex_;
  std::set<std::size_t> arrived_;
  std::size_t foreign_ = 0;
  std::unique_ptr<Reader<M>> reader_;
};

template <class M>
void expect_all_known(const KnownCollector<M>& collector) {
  const char* type = msg::MessageInfo<M>::kTypeName;
  EXPECT_TRUE(eventually([&] { return collector.arrived() == collector.expected(); }))
      << type << ": " << collector.arrived() << " of " << collector.expected();
  EXPECT_EQ(collector.foreign(), 0U) << type;
  EXPECT_EQ(collector.status().rejected, 0U) << type;
  EXPECT_EQ(collector.status().incompatible_qos, 0U) << type;
}

template <class... M>
void expect_known(msg::TopicList<M...>, Bus& bus) {
  const std::tuple<KnownCollector<M>...> collectors{((void)sizeof(M), std::ref(bus))...};
  std::apply([](const auto&... collector) { (expect_all_known(collector), ...); }, collectors);
}

TEST_P(WireContract, EveryMessageArrivesFieldByField) {
  const auto sender = peer("known");
  const auto bus = open();
  expect_known(msg::AllTopics{}, *bus);
  EXPECT_EQ(sender->end(), 0);
}

TEST_P(WireContract, ALateJoinerGetsTheNewestDurableSampleOfEachKey) {
  const auto sender = peer("durable");
  const auto bus = open();
  expect_known(msg::TopicList<msg::DeviceInfo, msg::Topology, msg::NodeStatus>{}, *bus);
  // SceneInfo has no key: only the last one written is kept
  const msg::SceneInfo newest = test::known_messages<msg::SceneInfo>().back();
  std::mutex mutex;
  std::vector<msg::SceneInfo> scenes;
  const auto reader = bus->reader<msg::SceneInfo>([&](const msg::SceneInfo& scene) {
    const std::lock_guard lock(mutex);
    scenes.push_back(scene);
  });
  EXPECT_TRUE(eventually([&] {
    const std::lock_guard lock(mutex);
    return !scenes.empty();
  }));
  const std::lock_guard lock(mutex);
  EXPECT_EQ(scenes, std::vector{newest});
}

TEST_P(WireContract, AnOrganStateOfOneAndAHalfMegabytesArrives) {
  const auto sender = peer("organ");
  const auto bus = open();
  const msg::OrganState expected = test::large_organ_state();
  std::atomic<int> equal{0}, different{0};
  const auto reader = bus->reader<msg::OrganState>(
      [&](const msg::OrganState& state) { ++(state == expected ? equal : different); });
  EXPECT_TRUE(eventually([&] { return equal >= 3; }));
  EXPECT_EQ(different, 0);
}

TEST_P(WireContract, EachToolKeepsItsOwnNewestSampleAndItsOwnGaps) {
  const auto sender = peer("poses");
  const auto bus = open();
  const LatestByTool<msg::ToolPose> poses(*bus, {}, runtime::steady_now_ns);
  constexpr std::uint64_t kEnough = 300;  // at least two numbers were left out meanwhile
  ASSERT_TRUE(eventually(
      [&] { return poses.counters(0).received > kEnough && poses.counters(1).received > kEnough; }));
  for (std::uint32_t tool = 0; tool < 2; ++tool) {
    Arrived<msg::ToolPose> newest;
    ASSERT_TRUE(poses.load(tool, newest));
    EXPECT_EQ(newest.sample.tool, tool);
    EXPECT_EQ(newest.sample.position.x, tool + 1);
    EXPECT_GE(poses.counters(tool).lost, 2U);
    EXPECT_EQ(poses.counters(tool).duplicates, 0U);
    EXPECT_EQ(poses.counters(tool).restarts, 0U);
  }
  Arrived<msg::ToolPose> none;
  EXPECT_FALSE(poses.load(2, none));
}

TEST_P(WireContract, AKilledWriterIsNoticed) {
  const auto sender = peer("poses");
  const auto bus = open();
  const LatestByTool<msg::ToolPose> poses(*bus, {}, runtime::steady_now_ns);
  const auto asking = asks_who_is_gone(*bus);
  ASSERT_TRUE(eventually([&] { return poses.counters(0).received > 0 && asking->status().samples > 0; }));
  EXPECT_EQ(poses.status().matched, 1);
  const EndpointStatus before = asking->status();
  sender->kill_it();
  EXPECT_TRUE(eventually([&] { return asking->status().deadline_missed > before.deadline_missed; }));
  EXPECT_TRUE(eventually([&] { return asking->status().liveliness_lost > before.liveliness_lost; }));
  EXPECT_TRUE(eventually([&] { return poses.status().matched == 0; }));
  EXPECT_GT(poses.status().deadline_missed, 0U) << "counted by every reader";
  EXPECT_EQ(poses.status().liveliness_lost, 0U) << "requested by none that does not ask";
}

TEST_P(WireContract, ARestartedWriterIsHeardAgain) {
  auto sender = peer("poses");
  const auto bus = open();
  const LatestByTool<msg::ToolPose> poses(*bus, {}, runtime::steady_now_ns);
  const auto asking = asks_who_is_gone(*bus);
  ASSERT_TRUE(eventually([&] { return poses.counters(0).received > 0 && asking->status().samples > 0; }));
  sender->kill_it();
  // what was under way when it died has arrived once its liveliness ended
  ASSERT_TRUE(eventually([&] { return asking->status().liveliness_lost > 0; }));
  const std::uint64_t before = poses.counters(0).received;
  sender = peer("poses");
  EXPECT_TRUE(eventually([&] { return poses.counters(0).received > before; }));
}

TEST_P(WireContract, AReaderCanEndWhileSamplesArrive) {
  const auto sender = peer("poses");
  const auto bus = open();
  for (int round = 0; round < 10; ++round) {
    std::atomic<bool> ended{false};
    std::atomic<int> samples{0}, late{0};
    auto reader = bus->reader<msg::ToolPose>([&](const msg::ToolPose&) {
      ++samples;
      if (ended) ++late;
    });
    ASSERT_TRUE(eventually([&] { return samples > 3; }));
    reader.reset();
    ended = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    EXPECT_EQ(late, 0);
  }
}

TEST_P(LanContract, PosesArriveForEachTool) {
  const auto sender = peer("poses");
  const auto bus = open();
  const LatestByTool<msg::ToolPose> poses(*bus, {}, runtime::steady_now_ns);
  EXPECT_TRUE(
      eventually([&] { return poses.counters(0).received > 100 && poses.counters(1).received > 100; }));
  Arrived<msg::ToolPose> newest;
  ASSERT_TRUE(poses.load(1, newest));
  EXPECT_EQ(newest.sample.position.x, 2);
}

TEST_P(LanContract, AMessageOfSeveralDatagramsArrivesFieldByField) {
  static_assert(msg::MAX_CONTACT_NODES * sizeof(msg::Vec3) > max_message_bytes(Profile::kLan));
  const auto sender = peer("contacts");
  const auto bus = open();
  expect_all_known(KnownCollector<msg::Contact>(*bus));
}

TEST_P(LanContract, AnOrganStateArrivesInBlocksOfOneDatagram) {
  const auto sender = peer("blocks");
  const auto bus = open();
  const std::vector<msg::OrganState> expected =
      test::organ_state_in_blocks(organ_block_floats(Profile::kLan));
  ASSERT_GT(expected.size(), 100U);
  std::mutex mutex;
  std::set<std::uint32_t> arrived;
  std::size_t different = 0;
  const auto reader = bus->reader<msg::OrganState>([&](const msg::OrganState& block) {
    const std::lock_guard lock(mutex);
    const bool equal = block.block < expected.size() && block == expected[block.block];
    if (equal) arrived.insert(block.block);
    different += !equal;
  });
  EXPECT_TRUE(eventually([&] {
    const std::lock_guard lock(mutex);
    return arrived.size() == expected.size();
  }));
  const std::lock_guard lock(mutex);
  EXPECT_EQ(different, 0U);
}

std::string name(const testing::TestParamInfo<Pairing>& info) {
  const auto part = [](Vendor vendor) { return vendor == Vendor::kFast ? "Fast" : "Cyclone"; };
  return std::string(part(info.param.writer)) + "To" + part(info.param.reader);
}

const auto kAllPairings =
    testing::Values(Pairing{Vendor::kFast, Vendor::kFast}, Pairing{Vendor::kFast, Vendor::kCyclone},
                    Pairing{Vendor::kCyclone, Vendor::kFast}, Pairing{Vendor::kCyclone, Vendor::kCyclone});
INSTANTIATE_TEST_SUITE_P(AllPairings, WireContract, kAllPairings, name);
INSTANTIATE_TEST_SUITE_P(AllPairings, LanContract, kAllPairings, name);

}  // namespace
}  // namespace omentum::transport
