#include "geometry/precondition.h"

#include <cstdio>
#include <cstdlib>

namespace omentum::geometry {

void broken_precondition(const char* what, const char* file, int line) noexcept {
  std::fprintf(stderr, "%s:%d: expected %s\n", file, line, what);
  std::abort();
}

}  // namespace omentum::geometry
