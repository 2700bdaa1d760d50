#pragma once
#include "heerk_rotor/models/mast_ports.hpp"

namespace heerk_rotor {

/// A mast without spring: the hub follows the drive (the paper's original system, A.1). Same ports as ElasticMast, no states; the torque is what
/// the constraint needs: torque = R - I (alpha + r'), r' the yaw acceleration of the mount (only with a hub of its own, see MastHub).
class RigidMast : public SubsystemModel {
 public:
  RigidMast(double rotor_speed, const MastLoad& load, MastHub hub = MastHub::kOfLagRotor) : rotor_speed_(rotor_speed), load_(load), hub_(hub) {}

  std::vector<State> states() const override { return {}; }
  std::vector<std::string> ignoredInitialValues() const override { return {"twist", "twist_rate"}; }
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}
  bool outputJacobian(Index port, double t, const In& x, const In& u, Eigen::Map<Matrix> jacobian) noexcept override;

 private:
  double rotor_speed_;
  MastLoad load_;
  MastHub hub_;
};

}  // namespace heerk_rotor
