#include "physics/blas_kernels.h"

#include <cblas.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace omentum::physics {
namespace {

struct Core {
  std::string_view name;
  VectorUnit unit;
};

// OpenBLAS's x86 cores beyond SSE (dynamic.c of 0.3.21 and its successors); any other has none of these
// units.
constexpr std::array kCores{
    Core{"sandybridge", VectorUnit::kAvx},   Core{"bulldozer", VectorUnit::kAvx},
    Core{"piledriver", VectorUnit::kAvx},    Core{"steamroller", VectorUnit::kAvx},
    Core{"excavator", VectorUnit::kAvx2},    Core{"haswell", VectorUnit::kAvx2},
    Core{"zen", VectorUnit::kAvx2},          Core{"skylakex", VectorUnit::kAvx512},
    Core{"cooperlake", VectorUnit::kAvx512}, Core{"sapphirerapids", VectorUnit::kAvx512},
};

VectorUnit unit_of(std::string core) {
  std::transform(core.begin(), core.end(), core.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto known =
      std::find_if(kCores.begin(), kCores.end(), [&](const Core& c) { return c.name == core; });
  return known == kCores.end() ? VectorUnit::kSse : known->unit;
}

}  // namespace

VectorUnit vector_unit() {
#if defined(__x86_64__)
  const auto avx512 = [] {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
  };
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return avx512() ? VectorUnit::kAvx512 : VectorUnit::kAvx2;
  if (__builtin_cpu_supports("avx")) return VectorUnit::kAvx;
#endif
  return VectorUnit::kSse;  // elsewhere OpenBLAS is left to itself
}

std::string blas_core() {
  return openblas_get_corename();
}

std::optional<std::string> better_blas_core(VectorUnit unit, const std::string& chose) {
  if (unit_of(chose) >= unit) return std::nullopt;
  switch (unit) {
    case VectorUnit::kAvx512:
      return "SkylakeX";
    case VectorUnit::kAvx2:
      return "Haswell";
    case VectorUnit::kAvx:
      return "Sandybridge";
    case VectorUnit::kSse:
      break;
  }
  return std::nullopt;
}

}  // namespace omentum::physics
