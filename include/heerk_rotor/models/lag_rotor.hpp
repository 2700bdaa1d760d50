#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/models/lag_rotor_parameters.hpp"

namespace heerk_rotor {

/// Four blades with lead-lag hinges on a hub whose fuselage moves in the plane on springs.
///
/// Equations (HEERK paper, A.1 and A.3, with the corrections of docs/lag_rotor.md), psi_i = azimuth + (i-1) pi/2,
/// s_i = sin psi_i, c_i = cos psi_i, omega and alpha the hub's speed and acceleration, k_i = r_a^2 omega^2 + omega_b,i^2:
///   x'' + c_x/m_x x' + omega_x^2 x + r_mx sum d^2/dt^2(-s_i phi_i) = -sum F_i s_i / m_x
///   y'' + c_y/m_y y' + omega_y^2 y + r_my sum d^2/dt^2( c_i phi_i) =  sum F_i c_i / m_y
///   phi_i'' + d_i phi_i' + k_i phi_i + g alpha = r_b (s_i x'' - c_i y'') + M_i / I_l
/// and what the hub feels of the blades (the mast closes the loop: J alpha = -mast torque + R):
///   R = -S_h sum phi_i'' + sum(M_i + a F_i) [+ 2 a b m_b omega sum phi_i phi_i' + b m_b sum phi_i (x'' c_i + y'' s_i)]
/// The bracket is dropped in the paper although rows of the same order keep such terms (`second_order_hub_terms`):
/// without it a steady lag angle phi_0 makes the mast mode grow (leading) or decay (lagging) falsely, at about
/// 23 omega phi_0 for the paper's rotor (docs/lag_rotor.md).
///
/// Formulations: `printed` has phi_i as states. `absolute_lag` has chi_i = phi_i + g twist instead, so that alpha leaves
/// the blade equation; then R (with phi_i'' replaced by chi_i'' + g psi_drive'') does not depend on alpha, the algebraic
/// loop is gone (without the bracket), and the mast's 2x2 block holds all of its stiffness.
///
/// States: fuselage x, y (paper's axes: x aft, y to starboard) [m], lag angles (lead positive) [rad], and their rates.
/// Inputs: hub_motion (azimuth, speed, twist, twist rate), hub_acceleration (hub, drive), blade_load (F_1..4 tangential
/// forces towards lead [N], M_1..4 their moments about the hinge [N m]), thrust_load (thrust [N], roll and pitch moment
/// of the airloads in hub_link [N m], only passed on to the hub loads), mast_torque (on the fuselage, about +z).
/// Assumptions: small lag angles, rigid blades in flap, in-plane fuselage motion only, equal blade masses.
class LagRotor : public SubsystemModel {
 public:
  LagRotor(const LagRotorParameters& parameters, LagFormulation formulation);

  std::vector<State> states() const override;
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;
  /// Of the blade reaction, while it is free of the second-order terms: an exact gradient saves the loop with the mast one
  /// Newton iteration, because 1 / (1 - q) amplifies the error of differences as well.
  bool outputJacobian(Index port, double t, const In& x, const In& u, Eigen::Map<Matrix> jacobian) noexcept override;
  void completeInitialState(const In& u, Out x) const override;

 private:
  struct Accelerations {
    double x, y;                 // of the fuselage [m/s^2]
    double lag[kLagBlades];      // phi_i'' in printed form, chi_i'' in absolute-lag form [rad/s^2]
    double sine, cosine;         // of the azimuth
  };
  double lagAngle(const In& x, const In& u, int blade) const noexcept;
  double lagRate(const In& x, const In& u, int blade) const noexcept;
  double hingeAcceleration(const In& x, const In& u, int blade) const noexcept;
  Accelerations accelerations(const In& x, const In& u) const noexcept;
  double bladeReaction(const In& x, const In& u) const noexcept;
  void hubForce(const In& x, const In& u, Out& y) const noexcept;
  void bladeMomentum(const In& x, const In& u, Out& y) const noexcept;

  LagRotorParameters p_;
  LagRotorConstants c_;
  bool absolute_;
};

}  // namespace heerk_rotor
