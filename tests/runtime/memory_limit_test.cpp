#include "runtime/memory_limit.h"

#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <unistd.h>

namespace omentum::runtime {
namespace {

constexpr std::uint64_t kMachine = 64'000;

/// A system's files, made up.
class MemoryLimit : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) {
    std::filesystem::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text << '\n';
  }
  std::uint64_t limit() const { return memory_limit_bytes(root_.path(), kMachine); }

  test::ScratchFolder root_;
};

TEST_F(MemoryLimit, WithoutGroupsIsTheMachines) {
  EXPECT_EQ(limit(), kMachine);
}

TEST_F(MemoryLimit, UnlimitedGroupsLeaveTheMachines) {
  write("proc/self/cgroup", "3:memory:/a\n0::/a");
  write("sys/fs/cgroup/a/memory.max", "max");
  write("sys/fs/cgroup/memory/a/memory.limit_in_bytes", "9223372036854771712");
  EXPECT_EQ(limit(), kMachine);
}

TEST_F(MemoryLimit, IsTheLeastOfTheGroupAndThoseAboveIt) {
  write("proc/self/cgroup", "0::/slice/session/scope");
  write("sys/fs/cgroup/slice/session/scope/memory.max", "30000");
  write("sys/fs/cgroup/slice/memory.max", "20000");
  write("sys/fs/cgroup/other/memory.max", "10");
  EXPECT_EQ(limit(), 20'000u);
  write("sys/fs/cgroup/slice/session/scope/memory.max", "5000");
  EXPECT_EQ(limit(), 5'000u);
}

TEST_F(MemoryLimit, OfAContainerThatSeesItsOwnGroupAsTheRoot) {
  write("proc/self/cgroup", "0::/");
  write("sys/fs/cgroup/memory.max", "7000");
  EXPECT_EQ(limit(), 7'000u);
  write("proc/self/cgroup", "0::/docker/0123");  // the name outside of it
  EXPECT_EQ(limit(), 7'000u);
}

TEST_F(MemoryLimit, OfVersionOneAlsoBesideOtherControllers) {
  write("proc/self/cgroup", "12:pids:/b\n4:cpu,memory:/docker/a\n1:name=systemd:/c");
  write("sys/fs/cgroup/memory/docker/a/memory.limit_in_bytes", "9000");
  write("sys/fs/cgroup/memory/b/memory.limit_in_bytes", "10");
  EXPECT_EQ(limit(), 9'000u);
}

TEST(OwnMemoryLimit, IsAtMostTheMachines) {
  EXPECT_GT(memory_limit_bytes(), 0u);
  EXPECT_LE(memory_limit_bytes(), static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                                      static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
}

TEST(MayStayInMemory, LeavesRoomForEverybodyElse) {
  EXPECT_TRUE(may_stay_in_memory(500, 1000));
  EXPECT_FALSE(may_stay_in_memory(501, 1000));
}

}  // namespace
}  // namespace omentum::runtime
