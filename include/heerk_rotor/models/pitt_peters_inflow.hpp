#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

/// Dynamic inflow of Pitt and Peters with three states, nu = (l0, l1s, l1c) in wind axes:
///   M nu' / Omega + V L^-1 nu = (CT, Cs, Cc),   M = diag(8/(3 pi), 16/(45 pi), 16/(45 pi)) (or M11 = 128/(75 pi)),
///   L = [[1/2, 0, -15 pi/64 X], [0, 2 (1 + X^2), 0], [15 pi/64 X, 0, 2 (1 - X^2)]],  X = tan(chi/2),
///   V = diag(VT, Vm, Vm),  VT = sqrt(mu^2 + (mu_z + l0)^2),  Vm = (mu^2 + (mu_z + l0)(mu_z + 2 l0)) / VT.
/// VT acts on the mean and Vm on the harmonics: the printed scalar Vm for all three would make the hover inflow wrong by sqrt 2.
/// States are kept in hub axes, so that they mean the same when the direction of flight turns. The inflow is a state, hence
/// no algebraic loop with the airloads. Ports of inflow_ports.hpp.
class PittPetersInflow : public SubsystemModel {
 public:
  struct Parameters {
    double rotor_speed = 40.0;            // Omega, nominal [rad/s]
    double induced_power_factor = 1.0;    // kappa, multiplies the steady induced flow [-]
    bool corrected_mass = false;          // M11 = 128/(75 pi) instead of 8/(3 pi)
  };
  explicit PittPetersInflow(const Parameters& parameters) : p_(parameters) {}

  std::vector<State> states() const override;
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;

 private:
  Parameters p_;
};

}  // namespace heerk_rotor
