#include "tests/device_bridge/heap_count.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> uses{0};
}

long omentum::test::heap_uses() {
  return uses;
}

void* operator new(std::size_t size) {
  ++uses;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
