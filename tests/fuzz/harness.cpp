#include "tests/fuzz/harness.h"

#include <cstdio>
#include <cstdlib>

namespace omentum::fuzz {

void broken(std::string_view what) {
  std::fprintf(stderr, "fuzz: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

}  // namespace omentum::fuzz
