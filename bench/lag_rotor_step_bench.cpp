// Cost of one step of the lag rotor through the general coupled system, and of the paper's 1e5-step case.
// Every measurement starts from a saved state that is past the start-up transient of the solver.
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "heerk_rotor/assembly/build_simulation.hpp"

namespace heerk_rotor {
namespace {

std::unique_ptr<Simulation> make(const std::string& config, const std::vector<std::string>& overrides) {
  return buildSimulation(Configuration::load(std::string(HEERK_SOURCE_DIR) + "/config/" + config, overrides));
}

void step(benchmark::State& state, const std::string& config, const std::vector<std::string>& overrides) {
  const auto simulation = make(config, overrides);
  const Vector command = simulation->system().defaultCommand();
  for (int k = 0; k < 1000; ++k) simulation->step(command);
  const Simulation::Checkpoint start = simulation->checkpoint();
  const SolverCounters before = simulation->solver().counters();
  for (auto _ : state) {
    if (simulation->step(command) != StepStatus::kOk) {
      state.SkipWithError("the step failed");
      break;
    }
    if (simulation->stepCount() == start.step + 20000) {
      state.PauseTiming();
      simulation->restore(start);
      state.ResumeTiming();
    }
  }
  const SolverCounters& after = simulation->solver().counters();
  const double solves = static_cast<double>(after.solves - before.solves);
  state.counters["residuals/solve"] = static_cast<double>(after.residual_evaluations - before.residual_evaluations) / solves;
  state.counters["factorizations"] = static_cast<double>(after.factorizations - before.factorizations);
}

/// Table 2 of the paper, h = 1e-4 over 10 s: 93 s for HEERK4 there.
void paperCase(benchmark::State& state) {
  const auto simulation = make("lag_rotor.yaml", {"simulation.step=1e-4", "subsystems.mast.stiffness=3e5"});
  const Simulation::Checkpoint start = simulation->checkpoint();
  const Vector command = simulation->system().defaultCommand();
  for (auto _ : state) {
    for (int k = 0; k < 100000; ++k) simulation->step(command);
    state.PauseTiming();
    simulation->restore(start);
    state.ResumeTiming();
  }
}

BENCHMARK_CAPTURE(step, absolute_lag_3e4, "lag_rotor.yaml", {"subsystems.mast.stiffness=3e4"});
BENCHMARK_CAPTURE(step, absolute_lag_3e6, "lag_rotor.yaml", {"subsystems.mast.stiffness=3e6"});
BENCHMARK_CAPTURE(step, absolute_lag_3e8, "lag_rotor.yaml", {"subsystems.mast.stiffness=3e8"});
BENCHMARK_CAPTURE(step, absolute_lag_second_order, "lag_rotor.yaml", {"subsystems.rotor.second_order_hub_terms=true"});
BENCHMARK_CAPTURE(step, printed_3e4, "lag_rotor.yaml", {"simulation.formulation=printed"});
BENCHMARK_CAPTURE(step, printed_herk4, "lag_rotor.yaml", {"simulation.formulation=printed", "simulation.integrator=HERK4"});
BENCHMARK_CAPTURE(step, controlled, "lag_rotor_controlled.yaml", {});
BENCHMARK(paperCase)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace heerk_rotor
