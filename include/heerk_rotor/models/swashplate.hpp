#pragma once
#include <array>

#include "heerk_rotor/models/blade_azimuths.hpp"
#include "heerk_rotor/models/hub_motion.hpp"

namespace heerk_rotor {

/// Swashplate with second-order actuators: collective and two cyclic angles become the pitch of N blades.
///
///   delta' = r tanh(v / r),  v' = wn^2 (clamp(command) - delta) - 2 zeta wn v                        for each of the three
///   theta_k = delta_0 + delta_1c cos(psi_k + Delta) + delta_1s sin(psi_k + Delta) - tan(delta3) beta_k   (aeromechanics conventions, section 0)
/// The rate limit r is smooth, because f and g of the coupled system must be differentiable; the travel limits act on the
/// command, which is constant within a step. psi_k is relative to the mount, which carries the plate.
///
/// pitch_rate and pitch_acceleration are the exact derivatives, which the boundary conditions of elastic blades need. The second holds
///   delta'' = (1 - tanh^2(v / r)) v',
/// hence the command, by which it jumps when the command does (pitch and pitch_rate do not), and the hub's acceleration, by which it
/// belongs to the algebraic loop of hub and blades.
///
/// States: collective, lateral_cyclic (1c), longitudinal_cyclic (1s) [rad], and their actuator demand v [rad/s].
/// Inputs: command (as the states), hub_motion, hub_acceleration; with delta3 also flap, flap_rate, flap_acceleration of the blades (without
/// the last one pitch_acceleration lacks -tan(delta3) flap''). Outputs: pitch of each blade (nose up positive, collective quoted at
/// 0.75 R), its two derivatives, and the plate's position.
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
    int blades = kLagBlades;                       // N, 2 to 8
    double phase = 0.0;                            // Delta, control phase angle: pitch leads the plate's azimuth by it [rad]
    double delta3 = 0.0;                           // pitch-flap coupling: flap up, nose down when positive [rad]
  };

  explicit Swashplate(const Parameters& parameters);

  std::vector<State> states() const override;
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;
  bool outputJacobian(Index port, double t, const In& x, const In& u, Eigen::Map<Matrix> jacobian) noexcept override;

 private:
  struct Harmonics;  // collective, cosine and sine part of the pitch or of one of its derivatives
  Harmonics pitch(const In& x) const noexcept;
  Harmonics pitchRate(const In& x, double speed) noexcept;
  Harmonics pitchAcceleration(const In& x, const In& u) noexcept;
  double limitedCommand(const In& u, Index i) const noexcept;
  /// tanh(v_i / r) of the actuators' rates v, and the azimuths of all blades: ports and derivatives of an instant share them.
  const std::array<double, 3>& saturation(const In& x) noexcept;
  void turnTo(double azimuth) noexcept;

  Parameters p_;
  BladeAzimuths azimuths_;
  double coupling_;                                // tan(delta3) [-]
  std::array<double, 3> low_, high_;               // travel [rad]
  // Of the last arguments, which are compared bitwise; NaN: none yet.
  double saturation_key_[3], azimuth_key_;
  std::array<double, 3> saturation_;
  double cosine_[BladeAzimuths::kMaxBlades], sine_[BladeAzimuths::kMaxBlades];  // of psi_k + Delta
};

}  // namespace heerk_rotor
