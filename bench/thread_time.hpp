// The clock of the step benchmarks: CPU time of the calling thread, and the shortest of the stretches into which a run of equal steps is cut.
#pragma once
#include <algorithm>
#include <cstdint>
#include <ctime>
#include <limits>

namespace heerk_rotor {

inline double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Other guests of the machine slow it down for moments that are longer than a stretch of 0.2 ms, so that the shortest one tells what the machine can do.
class ShortestStretch {
 public:
  /// seconds_per_step: about, for the number of steps between two looks at the clock.
  explicit ShortestStretch(double seconds_per_step) : steps_(std::max<std::int64_t>(1, static_cast<std::int64_t>(2e-4 / seconds_per_step))) { begin(); }

  /// Forgets the stretch that has begun: something other than a step took time.
  void begin() {
    done_ = 0;
    begin_ = threadSeconds();
  }
  void step() {
    if (++done_ < steps_) return;
    const double now = threadSeconds();
    shortest_ = std::min(shortest_, (now - begin_) / static_cast<double>(steps_));
    begin_ = now;
    done_ = 0;
  }
  double microsecondsPerStep() const { return 1e6 * shortest_; }

 private:
  std::int64_t steps_, done_ = 0;
  double begin_ = 0.0, shortest_ = std::numeric_limits<double>::infinity();
};

}  // namespace heerk_rotor
