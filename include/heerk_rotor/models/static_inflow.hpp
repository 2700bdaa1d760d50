#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

/// Uniform induced flow after Glauert, l0 = kappa CT / (2 sqrt(mu^2 + (mu_z + l0)^2)), as a pure output equation: with airloads
/// that follow the inflow it closes an algebraic loop of gain about -2 in hover, which Newton solves.
/// No states; ports of inflow_ports.hpp.
class UniformInflow : public SubsystemModel {
 public:
  explicit UniformInflow(double induced_power_factor) : kappa_(induced_power_factor) {}

  std::vector<State> states() const override { return {}; }
  std::vector<std::string> ignoredInitialValues() const override { return {"mean", "sine", "cosine"}; }  // of pitt_peters_inflow
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  double kappa_;
};

/// Drees' linear inflow over Glauert's mean: in wind axes
///   l1c = l0 4/3 (1 - cos chi - 1.8 mu^2) / sin chi,   l1s = -2 mu l0,   chi the wake skew angle.
class DreesInflow : public SubsystemModel {
 public:
  explicit DreesInflow(double induced_power_factor) : kappa_(induced_power_factor) {}

  std::vector<State> states() const override { return {}; }
  std::vector<std::string> ignoredInitialValues() const override { return {"mean", "sine", "cosine"}; }  // of pitt_peters_inflow
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  double kappa_;
};

/// Induced flow as commanded (mean, sine, cosine over Omega R, downwards positive), whatever the loads: measured or assumed inflow, closed forms.
/// Parameters of the same names are the command until one arrives. No states; ports of inflow_ports.hpp, and the command.
class PrescribedInflow : public SubsystemModel {
 public:
  explicit PrescribedInflow(const std::vector<double>& inflow) : inflow_(inflow) {}

  std::vector<State> states() const override { return {}; }
  std::vector<std::string> ignoredInitialValues() const override { return {"mean", "sine", "cosine"}; }  // of pitt_peters_inflow
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  std::vector<double> inflow_;
};

}  // namespace heerk_rotor
