// The memory that OpenBLAS takes for itself.
#pragma once

namespace omentum::physics {

/// Whether OpenBLAS has its buffers: one for each of its own threads and one for each of `callers` threads
/// that call it at a time, 128 MiB of addresses each, of which it touches little. They stay its own, so that
/// no later call of it has to ask for one: it asks again without end where the system gives none. To be
/// called early, by the only thread.
///
/// False: an address-space limit is in the way. OpenBLAS's own threads may then ask for ever, also at exit():
/// end by std::_Exit.
[[nodiscard]] bool keep_blas_buffers(int callers) noexcept;

/// What is to be said then, behind the program's name.
inline constexpr const char* kNoBlasMemory =
    "not enough memory: OpenBLAS needs 128 MiB of addresses for each thread (see ulimit -v)";

}  // namespace omentum::physics
