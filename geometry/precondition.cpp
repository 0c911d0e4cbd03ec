#include "geometry/precondition.h"

#include <cstdio>
#include <cstdlib>

namespace omentum::geometry {

void broken_precondition(const char* what, const std::source_location& where) noexcept {
  std::fprintf(stderr, "%s:%u: %s: expected %s\n", where.file_name(), static_cast<unsigned>(where.line()),
               where.function_name(), what);
  std::abort();
}

}  // namespace omentum::geometry
