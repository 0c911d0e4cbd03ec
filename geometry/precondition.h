// What a caller owes a function, also in release builds: where breaking it would write or read past memory.
#pragma once

#include <source_location>

namespace omentum::geometry {

/// Ends the process with file, line and `what` was expected. A node that ends takes its force away (a device
/// lets it decay); one that goes on with foreign memory may exert anything.
[[noreturn]] void broken_precondition(const char* what, const std::source_location& where) noexcept;

/// For programming errors only; wrong input is refused with an exception. Costs a comparison.
inline void require(bool holds, const char* what,
                    const std::source_location& where = std::source_location::current()) noexcept {
  if (!holds) [[unlikely]]
    broken_precondition(what, where);
}

}  // namespace omentum::geometry
