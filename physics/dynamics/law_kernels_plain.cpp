#include "physics/dynamics/law_kernel_table.h"

namespace omentum::physics::kernels {

constinit const LawKernels kPlainLawKernels = law_kernels_named("plain");

}  // namespace omentum::physics::kernels
