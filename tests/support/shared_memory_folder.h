// A /dev/shm of one's own, of any size, as a container has it.
#pragma once

#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <stdexcept>
#include <string>

namespace omentum::test {

/// From its making to its end this thread, the threads and the processes that it starts see a /dev/shm of
/// their own. Nobody else does: it is mounted in a mount namespace of this process, which needs root's
/// rights.
class SharedMemoryFolder {
 public:
  static constexpr const char* kPath = "/dev/shm";

  /// Whether this process may: to be asked in SetUp(), for a test that is skipped otherwise.
  static bool is_permitted() {
    static const bool permitted = mount_here("size=1m") && umount(kPath) == 0;
    return permitted;
  }
  static constexpr const char* kNotPermitted = "a /dev/shm of one's own needs the right to mount (root)";

  /// options: of tmpfs, as "size=64m"; flags: of mount(2), as MS_RDONLY.
  explicit SharedMemoryFolder(const std::string& options, unsigned long flags = 0) {
    if (!mount_here(options.c_str(), flags)) throw std::runtime_error("no tmpfs on /dev/shm");
  }
  ~SharedMemoryFolder() { umount2(kPath, MNT_DETACH); }
  SharedMemoryFolder(const SharedMemoryFolder&) = delete;
  SharedMemoryFolder& operator=(const SharedMemoryFolder&) = delete;

  /// The same without an end, for a process that is about to become another program.
  static bool mount_here(const char* options, unsigned long flags = 0) {
    return unshare(CLONE_NEWNS) == 0 && mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           mount("tmpfs", kPath, "tmpfs", flags, options) == 0 &&
           ((flags & MS_RDONLY) != 0 || chmod(kPath, 01777) == 0);
  }
};

}  // namespace omentum::test
