#include "transport/fast/shared_memory.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace omentum::transport::fast {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "fastrtps_", kPort = "fastrtps_port";
constexpr std::string_view kSemaphore = "sem.", kMutex = "_mutex";
// A listener holds flock() on the first, the only one of a port or segment, or on the second, one of several.
constexpr std::array<std::string_view, 2> kLocks{"_el", "_sl"};

bool all_of(std::string_view text, bool (*accepts)(char)) {
  return !text.empty() && std::all_of(text.begin(), text.end(), accepts);
}

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

bool is_hex_digit(char letter) {
  return is_digit(letter) || (letter >= 'a' && letter <= 'f');
}

// A segment "fastrtps_0123456789abcdef" or a port "fastrtps_port7410".
bool is_segment_or_port(std::string_view name) {
  constexpr std::size_t kSegmentDigits = 16;
  if (name.starts_with(kPort)) return all_of(name.substr(kPort.size()), is_digit);
  return name.starts_with(kPrefix) && name.size() == kPrefix.size() + kSegmentDigits &&
         all_of(name.substr(kPrefix.size()), is_hex_digit);
}

// The number of the port that a file belongs to: the port's own, its mutex or a lock.
std::optional<long> port_of(std::string_view name) {
  if (name.starts_with(kSemaphore)) name.remove_prefix(kSemaphore.size());
  if (!name.starts_with(kPort)) return {};
  name.remove_prefix(kPort.size());
  const std::string_view digits = name.substr(0, std::min(name.find('_'), name.size()));
  constexpr std::size_t kMostDigits = 6;
  if (!all_of(digits, is_digit) || digits.size() > kMostDigits) return {};
  return std::stol(std::string(digits));
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator file(folder, error), end; !error && file != end; file.increment(error))
    names.push_back(file->path().filename().string());
  return names;
}

/// A file that is open, or not.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& path)
      : descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW)) {}
  ~OpenFile() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  OpenFile(OpenFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  OpenFile& operator=(OpenFile&&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  bool lock(int kind) const { return flock(descriptor_, kind | LOCK_NB) == 0; }
  /// Whether somebody has it open or mapped for writing, or one cannot know. As long as nobody has, whoever
  /// opens it waits until this object ends.
  bool is_used() const {
    // the signal to tell us of those who wait: by default it is one that ends the process
    return fcntl(descriptor_, F_SETSIG, SIGURG) != 0 || fcntl(descriptor_, F_SETLEASE, F_RDLCK) != 0;
  }

 private:
  int descriptor_;
};

std::string megabytes(std::uint64_t bytes) {
  return std::to_string(bytes >> 20U) + " MB";
}

}  // namespace

void SharedMemory::remove_leftovers() const {
  for (const std::string& name : names_in(folder_))
    if (is_segment_or_port(name)) remove_dead(name);
}

bool SharedMemory::remove_dead(const std::string& name) const {
  const std::string mutex = std::string(kSemaphore) + name + std::string(kMutex);
  std::vector<OpenFile> held;
  for (const std::string& part : {name, mutex}) {
    const OpenFile& file = held.emplace_back(folder_ / part);
    if (file.is_open() ? file.is_used() : fs::exists(folder_ / part)) return false;
  }
  for (const std::string_view end : kLocks) {
    const OpenFile& lock = held.emplace_back(folder_ / (name + std::string(end)));
    if (lock.is_open() && !lock.lock(LOCK_EX)) return false;
  }
  // the locks go last: nobody takes the name up before the rest is gone
  std::error_code ignored;
  for (const std::string& part : {name, mutex, name + "_el", name + "_sl"})
    fs::remove(folder_ / part, ignored);
  return true;
}

std::string SharedMemory::obstacle(int domain, std::uint64_t bytes) const {
  if (faccessat(AT_FDCWD, folder_.c_str(), R_OK | W_OK | X_OK, AT_EACCESS) != 0)
    return folder_.string() + " cannot be written to (" + std::strerror(errno) + ")";
  if (std::string lack = lack_of_space(bytes); !lack.empty()) return lack;
  return other_user(domain);
}

std::string SharedMemory::lack_of_space(std::uint64_t bytes) const {
  struct statvfs space {};
  // a tmpfs without a limit says 0 blocks
  if (statvfs(folder_.c_str(), &space) != 0 || space.f_blocks == 0) return {};
  const std::uint64_t free = std::uint64_t{space.f_bavail} * space.f_frsize;
  if (free >= bytes) return {};
  return folder_.string() + " has " + megabytes(free) + " free and " + megabytes(bytes) +
         " are needed (docker run --shm-size)";
}

std::string SharedMemory::other_user(int domain) const {
  constexpr long kFirstPort = 7400, kPortsOfADomain = 250;  // as RTPS numbers them
  const long first = kFirstPort + kPortsOfADomain * domain;
  for (const std::string& name : names_in(folder_)) {
    const std::optional<long> port = port_of(name);
    struct stat file {};
    if (!port || *port < first || *port >= first + kPortsOfADomain) continue;
    if (lstat((folder_ / name).c_str(), &file) == 0 && file.st_uid != geteuid())
      return "another user (id " + std::to_string(file.st_uid) + ") shares memory in this domain";
  }
  return {};
}

std::string SharedMemory::mark() const {
  struct stat folder {};
  stat(folder_.c_str(), &folder);
  return kMark + std::to_string(folder.st_dev) + "/" + std::to_string(folder.st_ino) + "/" +
         std::to_string(geteuid());
}

bool SharedMemory::reaches(std::uint32_t port) const {
  const fs::path path = folder_ / (std::string(kPort) + std::to_string(port) + std::string(kLocks[0]));
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 || status.st_uid != geteuid()) return false;
  const OpenFile lock(path);
  return lock.is_open() && !lock.lock(LOCK_SH);
}

SharedMemoryTurn::SharedMemoryTurn(const fs::path& folder)
    : folder_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  constexpr std::chrono::milliseconds kPause{5};
  constexpr int kPauses = 400;  // 2 s: a participant is made in a hundredth of it
  for (int pause = 0; folder_ >= 0 && pause < kPauses && flock(folder_, LOCK_EX | LOCK_NB) != 0; ++pause)
    std::this_thread::sleep_for(kPause);
}

SharedMemoryTurn::~SharedMemoryTurn() {
  if (folder_ >= 0) close(folder_);
}

}  // namespace omentum::transport::fast
