#pragma once
#include "heerk_rotor/core/coupled_system.hpp"
#include "heerk_rotor/realtime/latest_value.hpp"
#include "heerk_rotor/ros/warning_throttle.hpp"

namespace heerk_rotor {

/// Where commands for the rotor speed enter, if a drive takes them: checked here, then handed to the step thread without
/// making it wait. The newest one counts and holds until the next: a rotor without a governor's commands keeps its speed.
class SpeedInput {
 public:
  /// Finds the command whose name ends in ".speed" with its range (what the drive calls min_speed and max_speed).
  /// Throws std::invalid_argument when there are two.
  explicit SpeedInput(const CoupledSystem& system);

  bool present() const { return entry_ >= 0; }
  /// Entry of w, or -1.
  Index entry() const { return entry_; }

  /// One thread at a time, not the step thread. Refuses what is not finite, clamps what is out of range; either with a
  /// warning, at most once a second each. Returns whether the command [rad/s] was taken.
  bool accept(double speed);

  /// Step thread: true when there is a new command.
  bool take(double& speed) noexcept { return latest_.read(speed); }

 private:
  Index entry_ = -1;
  double low_ = 0.0, high_ = 0.0;  // [rad/s]
  LatestValue<double> latest_;
  WarningThrottle refusals_, clampings_;
};

}  // namespace heerk_rotor
