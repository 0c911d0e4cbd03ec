// Fast DDS on machines whose shared memory is small, full, read-only, or another user's.
#include "transport/fast/shared_memory.h"

#include "tests/support/shared_memory_folder.h"
#include "tests/transport/peer_process.h"
#include "transport/bus.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <latch>
#include <thread>

namespace omentum::transport {
namespace {

namespace fs = std::filesystem;
using test::eventually;
using test::PeerLife;
using test::PeerProcess;
using test::SharedMemoryFolder;

/// Whether the peer "answers" hears our poses and we hear its answers and its statuses.
bool is_answered(Bus& bus) {
  std::atomic<std::uint64_t> answered{0}, ticks{0};
  const auto forces =
      bus.reader<msg::ToolForce>([&](const msg::ToolForce& force) { answered = force.echo_seq; });
  const auto statuses =
      bus.reader<msg::NodeStatus>([&](const msg::NodeStatus& status) { ticks = status.ticks; });
  const auto poses = bus.writer<msg::ToolPose>();
  msg::ToolPose pose;
  return eventually([&] {
    ++pose.seq;
    poses->write(pose);
    return answered > 0 && ticks > 0;
  });
}

std::ptrdiff_t count_of(const std::string& text, char letter) {
  return std::count(text.begin(), text.end(), letter);
}

std::size_t segments_in(const fs::path& folder) {
  constexpr std::size_t kNameOfASegment = 25;  // "fastrtps_" and 16 digits
  const fs::directory_iterator files(folder);
  return static_cast<std::size_t>(
      std::count_if(begin(files), end(files), [](const fs::directory_entry& file) {
        const std::string name = file.path().filename();
        return name.starts_with("fastrtps_") && name.size() == kNameOfASegment;
      }));
}

class SmallSharedMemory : public testing::Test {
 protected:
  void SetUp() override {
    if (!SharedMemoryFolder::is_permitted()) GTEST_SKIP() << SharedMemoryFolder::kNotPermitted;
  }

  std::unique_ptr<PeerProcess> peer(const PeerLife& life = {}) const {
    return std::make_unique<PeerProcess>("answers", Vendor::kFast, domain, Profile::kLoopback, life);
  }
  std::unique_ptr<Bus> open() const {
    return Bus::open({.vendor = Vendor::kFast, .domain = domain, .name = "shared_memory_test"});
  }
  // at most a line, without colours: a test before this one may have made this process tell it
  static void expect_plain(const std::string& told) {
    EXPECT_LE(count_of(told, '\n'), 1) << told;
    EXPECT_EQ(count_of(told, '\x1b'), 0) << told;
  }
  /// A peer and we hear each other, and the peer has told one plain line, of UDP.
  void expect_udp_and_one_line() const {
    const test::ScratchFolder folder;
    const auto answers = peer({.messages_to = folder / "messages"});
    testing::internal::CaptureStderr();
    EXPECT_TRUE(is_answered(*open()));
    const std::string ours = testing::internal::GetCapturedStderr();
    EXPECT_EQ(answers->end(), 0);
    const std::string its = test::read_text(folder / "messages");
    expect_plain(ours);
    expect_plain(its);
    EXPECT_NE(its.find("UDP"), std::string::npos) << its;
  }

  int domain = test::domain_of_test();
};

// what Docker gives a container
TEST_F(SmallSharedMemory, ASessionOfFourLivesInSixtyFourMegabytes) {
  const SharedMemoryFolder folder("size=64m");
  std::vector<std::unique_ptr<PeerProcess>> session;
  for (int node = 0; node < 4; ++node) session.push_back(peer());
  EXPECT_TRUE(is_answered(*open()));
  EXPECT_EQ(segments_in(SharedMemoryFolder::kPath), session.size());
  for (const auto& node : session) EXPECT_EQ(node->end(), 0);
}

TEST_F(SmallSharedMemory, WhereNothingFitsAllGoesOverUdpAndThatIsToldOnce) {
  const SharedMemoryFolder folder("size=4m");
  expect_udp_and_one_line();
}

TEST_F(SmallSharedMemory, WhereItIsReadOnlyAllGoesOverUdpAndThatIsToldOnce) {
  const SharedMemoryFolder folder("size=64m", MS_RDONLY);
  expect_udp_and_one_line();
}

TEST_F(SmallSharedMemory, OfThoseThatStartTogetherNoneTakesTheOthersRoom) {
  const SharedMemoryFolder folder("size=20m");
  std::vector<std::unique_ptr<PeerProcess>> session(6);
  // a peer ends with the thread that started it
  std::latch all_started(std::ssize(session)), is_over(1);
  std::vector<std::jthread> starts;
  for (auto& node : session)
    starts.emplace_back([&] {
      node = peer();
      all_started.count_down();
      is_over.wait();
    });
  all_started.wait();
  EXPECT_TRUE(is_answered(*open()));
  for (const auto& node : session) EXPECT_EQ(node->end(), 0);
  is_over.count_down();
}

TEST_F(SmallSharedMemory, WhatTheKilledLeftIsRoomForTheNext) {
  const SharedMemoryFolder folder("size=24m");
  for (int turn = 0; turn < 4; ++turn) peer()->kill_it();
  EXPECT_EQ(segments_in(SharedMemoryFolder::kPath), 1U);
  const auto answers = peer();
  EXPECT_TRUE(is_answered(*open()));
  EXPECT_EQ(segments_in(SharedMemoryFolder::kPath), 1U);
  EXPECT_EQ(answers->end(), 0);
}

// containers of one network (docker run --network host), each with its own shared memory
TEST_F(SmallSharedMemory, AProcessWithOneOfItsOwnIsHeard) {
  const SharedMemoryFolder folder("size=64m");
  const auto answers = peer({.has_own_shared_memory = true});
  EXPECT_TRUE(is_answered(*open()));
}

/// Whose process starts first: root's or the other's.
class TwoUsers : public SmallSharedMemory, public testing::WithParamInterface<bool> {};

TEST_P(TwoUsers, HearEachOther) {
  constexpr uid_t kNobody = 65534;
  const SharedMemoryFolder folder("size=64m");
  std::unique_ptr<PeerProcess> answers;
  std::unique_ptr<Bus> bus;
  const auto start_other = [&] { answers = peer({.user = kNobody}); };
  try {
    if (!GetParam()) start_other();
    bus = open();
    if (GetParam()) start_other();
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << "another user cannot run the build's programs: " << error.what();
  }
  EXPECT_TRUE(is_answered(*bus));
}

INSTANTIATE_TEST_SUITE_P(OfOneMachine, TwoUsers, testing::Bool(),
                         [](const auto& info) { return info.param ? "RootFirst" : "RootSecond"; });

/// A folder in the place of /dev/shm.
class SharedMemoryFiles : public testing::Test {
 protected:
  void make(const std::string& name) const { std::ofstream(folder_ / name) << "x"; }
  void make_all_of(const std::string& name) const {
    for (const std::string& file : {name, "sem." + name + "_mutex", name + "_el"}) make(file);
  }
  bool exists(const std::string& name) const { return fs::exists(folder_ / name); }

  test::ScratchFolder folder_;
  fast::SharedMemory memory{folder_.path()};
};

constexpr const char* kSegment = "fastrtps_0123456789abcdef";
constexpr const char* kPort = "fastrtps_port7410";

TEST_F(SharedMemoryFiles, WhatNobodyUsesGoesAndWhatIsNoneOfFastsStays) {
  for (const char* name : {kSegment, kPort}) make_all_of(name);
  const auto others = {"fastrtps_0123", "fastrtps_portal", "sem.somebody_mutex", "somebody_el"};
  for (const char* name : others) make(name);
  memory.remove_leftovers();
  for (const std::string name : {kSegment, kPort})
    for (const std::string& file : {name, "sem." + name + "_mutex", name + "_el"})
      EXPECT_FALSE(exists(file)) << file;
  for (const char* name : others) EXPECT_TRUE(exists(name)) << name;
}

TEST_F(SharedMemoryFiles, WhatSomebodyHasOpenStays) {
  make_all_of(kSegment);
  const int used = open((folder_ / kSegment).c_str(), O_RDWR);
  memory.remove_leftovers();
  EXPECT_TRUE(exists(kSegment));
  close(used);
  memory.remove_leftovers();
  EXPECT_FALSE(exists(kSegment));
}

TEST_F(SharedMemoryFiles, WhoseLockIsHeldStays) {
  make_all_of(kPort);
  const int held = open((folder_ / (std::string(kPort) + "_el")).c_str(), O_RDONLY);
  ASSERT_EQ(flock(held, LOCK_EX), 0);
  EXPECT_TRUE(memory.reaches(7410));
  memory.remove_leftovers();
  EXPECT_TRUE(exists(kPort));
  close(held);
  EXPECT_FALSE(memory.reaches(7410));
}

TEST_F(SharedMemoryFiles, TheRoomThatIsNeededIsNamed) {
  EXPECT_EQ(memory.obstacle(0, 1), "");
  constexpr std::uint64_t kMoreThanAnybodyHas = std::uint64_t{1} << 60U;
  EXPECT_NE(memory.obstacle(0, kMoreThanAnybodyHas).find("1099511627776 MB are needed"), std::string::npos);
  EXPECT_NE(fast::SharedMemory("/nowhere").obstacle(0, 1).find("/nowhere cannot be written to"),
            std::string::npos);
}

TEST_F(SharedMemoryFiles, AnotherUsersPortIsInTheWayOfItsDomainOnly) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can make files of another user";
  for (const char* name : {"fastrtps_port7660", "sem.fastrtps_port7911_mutex"}) {
    make(name);
    ASSERT_EQ(chown((folder_ / name).c_str(), 65534, 65534), 0);
  }
  for (const int domain : {0, 3}) EXPECT_EQ(memory.obstacle(domain, 1), "");
  for (const int domain : {1, 2})
    EXPECT_NE(memory.obstacle(domain, 1).find("another user (id 65534)"), std::string::npos);
}

}  // namespace
}  // namespace omentum::transport
