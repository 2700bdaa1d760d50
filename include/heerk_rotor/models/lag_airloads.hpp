#pragma once
#include <vector>

#include "heerk_rotor/models/hub_motion.hpp"

namespace heerk_rotor {

/// Airloads of four rigid blades by linear blade-element theory with uniform inflow: what a swashplate needs to move the
/// lag rotor.
///
/// Section at radius r of blade i, small inflow angle, no stall:
///   U_T = omega r + phi_i' (r - a) + hub velocity along e_t,i,   U_P = v (induced, downwards),  theta = pitch_i + twist (r/R - 0.75)
///   dT = rho/2 c a0 |U_T| (theta U_T - U_P) dr,    dF = -rho/2 c |U_T| [a0 (theta U_T - U_P) U_P / U_T + cd0 U_T] dr
/// F_i = int dF (towards lead), M_i = int (r - a) dF about the lag hinge. The induced velocity is uniform and follows from
/// momentum at every instant (Glauert): T = 2 rho A v sqrt(V^2 + v^2), V the hub's in-plane speed. T is linear in v here,
/// so that equation is solved within the model; it has exactly one root.
/// Valid: attached flow, inflow angle well below 1 rad, V small against omega R (reverse flow is handled but not modelled).
/// Coefficients use rho A (Omega R)^2 (US convention) with the nominal speed Omega; thrust acts at the rigid blades, so
/// the rolling and pitching moments of the thrust go to the hub undiminished.
class LagAirloads : public SubsystemModel {
 public:
  struct Parameters {
    double radius = 5.0;         // R [m]
    double root_cutout = 0.8;    // first lifting radius [m]
    double chord = 0.32;         // c [m]
    double twist = -0.1396;      // linear twist from centre to tip [rad]; zero at 0.75 R
    double lift_slope = 5.73;    // a0 [1/rad]
    double profile_drag = 0.01;  // cd0 [-]
    double air_density = 1.225;  // rho [kg/m^3]
    double hinge_offset = 0.2;   // a, of the rotor [m]
    double rotor_speed = 41.0;   // Omega [rad/s]
  };
  static constexpr int kBlades = kLagBlades;

  explicit LagAirloads(const Parameters& parameters);

  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  struct Loads {
    double force[kBlades], moment[kBlades];   // tangential [N], about the hinge [N m]
    double thrust, roll, pitch, torque;       // at the hub, hub_link [N], [N m]; torque that the drag needs, > 0
    double inflow;                            // v / (Omega R)
  };
  Loads loads(const In& u) const noexcept;
  double inducedVelocity(double thrust0, double slope, double speed_squared) const noexcept;

  Parameters p_;
  double disc_area_;                          // [m^2]
  std::vector<double> radius_, weight_, pitch_offset_;  // Gauss points along the blade [m], weights [m], built-in twist [rad]
};

}  // namespace heerk_rotor
