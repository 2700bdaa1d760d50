#include "heerk_rotor/realtime/clock.hpp"

#include <cerrno>
#include <ctime>

namespace heerk_rotor {
namespace {
constexpr std::int64_t kSecond = 1000000000;
}

std::int64_t MonotonicClock::now() noexcept {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * kSecond + time.tv_nsec;
}

void MonotonicClock::sleepUntil(std::int64_t nanoseconds) noexcept {
  timespec time;
  time.tv_sec = nanoseconds / kSecond;
  time.tv_nsec = nanoseconds % kSecond;
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
  }
}

}  // namespace heerk_rotor
