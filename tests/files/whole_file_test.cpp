#include "files/whole_file.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <stdexcept>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

namespace omentum::files {
namespace {

using testing::HasSubstr;

class WholeFileTest : public testing::Test {
 protected:
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
  }

  void expect_refused(const std::filesystem::path& file, const std::string& reason) const {
    SCOPED_TRACE(file);
    const std::size_t before = files();
    try {
      write_whole(file, "text");
      ADD_FAILURE() << "no exception";
    } catch (const std::runtime_error& e) {
      EXPECT_THAT(e.what(), HasSubstr(file.string()));
      EXPECT_THAT(e.what(), HasSubstr(reason));
    }
    EXPECT_THROW(require_writable(file), std::runtime_error);
    EXPECT_EQ(files(), before);
  }

  test::ScratchFolder folder;
};

TEST_F(WholeFileTest, ReplacesAFileAndLeavesNoDraft) {
  write_whole(folder / "a", "old");
  write_whole(folder / "a", "new");
  EXPECT_EQ(test::read_text(folder / "a"), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(WholeFileTest, WhetherAFileCanBeWrittenIsToldWithoutATrace) {
  write_whole(folder / "a", "old");
  require_writable(folder / "a");
  require_writable(folder / "b");
  EXPECT_EQ(test::read_text(folder / "a"), "old");
  EXPECT_EQ(files(), 1u);
  expect_refused(folder / "nowhere/a", "No such file or directory");
}

TEST_F(WholeFileTest, WhatIsNoRegularFileStaysWhatItIs) {
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(folder / "folder");
  const int listener = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{AF_UNIX, {}};
  (folder / "socket").string().copy(address.sun_path, sizeof address.sun_path - 1);
  ASSERT_EQ(bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  std::filesystem::create_symlink("/dev/null", folder / "link");

  expect_refused(folder / "pipe", "a pipe");
  expect_refused(folder / "folder", "a folder");
  expect_refused(folder / "socket", "a socket");
  expect_refused(folder / "link", "a device");
  expect_refused("/dev/null", "a device");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  close(listener);
}

TEST_F(WholeFileTest, ALinkStaysOneAndItsEndIsReplaced) {
  std::filesystem::create_directory(folder / "far");
  std::filesystem::create_symlink("second", folder / "first");
  std::filesystem::create_symlink("far/end", folder / "second");
  write_whole(folder / "first", "text");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "first"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "second"));
  EXPECT_EQ(test::read_text(folder / "far" / "end"), "text");
}

TEST_F(WholeFileTest, LinksInACircleAreRefused) {
  std::filesystem::create_symlink("b", folder / "a");
  std::filesystem::create_symlink("a", folder / "b");
  expect_refused(folder / "a", "lead nowhere");
}

// Set in the child that sees a small disk.
constexpr const char* kSmallDisk = "OMENTUM_TEST_SMALL_DISK";

void expect_the_reason_on_a_small_disk() {
  write_whole("/mnt/a", "what was there");
  try {
    write_whole("/mnt/a", std::string(1 << 20, 'x'));
    FAIL() << "no exception";
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("/mnt/a: cannot be written: No space left"));
  }
  EXPECT_EQ(test::read_text("/mnt/a"), "what was there");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator("/mnt"), {}), 1);
}

TEST_F(WholeFileTest, AFullDiskIsTheReason) {
  if (std::getenv(kSmallDisk)) return expect_the_reason_on_a_small_disk();
  const std::string mount = "mount -t tmpfs -o size=64k none /mnt";
  if (test::Process("/usr/bin/unshare", {"-m", "sh", "-c", mount}).wait() != 0)
    GTEST_SKIP() << "no mount namespaces here";
  // a child in a namespace of its own: the file system is gone with it
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string test = self + " --gtest_filter=WholeFileTest.AFullDiskIsTheReason";
  test::Process child("/usr/bin/unshare",
                      {"-m", "sh", "-c", mount + " && " + kSmallDisk + "=1 exec " + test});
  EXPECT_EQ(child.wait(), 0) << child.output();
}

}  // namespace
}  // namespace omentum::files
