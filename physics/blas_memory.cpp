#include "physics/blas_memory.h"

#include <cblas.h>
#include <dlfcn.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace omentum::physics {
namespace {

// OpenBLAS's largest buffer on x86-64 with the rounding that it adds, bytes.
constexpr std::size_t kBuffer = (std::size_t{128} << 20) + (std::size_t{1} << 16);
// Beside the buffers: stacks and the heap's first growth, so that what is refused later can still be said.
constexpr std::size_t kRoom = std::size_t{64} << 20;
constexpr int kMostCallers = 64;

// Not in its header, but exported by every OpenBLAS.
using Take = void* (*)(int);
using GiveBack = void (*)(void*);

bool is_there(std::size_t bytes) noexcept {
  void* const place =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (place == MAP_FAILED) return false;
  munmap(place, bytes);
  return true;
}

// Takes a buffer for this thread, too.
void multiply_with_all_threads() {
  constexpr int kSize = 256;  // far above what OpenBLAS does alone
  const std::vector<double> a(kSize * kSize, 1.0);
  std::vector<double> c(kSize * kSize);
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, kSize, kSize, kSize, 1, a.data(), kSize, a.data(),
              kSize, 0, c.data(), kSize);
}

}  // namespace

bool keep_blas_buffers(int callers) noexcept {
  const int count = std::clamp(callers, 1, kMostCallers);
  const auto buffers = static_cast<std::size_t>(openblas_get_num_threads() - 1 + count);
  if (!is_there(buffers * kBuffer + kRoom)) return false;
  const auto take = reinterpret_cast<Take>(dlsym(RTLD_DEFAULT, "blas_memory_alloc"));
  const auto give_back = reinterpret_cast<GiveBack>(dlsym(RTLD_DEFAULT, "blas_memory_free"));
  if (take == nullptr || give_back == nullptr) return true;  // another BLAS, which has its own ways
  // all at once, so that each is another one; given back they stay mapped. A thread of OpenBLAS's own that
  // only starts now would keep one of those: a product that it has to help with waits until it has its
  // buffer.
  std::array<void*, kMostCallers> taken{};
  for (int i = 1; i < count; ++i) taken[static_cast<std::size_t>(i)] = take(0);
  multiply_with_all_threads();
  for (int i = 1; i < count; ++i) give_back(taken[static_cast<std::size_t>(i)]);
  return true;
}

}  // namespace omentum::physics
