#include "physics/dynamics/law_kernel_table.h"

namespace omentum::physics::kernels {

constinit const LawKernels kAvx512LawKernels = law_kernels_named("AVX-512");

}  // namespace omentum::physics::kernels
