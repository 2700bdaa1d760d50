#pragma once
#include <chrono>

namespace heerk_rotor {

/// Lets a warning pass once a second of real time. ROS's own throttle counts ROS time, which stands still with a paused /clock.
class WarningThrottle {
 public:
  bool pass() {
    const Clock::time_point now = Clock::now();
    if (last_ != Clock::time_point() && now - last_ < std::chrono::seconds(1)) return false;
    last_ = now;
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_;
};

}  // namespace heerk_rotor
