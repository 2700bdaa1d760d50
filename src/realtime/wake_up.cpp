#include "heerk_rotor/realtime/wake_up.hpp"

#include <cerrno>
#include <ctime>

namespace heerk_rotor {

timespec WakeUp::monotonicIn(std::chrono::nanoseconds timeout) noexcept {
  constexpr long long kSecond = 1000000000;
  timespec end;
  clock_gettime(CLOCK_MONOTONIC, &end);
  const long long nanoseconds = end.tv_nsec + timeout.count();
  end.tv_sec += nanoseconds / kSecond;
  end.tv_nsec = nanoseconds % kSecond;
  return end;
}

bool WakeUp::sleep(const timespec& end) noexcept {
  for (;;) {
    if (sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &end) == 0) return true;
    if (errno != EINTR) return false;
  }
}

}  // namespace heerk_rotor
