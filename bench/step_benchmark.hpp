// What the step benchmarks share: a configuration with overrides, stepped from a saved state that is past the start-up transient of the solver.
#pragma once
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "heerk_rotor/assembly/build_simulation.hpp"

namespace heerk_rotor {

inline std::unique_ptr<Simulation> make(const std::string& config, const std::vector<std::string>& overrides) {
  return buildSimulation(Configuration::load(std::string(HEERK_SOURCE_DIR) + "/config/" + config, overrides));
}

inline void step(benchmark::State& state, const std::string& config, const std::vector<std::string>& overrides) {
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

}  // namespace heerk_rotor
