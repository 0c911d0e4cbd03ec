#include "physics/dynamics/law_kernel_table.h"

namespace omentum::physics::kernels {

constinit const LawKernels kAvx2LawKernels = law_kernels_named("AVX2");

}  // namespace omentum::physics::kernels
