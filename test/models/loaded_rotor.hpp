#pragma once
#include <array>

#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/models/elastic_mast.hpp"
#include "heerk_rotor/models/lag_rotor.hpp"
#include "models/rotor_runs.hpp"

/// The lag rotor on an elastic mast under constant blade loads: airloads whose effect is known in closed form.
namespace heerk_rotor::test {

/// Constant tangential force F_i and hinge moment M_i of each blade, as blade_load (F_1..4, M_1..4).
class ConstantBladeLoad : public SubsystemModel {
 public:
  explicit ConstantBladeLoad(const std::array<double, 8>& load) : load_(load) {}
  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override { return {}; }
  std::vector<OutputPort> outputs() const override {
    return {{"blade_load", 8, "N, N m", "constant tangential forces, then hinge moments", {}, 1e3,
             {"force_1", "force_2", "force_3", "force_4", "hinge_moment_1", "hinge_moment_2", "hinge_moment_3", "hinge_moment_4"}}};
  }
  void evalOutput(Index, double, const In&, const In&, Out y) noexcept override {
    for (Index i = 0; i < 8; ++i) y[i] = load_[static_cast<std::size_t>(i)];
  }
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  std::array<double, 8> load_;
};

struct LoadedRotor {
  LagRotorParameters rotor;
  ElasticMast::Parameters mast;
  LagFormulation formulation = LagFormulation::kAbsoluteLag;
  std::array<double, 8> load{};
  std::map<std::string, double> rotor_initial, mast_initial;

  CoupledSystem system() const {
    CouplingGraph graph;
    graph.add("load", std::make_unique<ConstantBladeLoad>(load));
    graph.add("mast", std::make_unique<ElasticMast>(mast, mastLoad(rotor, formulation, mast.rotor_speed)), mast_initial);
    graph.add("rotor", std::make_unique<LagRotor>(rotor, formulation), rotor_initial);
    graph.connect("load.blade_load", "rotor.blade_load");
    graph.connect("mast.hub_motion", "rotor.hub_motion");
    graph.connect("mast.hub_acceleration", "rotor.hub_acceleration");
    graph.connect("rotor.blade_reaction", "mast.blade_reaction");
    graph.connect("mast.torque", "rotor.mast_torque");
    return std::move(graph).build();
  }

  std::unique_ptr<Simulation> simulation(double h) const {
    StepOptions options;
    options.step = h;
    options.method = "HEERK4";
    options.solver.tolerance = 1e-13;
    return std::make_unique<Simulation>(system(), options);
  }
};

/// Constant hinge moments that hold every blade at the lag angle lag0, started at the resulting equilibrium:
/// k phi_0 = M / I_l and K_s twist = 4 M, k = r_a^2 Omega^2 + omega_b^2.
inline LoadedRotor steadyLag(double lag0, double stiffness, double rotor_speed, bool second_order_hub_terms, LagFormulation formulation) {
  LoadedRotor r;
  r.rotor.second_order_hub_terms = second_order_hub_terms;
  r.mast.stiffness = stiffness;
  r.mast.rotor_speed = rotor_speed;
  r.formulation = formulation;
  const LagRotorConstants c(r.rotor);
  const double k = c.r_a2 * rotor_speed * rotor_speed + r.rotor.lag_frequency[0] * r.rotor.lag_frequency[0];
  const double moment = k * c.lag_inertia * lag0;
  for (std::size_t i = 0; i < 4; ++i) {
    r.load[4 + i] = moment;
    r.rotor_initial["lag_" + std::to_string(i + 1)] = lag0;
  }
  r.mast_initial["twist"] = 4.0 * moment / stiffness;
  return r;
}

}  // namespace heerk_rotor::test
