#include "physics/dynamics/corotational_loops.h"
#include "physics/dynamics/spring_loops.h"

namespace omentum::physics::kernels {

constinit const LawKernels kPlainLawKernels{"plain",
                                            add_corotational_forces,
                                            corotational_energy,
                                            linearize_corotational,
                                            add_corotational_product,
                                            add_spring_forces,
                                            spring_energy};

}  // namespace omentum::physics::kernels
