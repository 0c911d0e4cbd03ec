// Memory for what is read from front to end, again and again.
#pragma once

#include <cstddef>

namespace omentum::physics {

/// `bytes` of memory, at least 64-byte aligned; from 2 MiB on in pages of that size where the system gives
/// them: with pages of 4 KiB a factor of 57 MB is solved with a third slower. Throws std::bad_alloc.
void* take_pages(std::size_t bytes);
void give_pages_back(void* pages) noexcept;

/// The same for a std::vector.
template <class T>
struct HugePages {
  using value_type = T;  // NOLINT(readability-identifier-naming): the standard's name

  HugePages() = default;
  template <class Other>
  HugePages(const HugePages<Other>&) {}

  T* allocate(std::size_t count) { return static_cast<T*>(take_pages(count * sizeof(T))); }
  void deallocate(T* pages, std::size_t) noexcept { give_pages_back(pages); }
  friend bool operator==(HugePages, HugePages) { return true; }
};

}  // namespace omentum::physics
