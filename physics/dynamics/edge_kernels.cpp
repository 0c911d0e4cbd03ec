#include "physics/dynamics/edge_kernels.h"

#include <array>

namespace omentum::physics::kernels {

namespace {

#ifdef OMENTUM_X86_KERNELS
constexpr std::array<EdgeKernel, 3> kKernels{
    {{"AVX-512", edge_forces_avx512}, {"AVX2", edge_forces_avx2}, {"plain", edge_forces_plain}}};

// Kernels at the head of the list that this processor lacks.
std::size_t missing() {
  const bool fused = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (!fused) return 2;
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") ? 0 : 1;
}
#else
constexpr std::array<EdgeKernel, 1> kKernels{{{"plain", edge_forces_plain}}};

std::size_t missing() {
  return 0;
}
#endif

}  // namespace

std::span<const EdgeKernel> edge_kernels() noexcept {
  static const std::span<const EdgeKernel> runnable = std::span(kKernels).subspan(missing());
  return runnable;
}

}  // namespace omentum::physics::kernels
