#pragma once
#include <cstdint>

namespace heerk_rotor {

/// The clock by which a paced run wakes up; tests put their own in its place.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual std::int64_t now() noexcept = 0;                        // [ns], never goes back
  virtual void sleepUntil(std::int64_t nanoseconds) noexcept = 0; // returns at once when that is over
};

/// CLOCK_MONOTONIC with absolute sleeps.
class MonotonicClock : public Clock {
 public:
  std::int64_t now() noexcept override;
  void sleepUntil(std::int64_t nanoseconds) noexcept override;
};

}  // namespace heerk_rotor
