#include "runtime/niceness.h"

#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

namespace omentum::runtime {

bool take_nice(int value) noexcept {
  if (setpriority(PRIO_PROCESS, 0, value) != 0) return false;  // on Linux 0 is the calling thread
  // nobody else is of a session that this process began
  if (value < 0 && getsid(0) == getpid()) std::ofstream("/proc/self/autogroup") << value;
  return true;
}

}  // namespace omentum::runtime
