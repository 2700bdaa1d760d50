// CPU time of the calling thread, and the shortest of the stretches into which a run of steps is cut.
#pragma once
#include <algorithm>
#include <ctime>
#include <limits>

namespace heerk_rotor {

inline double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Other guests of the machine slow it down for moments that are longer than a stretch, so that the shortest one tells what the machine can do.
class ShortestStretch {
 public:
  /// steps: between two looks at the clock, enough to average over what differs from step to step.
  explicit ShortestStretch(int steps) : steps_(steps) { begin(); }

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
  int steps_, done_ = 0;
  double begin_ = 0.0, shortest_ = std::numeric_limits<double>::infinity();
};

}  // namespace heerk_rotor
