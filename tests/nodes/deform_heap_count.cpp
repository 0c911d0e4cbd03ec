#include "tests/nodes/deform_heap_count.h"

#include <cstdlib>
#include <new>

namespace {
thread_local std::size_t count = 0;
}

namespace omentum::deform_test {
std::size_t allocations() {
  return count;
}
}  // namespace omentum::deform_test

// apart from its callers, which would inline them and let the compiler doubt that they belong together
void* operator new(std::size_t size) {
  ++count;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
