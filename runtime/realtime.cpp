#include "runtime/realtime.h"

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

bool request_locked_memory(std::string& warning) {
  // MCL_ONFAULT: locked once touched; locking a mapped organ file as a whole could take all memory
  if (may_lock_everything() && mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0) return true;
  warning += std::string(warning.empty() ? "" : "; ") +
             "memory is not locked: set 'ulimit -l unlimited' (memlock in limits.conf) or grant CAP_IPC_LOCK";
  return false;
}

}  // namespace

RealtimeGrant request_realtime(int priority) {
  RealtimeGrant grant;
  grant.fifo = request_fifo(priority, grant.warning);
  grant.locked = request_locked_memory(grant.warning);
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
