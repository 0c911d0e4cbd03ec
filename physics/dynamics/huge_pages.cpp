#include "physics/dynamics/huge_pages.h"

#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace omentum::physics {

namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kCacheLine = 64;

}  // namespace

void* take_pages(std::size_t bytes) {
  const std::size_t alignment = bytes >= kHugePage ? kHugePage : kCacheLine;
  void* pages = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (pages == nullptr) throw std::bad_alloc();
  // a wish: without it all is the same, but slower
  if (alignment == kHugePage) (void)madvise(pages, bytes, MADV_HUGEPAGE);
  return pages;
}

void give_pages_back(void* pages) noexcept {
  std::free(pages);
}

}  // namespace omentum::physics
