#include "runtime/niceness.h"

#include <sys/resource.h>

namespace omentum::runtime {

bool take_nice(int value) noexcept {
  return setpriority(PRIO_PROCESS, 0, value) == 0;  // on Linux 0 is the calling thread, not its process
}

}  // namespace omentum::runtime
