#include "physics/dynamics/law_kernels.h"

#include <cstddef>

namespace omentum::physics::kernels {

namespace {

#ifdef OMENTUM_X86_KERNELS
constexpr const LawKernels* kKernels[] = {&kAvx512LawKernels, &kAvx2LawKernels, &kPlainLawKernels, nullptr};

// Kernels at the head of the list that this processor lacks.
std::size_t missing() {
  const bool fused = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (!fused) return 2;
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") ? 0 : 1;
}
#else
constexpr const LawKernels* kKernels[] = {&kPlainLawKernels, nullptr};

std::size_t missing() {
  return 0;
}
#endif

}  // namespace

const LawKernels* const* law_kernels() noexcept {
  static const LawKernels* const* const runnable = kKernels + missing();
  return runnable;
}

}  // namespace omentum::physics::kernels
