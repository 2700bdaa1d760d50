#pragma once
#include "heerk_rotor/models/mast_ports.hpp"

namespace heerk_rotor {

/// Torsion spring and damper between the drive, which turns at the nominal speed Omega, and the rotor hub.
///
///   hub angle = Omega t + drive angle + twist,   I (alpha + r') = -K_s twist - c twist' + R,   twist'' = alpha - drive''
/// R is the blades' reaction, alpha the hub's acceleration relative to the mount, r' the yaw acceleration of the mount (only with a hub of its
/// own, see MastHub; with the lag rotor the mount does not yaw). With the lag rotor I = J in `printed` form (HEERK paper, eq. 9 and 17) and
/// J / kappa in absolute-lag form, where R still contains the blades' stiffness against the twist; with elastic blades that of their slow modes. S is the 2x2 block of all constant stiffness
/// and damping: [[0, 1], [-(K_s + k_blades)/I, -(c + c_blades)/I]], k_blades at nominal speed (lag_rotor.md, section 5).
///
/// States: twist, twist_rate (hub minus drive). Ports: mast_ports.hpp. The remainder f - S x is given directly, because K_s twist would cancel.
class ElasticMast : public SubsystemModel {
 public:
  struct Parameters {
    double stiffness = 3e6;    // K_s [N m/rad]
    double damping = 0.0;      // c [N m s/rad]
    double rotor_speed = 0.0;  // Omega [rad/s]
  };
  ElasticMast(const Parameters& parameters, const MastLoad& load, MastHub hub = MastHub::kOfLagRotor) : p_(parameters), load_(load), per_inertia_(1.0 / load.inertia), hub_(hub) {}

  std::vector<State> states() const override;
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  StiffPart stiffPart() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;
  bool providesRemainder() const override { return true; }
  void evalRemainder(double t, const In& x, const In& u, Out remainder) noexcept override;
  bool outputJacobian(Index port, double t, const In& x, const In& u, Eigen::Map<Matrix> jacobian) noexcept override;

 private:
  double hubAcceleration(const In& x, const In& u) const noexcept;
  Parameters p_;
  MastLoad load_;
  double per_inertia_;  // 1 / load_.inertia
  MastHub hub_;
};

}  // namespace heerk_rotor
