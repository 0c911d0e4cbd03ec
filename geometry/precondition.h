// What a caller owes a function, also in release builds: where breaking it would write or read past memory.
#pragma once

namespace omentum::geometry {

/// Ends the process with the place and what was expected there. A node that ends takes its force away (a
/// device lets it decay); one that goes on with foreign memory may exert anything.
[[noreturn]] void broken_precondition(const char* what, const char* file, int line) noexcept;

/// For programming errors only; wrong input is refused with an exception. Costs a comparison. `file` and
/// `line` are the caller's (std::source_location, which clang 14 lacks).
inline void require(bool holds, const char* what, const char* file = __builtin_FILE(),
                    int line = __builtin_LINE()) noexcept {
  if (!holds) [[unlikely]]
    broken_precondition(what, file, line);
}

}  // namespace omentum::geometry
