// OpenBLAS with the kernels of the processor at hand.
#pragma once

namespace omentum::organ_tools {

/// Where OpenBLAS does not know the processor and chose kernels that leave its vector unit idle, starts the
/// program anew with OPENBLAS_CORETYPE, which counts only before the library is loaded. Does nothing where
/// that variable is set: a person's choice stands, and there is no second time. To be called first in main.
void start_with_fast_blas(char** argv);

/// Ends the program with exit code 2 and a line where the system does not give OpenBLAS the memory that it
/// takes for itself, which it would wait for without end. `callers`: threads of ours that call it at a time.
/// After start_with_fast_blas.
void require_blas_memory(const char* program, int callers);

/// Says that it happened, in a line on stderr; nothing when it did not. To be called once the work is done: a
/// refusal is one line.
void tell_fast_blas(const char* program);

}  // namespace omentum::organ_tools
