// One table of kernels for each vector unit: the file that includes this compiles them for its own.
#pragma once

#include "physics/dynamics/corotational_loops.h"
#include "physics/dynamics/spring_loops.h"

namespace omentum::physics::kernels {

namespace {

consteval LawKernels law_kernels_named(const char* unit) {
  return {unit,
          add_corotational_forces,
          corotational_energy,
          linearize_corotational,
          add_corotational_product,
          add_spring_forces,
          spring_energy};
}

}  // namespace

}  // namespace omentum::physics::kernels
