#pragma once
#include "heerk_rotor/core/coupling_graph.hpp"
#include "models/rotor_runs.hpp"

/// What tests of masts and drives put at the two ends: a body that can only yaw below, a given moment above.
namespace heerk_rotor::test {

/// Yaws under the sum of the torques connected to it, and under nothing else.
class YawingBody : public SubsystemModel {
 public:
  static constexpr double kInertia = 400.0;  // [kg m^2]
  std::vector<State> states() const override { return {{"yaw_rate", "rad/s", "of the body"}}; }
  std::vector<InputPort> inputs() const override { return {{"torque", 1, "N m", "of mast or engine"}}; }
  std::vector<OutputPort> outputs() const override {
    return {{"velocity", 6, "m/s, rad/s", "yaw rate last", {}}, {"acceleration", 6, "m/s^2, rad/s^2", "yaw acceleration last", {"torque"}}};
  }
  void evalOutput(Index port, double, const In& x, const In& u, Out y) noexcept override {
    y.setZero();
    y[5] = port == 0 ? x[0] : u[0] / kInertia;
  }
  void evalDerivatives(double, const In&, const In& u, Out xdot) noexcept override { xdot[0] = u[0] / kInertia; }
};

/// A moment that is constant, plus one that damps the hub's speed.
class HubMoment : public SubsystemModel {
 public:
  explicit HubMoment(double constant, double damping = 0.0) : constant_(constant), damping_(damping) {}
  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override {
    return {{"hub_motion", 4, "rad, rad/s", "of the hub", Unconnected::kDefault}, {"drive", 3, "rad, rad/s, rad/s^2", "of the drive", Unconnected::kDefault}};
  }
  std::vector<OutputPort> outputs() const override { return {{"moment", 1, "N m", "about +z", {"hub_motion", "drive"}}}; }
  void evalOutput(Index, double, const In&, const In& u, Out y) noexcept override { y[0] = constant_ - damping_ * (u[1] + u[5]); }
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  double constant_, damping_;
};

/// The simulation of a graph with HEERK4 and a solver tolerance that does not show.
inline std::unique_ptr<Simulation> simulationOf(CouplingGraph graph, double h) {
  StepOptions options;
  options.step = h;
  options.method = "HEERK4";
  options.solver.tolerance = 1e-13;
  return std::make_unique<Simulation>(std::move(graph).build(), options);
}

}  // namespace heerk_rotor::test
