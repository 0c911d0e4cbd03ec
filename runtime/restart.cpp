#include "runtime/restart.h"

#include <cstdio>
#include <cstdlib>

#include <unistd.h>

namespace omentum::runtime {

void restart_with(const std::string& name, const std::string& value, char** argv) {
  if (std::getenv(name.c_str()) != nullptr) return;
  std::fflush(nullptr);
  setenv(name.c_str(), value.c_str(), 1);
  execv("/proc/self/exe", argv);
}

}  // namespace omentum::runtime
