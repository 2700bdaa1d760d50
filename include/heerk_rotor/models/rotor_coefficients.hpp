#pragma once
#include "heerk_rotor/models/blade_azimuths.hpp"
#include "heerk_rotor/models/hub_motion.hpp"

namespace heerk_rotor {

/// Nondimensional loads, flow and multiblade coordinates of a rotor: pure outputs, nothing reads them back (component rotor model of the HEERK
/// paper, Section 4). US convention, without factor 1/2: forces over rho A (Omega R)^2, moments over rho A (Omega R)^2 R.
///
///   CT = Fz, CH = -Fx (aft), CY = -Fy (right), roll and pitch moment Mx (roll right), My (nose down): of the rotor on the fuselage, hub_link
///   CQ = -blade_reaction: the torque that the blades need from the shaft;  CP = CQ (hub speed / Omega), over rho A (Omega R)^3
///   FM = CT^1.5 / (sqrt 2 CP), 0 without thrust or power (windmill, autorotation);  blade loading CT / sigma,  sigma = N c / (pi R)
///   mu, mu_z: in-plane and upward velocity of the hub through the air over Omega R;  inflow ratio lambda = mu_z + l0
///   shaft angle alpha_s = atan(-mu_z / mu): nose up, air from below, positive
///   angle of the tip-path plane = alpha_s - beta_1c seen in the direction of flight (beta_1c > 0 tilts the disc forward)
///   multiblade coordinates of flap and lag: (1/N) sum, (2/N) sum cos psi_k, (2/N) sum sin psi_k, for even N also (1/N) sum (-1)^(k-1)
/// Omega is the nominal speed throughout, as in the inflow models and in hub_flow: ratios of coefficients are then ratios of loads also while the
/// speed varies, and they stay finite at standstill. (Over the hub's speed, CT would be larger by (Omega / hub speed)^2.)
/// With two blades cosine and sine part of a steady tilt carry a ripple of 2/rev as large as themselves (only their mean is the tilt, and the
/// tip-path plane angle is theirs); the differential coordinate is the free one then.
///
/// No states. Inputs: rotor_force, tilting_moment, blade_reaction, hub_motion, hub_flow, inflow, flap, lag. All outputs are published.
class RotorCoefficients : public SubsystemModel {
 public:
  struct Parameters {
    int blades = 4;              // N, 2 to 8
    double radius = 4.91;        // R [m]
    double rotor_speed = 44.4;   // Omega, nominal [rad/s]
    double air_density = 1.225;  // rho [kg/m^3]
    double chord = 0.27;         // c, for the solidity [m]
  };
  explicit RotorCoefficients(const Parameters& parameters);

  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  /// y: collective, cosine, sine and for even N differential coordinate of the values at u[first].
  void multiblade(const In& u, Index first, Out y) const noexcept;
  double tipPathPlaneAngle(const In& u) const noexcept;
  double powerCoefficient(const In& u) const noexcept;

  Parameters p_;
  BladeAzimuths azimuths_;
  double per_force_, per_moment_;  // 1 / (rho A (Omega R)^2) [1/N], the same over R [1/(N m)]
  double solidity_;
};

}  // namespace heerk_rotor
