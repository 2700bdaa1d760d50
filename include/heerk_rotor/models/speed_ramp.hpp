#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

/// Rotor speed as a given function of time: constant, or a run-up (run-down) at constant acceleration. Takes the place of `drive`.
///   speed = initial until `start`, then towards final with `acceleration`, then final; angle = integral of (speed - Omega).
/// No states, no inputs. Output: drive (angle, rate, acceleration relative to Omega t), exactly zero at constant nominal speed.
/// The acceleration jumps at both ends of the ramp: a step across one of them is of first order in the acceleration, so that the
/// angle's share of the error is h^2; let both fall on steps where that matters.
class SpeedRamp : public SubsystemModel {
 public:
  struct Parameters {
    double rotor_speed = 0.0;    // Omega [rad/s]
    double initial_speed = 0.0;  // [rad/s]
    double final_speed = 0.0;    // [rad/s]
    double acceleration = 0.0;   // magnitude [rad/s^2], > 0 when the two speeds differ
    double start = 0.0;          // [s]
  };
  explicit SpeedRamp(const Parameters& parameters);

  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override { return {}; }
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  Parameters p_;
  double acceleration_;  // with sign [rad/s^2]
  double duration_;      // of the ramp [s]
};

}  // namespace heerk_rotor
