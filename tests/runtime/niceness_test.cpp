#include "runtime/niceness.h"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <string>
#include <thread>

#include <linux/capability.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace omentum::runtime {
namespace {

int own_nice() {
  return getpriority(PRIO_PROCESS, 0);
}

// As an ordinary user's thread. Capabilities belong to the thread, limits to the process.
bool take_nice_without_rights(int value) {
  rlimit before{};
  getrlimit(RLIMIT_NICE, &before);
  const rlimit none{0, before.rlim_max};
  setrlimit(RLIMIT_NICE, &none);
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  const __user_cap_data_struct nothing[_LINUX_CAPABILITY_U32S_3] = {};
  syscall(SYS_capset, &header, nothing);
  const bool taken = take_nice(value);
  setrlimit(RLIMIT_NICE, &before);
  return taken;
}

TEST(Niceness, AThreadAndThoseThatItStartsHaveItAndOthersDoNot) {
  const int before = own_nice();
  std::thread([before] {
    ASSERT_TRUE(take_nice(before + 3)) << "being nicer is always permitted";
    EXPECT_EQ(own_nice(), before + 3);
    std::thread([before] { EXPECT_EQ(own_nice(), before + 3); }).join();
  }).join();
  EXPECT_EQ(own_nice(), before);
}

// Of a process that began its session, or none where the kernel has no such shares.
std::optional<int> session_nice_after(int value) {
  constexpr int kOffset = 100, kUnknown = 255;
  const pid_t child = fork();
  if (child == 0) {
    setsid();
    const bool taken = take_nice(value);
    std::ifstream group("/proc/self/autogroup");
    std::string name, word;
    int nice = 0;
    const bool read = static_cast<bool>(group >> name >> word >> nice);  // "/autogroup-77 nice -5"
    _exit(taken && read ? kOffset + nice : kUnknown);
  }
  int status = 0;
  waitpid(child, &status, 0);
  const int code = WEXITSTATUS(status);
  return code == kUnknown ? std::nullopt : std::optional(code - kOffset);
}

TEST(Niceness, ASessionOfItsOwnComesBeforeOthersButNeverBehind) {
  const auto ahead = session_nice_after(kOrganNice), behind = session_nice_after(own_nice() + 3);
  if (!ahead || !behind) GTEST_SKIP() << "no autogroups, or no right to come before others";
  EXPECT_EQ(*ahead, kOrganNice);
  EXPECT_EQ(*behind, 0);
}

TEST(Niceness, WhoMayNotComeFirstStaysWhereItIs) {
  const int before = own_nice();
  std::thread([before] {
    EXPECT_FALSE(take_nice_without_rights(before - 1));
    EXPECT_EQ(own_nice(), before);
  }).join();
}

TEST(Niceness, TheHandComesBeforeTheOrganAndThatBeforeOthersAndThePictureLast) {
  static_assert(kHandNice < kOrganNice && kOrganNice < 0 && kPictureNice > 0);
  std::thread([] {
    const bool taken = take_nice(kOrganNice);
    EXPECT_EQ(own_nice() == kOrganNice, taken);
  }).join();
}

}  // namespace
}  // namespace omentum::runtime
