// OpenBLAS with the kernels of the processor at hand.
#pragma once

#include <string>

namespace omentum::organ_tools {

/// Where OpenBLAS does not know the processor and chose kernels that leave its vector unit idle, starts the
/// program anew with OPENBLAS_CORETYPE, which counts only before the library is loaded. Does nothing where
/// that variable is set: a person's choice stands, and there is no second time. To be called first in main.
void start_with_fast_blas(char** argv);

/// Says that it happened, in a line; empty when it did not.
std::string fast_blas_note();

}  // namespace omentum::organ_tools
