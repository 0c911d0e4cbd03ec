#include "runtime/room.h"

#include <sys/mman.h>

#include <exception>
#include <latch>
#include <thread>
#include <vector>

namespace omentum::runtime {
namespace {

bool has_addresses(std::size_t bytes) noexcept {
  if (bytes == 0) return true;
  void* const place =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED) return false;
  munmap(place, bytes);
  return true;
}

}  // namespace

bool has_room(const Room& room) noexcept {
  std::latch end(1);
  bool enough = false;
  std::vector<std::jthread> threads;
  try {
    for (int i = 0; i < room.threads; ++i) threads.emplace_back([&end] { end.wait(); });
    enough = has_addresses(room.bytes);
  } catch (const std::exception&) {
    enough = false;  // a thread was refused
  }
  end.count_down();
  return enough;
}

}  // namespace omentum::runtime
