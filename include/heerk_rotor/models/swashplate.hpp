#pragma once
#include <array>

#include "heerk_rotor/models/hub_motion.hpp"

namespace heerk_rotor {

/// Swashplate with second-order actuators: collective and two cyclic angles become the pitch of four blades.
///
///   delta' = r tanh(v / r),  v' = wn^2 (clamp(command) - delta) - 2 zeta wn v      for each of the three
///   theta_k = delta_0 + delta_1c cos psi_k + delta_1s sin psi_k                    (aeromechanics conventions, section 0)
/// The rate limit r is smooth, because f and g of the coupled system must be differentiable; the travel limits act on the
/// command, which is constant within a step.
///
/// States: collective, lateral_cyclic (1c), longitudinal_cyclic (1s) [rad], and their actuator demand v [rad/s].
/// Inputs: command (as the states), hub_motion. Outputs: pitch of each blade (nose up positive, collective quoted at
/// 0.75 R), its rate, and the plate's position.
class Swashplate : public SubsystemModel {
 public:
  struct Parameters {
    double frequency = 40.0;                       // wn [rad/s]
    double damping_ratio = 0.8;                    // zeta [-]
    double rate_limit = 0.7;                       // r [rad/s], 40 deg/s
    double collective_min = -0.0524;               // [rad], -3 deg
    double collective_max = 0.349;                 // [rad], 20 deg
    double cyclic_limit = 0.1745;                  // both cyclics, either sign [rad], 10 deg
    std::array<double, 3> trim{};                  // command until one arrives, and initial position [rad]
  };
  static constexpr int kBlades = kLagBlades;

  explicit Swashplate(const Parameters& parameters) : p_(parameters) {}

  std::vector<State> states() const override;
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;

 private:
  Parameters p_;
};

}  // namespace heerk_rotor
