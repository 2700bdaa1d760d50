#pragma once
#include <memory>
#include <string>
#include <vector>

#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// Two decaying states with a command, no rotor: x_i' = -i x_i + input. Ports: level (two entries), force (named
/// entries), hidden (not published), and azimuth when asked for.
class SmallModel final : public SubsystemModel {
 public:
  explicit SmallModel(bool with_azimuth) : with_azimuth_(with_azimuth) {}
  std::vector<State> states() const override {
    return {{"a", "m", "first, up positive", 1.0}, {"b_1", "m/s", "second", -0.1}};
  }
  std::vector<InputPort> inputs() const override {
    InputPort port;
    port.name = "push";
    port.unit = "m";
    port.unconnected = Unconnected::kCommand;
    port.default_value = {0.25};
    port.entries = {"push"};
    return {port};
  }
  std::vector<OutputPort> outputs() const override {
    std::vector<OutputPort> ports = {{"level", 2, "m", "both states", {}, 1.0, {}, true},
                                     {"force", 3, "N", "of a on b", {}, 1.0, {"force_x", "force_y", "force_z"}, true},
                                     {"hidden", 1, "", "a squared", {}, 1.0, {}, false}};
    if (with_azimuth_) ports.push_back({"azimuth", 1, "rad", "hub angle", {}, 1.0, {}, false});
    return ports;
  }
  void evalOutput(Index port, double t, const In& x, const In&, Out y) noexcept override {
    if (port == 0) y << x[0], x[1];
    if (port == 1) y << 1.0 / 3.0, -1e-300 * x[0], 1e17 * x[1];
    if (port == 2) y << x[0] * x[0];
    if (port == 3) y << 100.0 + t;
  }
  void evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept override { xdot << -x[0] + u[0], -2.0 * x[1] + u[0]; }

 private:
  bool with_azimuth_;
};

inline CoupledSystem smallSystem(bool with_azimuth = false) {
  CouplingGraph graph;
  graph.add("tank", std::make_unique<SmallModel>(with_azimuth));
  return std::move(graph).build();
}

inline std::unique_ptr<Simulation> smallSimulation(double h = 0.01, bool with_azimuth = false) {
  StepOptions options;
  options.step = h;
  options.method = "HEERK4";
  return std::make_unique<Simulation>(smallSystem(with_azimuth), options);
}

}  // namespace heerk_rotor
