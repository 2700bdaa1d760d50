#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/models/lag_rotor_parameters.hpp"

namespace heerk_rotor {

/// Torsion spring and damper between the drive, which turns at the nominal speed Omega, and the rotor hub.
///
///   hub angle = Omega t + drive angle + twist,   I alpha = -K_s twist - c twist' + R,   twist'' = alpha - drive''
/// R is the blades' reaction; I = J in `printed` form (HEERK paper, eq. 9 and 17) and J / kappa in absolute-lag form, where
/// R still contains the blades' stiffness against the twist. S is the 2x2 block of all constant stiffness and damping:
/// [[0, 1], [-(K_s + k_blades)/I, -(c + c_blades)/I]], k_blades at nominal speed (lag_rotor.md, section 5).
///
/// States: twist, twist_rate (hub minus drive). Inputs: blade_reaction; drive (angle, rate and acceleration of the drive
/// relative to Omega t; none = exactly Omega t). The remainder f - S x is given directly, because K_s twist would cancel.
class ElasticMast : public SubsystemModel {
 public:
  struct Parameters {
    double stiffness = 3e6;    // K_s [N m/rad]
    double damping = 0.0;      // c [N m s/rad]
    double rotor_speed = 0.0;  // Omega [rad/s]
  };
  ElasticMast(const Parameters& parameters, const MastLoad& load);

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
};

/// A mast without spring: the hub follows the drive (the paper's original system, A.1). Same ports as ElasticMast,
/// no states; the torque is what the constraint needs: torque = R - I alpha.
class RigidMast : public SubsystemModel {
 public:
  RigidMast(double rotor_speed, const MastLoad& load) : rotor_speed_(rotor_speed), load_(load) {}

  std::vector<State> states() const override { return {}; }
  std::vector<std::string> ignoredInitialValues() const override { return {"twist", "twist_rate"}; }
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  double rotor_speed_;
  MastLoad load_;
};

}  // namespace heerk_rotor
