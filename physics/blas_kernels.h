// Whether OpenBLAS found kernels that use what the processor has.
#pragma once

#include <optional>
#include <string>

namespace omentum::physics {

/// The widest vector unit of a processor that dense algebra profits from; each includes those before it.
enum class VectorUnit {
  kSse,
  kAvx,
  kAvx2,    // with fused multiply-add
  kAvx512,  // F, CD, BW, DQ and VL: what OpenBLAS's SkylakeX kernels need
};

/// Of this processor, as far as the system lets programs use it (cpuid, xgetbv). Any thread.
VectorUnit vector_unit();

/// The core of its table that OpenBLAS chose for this processor, e.g. "SkylakeX".
std::string blas_core();

/// The core to ask OpenBLAS for (OPENBLAS_CORETYPE) on a processor with `unit` where it `chose` by itself;
/// none where its choice uses that unit. OpenBLAS knows processors by family and model: one that is newer
/// than itself gets old kernels (0.3.21: Prescott, without AVX, on family 6 model 207), several times slower.
std::optional<std::string> better_blas_core(VectorUnit unit, const std::string& chose);

}  // namespace omentum::physics
