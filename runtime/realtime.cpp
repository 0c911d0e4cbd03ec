#include "runtime/realtime.h"

#include "runtime/memory_limit.h"

#include <cerrno>
#include <cstring>

#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace omentum::runtime {
namespace {

// Under a finite limit the lock may succeed now and make a later allocation fail: then it is not asked for.
bool may_lock_everything() {
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) return true;
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct data[_LINUX_CAPABILITY_U32S_3] = {};
  if (syscall(SYS_capget, &header, data) != 0) return false;
  return (data[CAP_TO_INDEX(CAP_IPC_LOCK)].effective & CAP_TO_MASK(CAP_IPC_LOCK)) != 0;
}

bool request_fifo(int priority, std::string& warning) {
  const sched_param parameters{.sched_priority = priority};
  // the threads that this one starts later do not inherit the priority
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters);
  if (error == 0) return true;
  // ordinary threads' timers may fire 50 us late to save power; 1 ns asks for the hardware's best
  prctl(PR_SET_TIMERSLACK, 1UL);
  warning = "no real-time priority (" + std::string(std::strerror(error)) + "): set 'ulimit -r " +
            std::to_string(priority) + "' (rtprio in limits.conf) or grant CAP_SYS_NICE";
  return false;
}

void add(std::string& warning, const std::string& what) {
  warning += (warning.empty() ? "" : "; ") + what;
}

// A container that is full ends a process; one whose pages are locked cannot give any back.
bool fits(std::uint64_t touched_bytes, std::string& warning) {
  const std::uint64_t limit = memory_limit_bytes();
  if (may_stay_in_memory(touched_bytes, limit)) return true;
  add(warning, "memory is not locked: the organ's " + std::to_string(touched_bytes >> 20) +
                   " MiB are more than half of the " + std::to_string(limit >> 20) +
                   " MiB that there are (of a container: its memory limit)");
  return false;
}

bool request_locked_memory(std::uint64_t touched_bytes, std::string& warning) {
  if (!fits(touched_bytes, warning)) return false;
  // MCL_ONFAULT: locked once touched; locking a mapped organ file as a whole could take all memory
  if (may_lock_everything() && mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0) return true;
  add(warning,
      "memory is not locked: set 'ulimit -l unlimited' (memlock in limits.conf) or grant CAP_IPC_LOCK");
  return false;
}

}  // namespace

RealtimeGrant request_realtime(int priority, std::uint64_t touched_bytes) {
  RealtimeGrant grant;
  grant.fifo = request_fifo(priority, grant.warning);
  grant.locked = request_locked_memory(touched_bytes, grant.warning);
  return grant;
}

RealtimeStart::RealtimeStart(int priority) noexcept {
  pthread_getschedparam(pthread_self(), &policy_, &parameters_);
  const sched_param fifo{.sched_priority = priority};
  pthread_setschedparam(pthread_self(), SCHED_FIFO, &fifo);
}

RealtimeStart::~RealtimeStart() {
  pthread_setschedparam(pthread_self(), policy_, &parameters_);
}

}  // namespace omentum::runtime
