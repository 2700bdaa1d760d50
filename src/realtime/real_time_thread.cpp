#include "heerk_rotor/realtime/real_time_thread.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace heerk_rotor {
namespace {

/// Touches the stack once, so that no step has to wait for its first page.
__attribute__((noinline)) void touchStack() {
  constexpr std::size_t kBytes = 256 * 1024;
  volatile char stack[kBytes];
  for (std::size_t i = 0; i < kBytes; i += 1024) stack[i] = 0;
  (void)stack[0];
}

bool lockMemory() {
  // Under a finite limit MCL_FUTURE would make later allocations of other threads fail; then only what exists is locked.
  rlimit limit{};
  const bool unlimited = geteuid() == 0 || (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY);
  return mlockall(unlimited ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) == 0;
}

void complain(std::string& complaint, const std::string& what) { complaint += (complaint.empty() ? "" : "; ") + what; }

}  // namespace

RealTimeRights prepareRealTimeThread(int priority) {
  RealTimeRights rights;
  if (priority > 0) {
    sched_param parameter{};
    parameter.sched_priority = priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameter);
    rights.fifo = error == 0;
    if (error != 0)
      complain(rights.complaint, "SCHED_FIFO priority " + std::to_string(priority) + " refused (" + std::strerror(error) +
                                     "): run as root, or allow rtprio in /etc/security/limits.conf");
    rights.memory_locked = lockMemory();
    if (!rights.memory_locked)
      complain(rights.complaint, std::string("locking memory refused (") + std::strerror(errno) +
                                     "): run as root, or raise memlock in /etc/security/limits.conf");
  }
  rights.fine_timers = prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL) == 0;
  touchStack();
  return rights;
}

std::string RealTimeRights::text(int priority) const {
  std::string text = fifo ? "SCHED_FIFO " + std::to_string(priority) : "normal priority";
  text += memory_locked ? ", memory locked" : ", memory not locked";
  text += fine_timers ? ", fine timers" : ", coarse timers";
  return text;
}

}  // namespace heerk_rotor
