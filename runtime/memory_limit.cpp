#include "runtime/memory_limit.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

namespace omentum::runtime {
namespace {

// No number ("max", or no such file) is no limit.
std::uint64_t limit_in(const std::filesystem::path& file, std::uint64_t otherwise) {
  std::uint64_t bytes = 0;
  return std::ifstream(file) >> bytes ? bytes : otherwise;
}

// The least limit of a group and of those above it. In a container the mount may begin below the path that
// the kernel names: then only the mount's own file is there.
std::uint64_t limit_of(const std::filesystem::path& mount, std::filesystem::path group, const char* name,
                       std::uint64_t machine_bytes) {
  std::uint64_t least = limit_in(mount / name, machine_bytes);
  for (; group.has_relative_path(); group = group.parent_path())
    least = std::min(least, limit_in(mount / group.relative_path() / name, machine_bytes));
  return std::min(least, machine_bytes);
}

bool names_memory(std::string_view controllers) {
  while (!controllers.empty()) {
    const std::size_t end = std::min(controllers.find(','), controllers.size());
    if (controllers.substr(0, end) == "memory") return true;
    controllers.remove_prefix(std::min(end + 1, controllers.size()));
  }
  return false;
}

}  // namespace

std::uint64_t memory_limit_bytes(const std::filesystem::path& root, std::uint64_t machine_bytes) {
  const std::filesystem::path groups = root / "sys/fs/cgroup";
  std::uint64_t least = machine_bytes;
  std::ifstream lines(root / "proc/self/cgroup");
  // NUMBER:CONTROLLERS:PATH; version 2 has number 0 and no controllers
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1),
                      path = line.substr(second + 1);
    if (controllers.empty()) {
      least = std::min(least, limit_of(groups, path, "memory.max", machine_bytes));
    } else if (names_memory(controllers)) {
      least = std::min(least, limit_of(groups / "memory", path, "memory.limit_in_bytes", machine_bytes));
    }
  }
  return least;
}

std::uint64_t memory_limit_bytes() {
  const auto pages = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES));
  return memory_limit_bytes("/", pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
}

bool may_stay_in_memory(std::uint64_t bytes, std::uint64_t limit_bytes) {
  return bytes <= limit_bytes / 2;
}

}  // namespace omentum::runtime
