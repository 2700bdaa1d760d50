#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

/// Drive train with a speed command: engine and gearbox follow the command like a second-order filter whose
/// acceleration is limited smoothly. Angles and rates are relative to the nominal drive angle Omega t.
///   z' = wn^2 (speed_command - Omega - rate) - 2 zeta wn z,  rate' = a_max tanh(z / a_max),  angle' = rate
/// States: angle [rad], rate [rad/s], demand z [rad/s^2]. Input: speed_command [rad/s], by default Omega.
/// Output: drive (angle, rate, acceleration), for the mast.
class Drive : public SubsystemModel {
 public:
  struct Parameters {
    double rotor_speed = 0.0;       // Omega [rad/s]
    double frequency = 2.0;         // wn [rad/s]
    double damping_ratio = 1.0;     // zeta [-]
    double max_acceleration = 2.0;  // a_max [rad/s^2]
    double min_speed = 0.0;         // commands below are taken as this [rad/s]
    double max_speed = 0.0;         // commands above are taken as this [rad/s]
  };
  explicit Drive(const Parameters& parameters) : p_(parameters) {}

  std::vector<State> states() const override;
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;

 private:
  Parameters p_;
};

}  // namespace heerk_rotor
