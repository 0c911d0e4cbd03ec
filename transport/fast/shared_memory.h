// The folder in which Fast DDS shares memory: whether it can be used, and what the dead left in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace omentum::transport::fast {

/// Fast DDS makes a segment and ports (files of mode 0644) in /dev/shm. It looks neither at the space, so
/// that a full folder ends it with SIGBUS, nor at who owns what others have made, so that processes of two
/// users hear nothing of each other. Hence we look. Const methods; any thread.
class SharedMemory {
 public:
  /// How every mark begins.
  static constexpr const char* kMark = "omentum/shared_memory/";

  explicit SharedMemory(std::filesystem::path folder = "/dev/shm") : folder_(std::move(folder)) {}

  /// Removes every segment and port that no living process uses, where the permissions allow it. A process
  /// lives when it has the file open or mapped for writing, which the kernel knows (F_SETLEASE), also of
  /// processes in other containers and of those that Fast DDS' own lock files say nothing of.
  void remove_leftovers() const;

  /// Why a process of this user should not use it in this domain; empty when nothing speaks against it.
  /// bytes: what it is going to need.
  std::string obstacle(int domain, std::uint64_t bytes) const;

  /// What tells this folder and user from every other on this machine: equal for those who can share memory.
  std::string mark() const;

  /// Whether somebody listens at this port whom we reach: he lives, in this folder, as our user.
  bool reaches(std::uint32_t port) const;

 private:
  std::string lack_of_space(std::uint64_t bytes) const;
  std::string other_user(int domain) const;
  bool remove_dead(const std::string& name) const;

  std::filesystem::path folder_;
};

/// The right to look and then to make one's segment, of one process of the machine at a time: of two that
/// start together both would find the same space free. Waits for a turn, but not for ever: who holds it may
/// be stopped.
class SharedMemoryTurn {
 public:
  explicit SharedMemoryTurn(const std::filesystem::path& folder = "/dev/shm");
  ~SharedMemoryTurn();
  SharedMemoryTurn(const SharedMemoryTurn&) = delete;
  SharedMemoryTurn& operator=(const SharedMemoryTurn&) = delete;

 private:
  int folder_;
};

}  // namespace omentum::transport::fast
