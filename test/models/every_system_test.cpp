// What every coupled system must keep. A new model type adds a complete system that contains it to systems().
#include <functional>
#include <set>

#include "heerk_rotor/models/registry.hpp"
#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

struct System {
  std::string name;
  std::function<Configuration(const Overrides&)> make;
  double step;  // [s] in the asymptotic range of HERK4
};

/// Complete systems that together contain every registered type.
std::vector<System> systems() {
  const auto file = [](const std::string& name, const Overrides& fixed) {
    return [name, fixed](const Overrides& more) { return shipped(name, fixed + more); };
  };
  const auto elastic = [&](const Overrides& fixed) {
    return file("bo105.yaml", Overrides{"subsystems.rotor.modes=6", "subsystems.airloads.polar=linear", "subsystems.rotor.sections=5"} + fixed);
  };
  // The dual-disc rotor on fewer elements and softer bearings, whose largest eigenvalue, 1.4e5 1/s, HERK4 can resolve.
  const auto shaft = [&](const Overrides& more) {
    return file("dual_disc.yaml", Overrides{"subsystems.shaft.segments=[0.14, 0.14, 0.14, 0.14]", "subsystems.shaft.discs.nodes=[1, 3]", "subsystems.shaft.bearings.nodes=[0, 4]",
                                            "subsystems.shaft.bearings.stiffness_x=[3.0e+7, 5.7e+6]", "subsystems.shaft.bearings.stiffness_y=[2.0e+7, 5.7e+6]", "subsystems.shaft.journals=[4]"} + more);
  };
  const std::string disturbed = "subsystems.rotor.initial={lag_1: -0.03, lag_2: -0.04, lag_3: -0.03, lag_4: -0.04}";
  return {{"lag_rotor", file("lag_rotor.yaml", {}), 1e-3},
          {"lag_rotor_printed", file("lag_rotor.yaml", {"simulation.formulation=printed"}), 1e-3},
          {"rigid_mast", file("lag_rotor.yaml", {"subsystems.mast={type: rigid_mast}"}), 1e-2},
          {"controlled", file("lag_rotor_controlled.yaml", {disturbed}), 2e-4},
          {"controlled_printed", file("lag_rotor_controlled.yaml", {disturbed, "simulation.formulation=printed"}), 2e-4},
          // The lag rotor does not yaw, so the engine's torque on its fuselage needs no connection to be right for this test.
          {"governed", file("lag_rotor_controlled.yaml", {disturbed, "subsystems.drive={type: governed_drive, inertia: 300.0, engine_torque: 9700.0, max_torque: 16000.0}",
                                                          "connections.5=[mast.torque, drive.mast_torque]"}), 2e-4},
          // The elastic rotor with the modes that HERK4 can resolve, and smooth airloads.
          {"elastic_rotor", elastic({}), 1e-4},
          {"elastic_rotor_drees", elastic({"subsystems.inflow.type=drees_inflow", "subsystems.mast.type=rigid_mast", "subsystems.fuselage.mode=free"}), 1e-4},
          {"elastic_rotor_uniform", elastic({"subsystems.inflow.type=uniform_inflow", "subsystems.fuselage.mode=spring2", "subsystems.fuselage.mass=1972.4"}), 1e-4},
          {"elastic_rotor_prescribed", elastic({"subsystems.inflow={type: prescribed_inflow, mean: 0.04, sine: -0.01, cosine: 0.02}", "subsystems.fuselage.mode=rigid"}), 1e-4},
          {"dual_disc", shaft({}), 2e-6},
          {"dual_disc_physical", shaft({"subsystems.shaft.coordinates=physical"}), 2e-6},
          {"dual_disc_run_up", shaft({"subsystems.drive={type: speed_ramp, initial_speed_rpm: 3000, final_speed_rpm: 6000, acceleration_rpm_per_s: 1.0e+4}",
                                      "subsystems.shaft.linearised_film_damping=1000.0"}), 2e-6},
          {"monolithic", [](const Overrides& more) {
             return Configuration::parse("simulation: {rotor_speed: 6.63, step: 1.0e-3}\nsubsystems:\n"
                                         "  rotor: {type: monolithic_lag_rotor, mast_stiffness: 3.0e+4, initial: {lag_1: 0.01}}\n", "monolithic", more);
           }, 1e-3}};
}

TEST(EverySystem, togetherTheyContainEveryType) {
  std::set<std::string> types;
  for (const System& system : systems()) {
    const Configuration configuration = system.make({});
    for (const auto& entry : configuration.root()["subsystems"]) types.insert(entry.second["type"].Scalar());
  }
  for (const ModelType& type : modelTypes()) EXPECT_EQ(types.count(type.name), 1u) << type.name << " needs a complete system in this test";
}

Vector endState(const System& system, const std::string& method, double h, double duration) {
  auto simulation = buildSimulation(system.make({"simulation.integrator=" + method, set("simulation.step", h), "simulation.newton_tolerance=1e-13"}));
  EXPECT_TRUE(advance(*simulation, std::lround(duration / h)));
  return simulation->state();
}

TEST(EverySystem, hasTheSameLimitWithTheStiffPartRemoved) {
  for (const System& system : systems()) {
    const auto difference = [&](double h) {
      const Vector a = endState(system, "HEERK4", h, 0.2), b = endState(system, "HERK4", h, 0.2);
      return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
    };
    const double coarse = difference(system.step), fine = difference(system.step / 2);
    report("HEERK4 against HERK4, " + system.name + ", h " + std::to_string(system.step), coarse);
    report("HEERK4 against HERK4, " + system.name + ", h / 2", fine);
    // Both are of fourth order, so their difference is too, down to round-off; a wrong S would leave it where it is.
    EXPECT_LE(fine, std::max(coarse / 10.0, 1e-12)) << system.name;
    EXPECT_LE(fine, 1e-4) << system.name;
  }
}

TEST(EverySystem, goesOnBitwiseEqualFromACheckpoint) {
  for (const System& system : systems()) {
    auto first = buildSimulation(system.make({}));
    const auto command = [&](long k) {
      Vector w = first->system().defaultCommand();
      for (Index i = 0; i < w.size(); ++i) w[i] *= 1.0 + 0.01 * std::sin(0.05 * static_cast<double>(k) + static_cast<double>(i));
      return w;
    };
    const auto run = [&](Simulation& simulation, long from, long to) {
      for (long k = from; k < to; ++k) ASSERT_EQ(simulation.step(command(k)), StepStatus::kOk);
    };
    run(*first, 0, 333);
    const Simulation::Checkpoint checkpoint = first->checkpoint();
    run(*first, 333, 600);
    auto second = buildSimulation(system.make({}));
    run(*second, 0, 17);  // something else before, which must leave no trace
    second->restore(checkpoint);
    run(*second, 333, 600);
    EXPECT_EQ(first->stateHash(), second->stateHash()) << system.name;
    EXPECT_EQ(first->state(), second->state()) << system.name;
  }
}

}  // namespace
}  // namespace heerk_rotor
