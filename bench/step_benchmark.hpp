// What the step benchmarks share: a configuration with overrides, stepped from a saved state that is past the start-up transient of the solver.
#pragma once
#include <cmath>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "heerk_rotor/assembly/build_simulation.hpp"
#include "thread_time.hpp"

namespace heerk_rotor {

inline std::unique_ptr<Simulation> make(const std::string& config, const std::vector<std::string>& overrides) {
  return buildSimulation(Configuration::load(std::string(HEERK_SOURCE_DIR) + "/config/" + config, overrides));
}

/// Steps on from a saved state after `warm_up` steps; returns to it every `length` steps. Counters: what a solve of the algebraic part took, and the time
/// per step of the shortest stretch.
inline void stepOn(benchmark::State& state, Simulation& simulation, int warm_up = 1000, std::uint64_t length = 20000, int steps_of_stretch = 400) {
  const Vector command = simulation.system().defaultCommand();
  for (int k = 0; k < warm_up; ++k) simulation.step(command);
  const Simulation::Checkpoint start = simulation.checkpoint();
  const SolverCounters before = simulation.solver().counters();
  ShortestStretch stretch(steps_of_stretch);
  for (auto _ : state) {
    if (simulation.step(command) != StepStatus::kOk) {
      state.SkipWithError("the step failed");
      break;
    }
    stretch.step();
    if (simulation.stepCount() == start.step + length) {
      state.PauseTiming();
      simulation.restore(start);
      state.ResumeTiming();
      stretch.begin();
    }
  }
  if (std::isfinite(stretch.microsecondsPerStep())) state.counters["shortest_us"] = stretch.microsecondsPerStep();
  const SolverCounters& after = simulation.solver().counters();
  const double solves = static_cast<double>(after.solves - before.solves);
  state.counters["residuals/solve"] = static_cast<double>(after.residual_evaluations - before.residual_evaluations) / solves;
  state.counters["h"] = simulation.stepSize();  // [s] of simulated time per step
  state.counters["factorizations"] = static_cast<double>(after.factorizations - before.factorizations);
}

inline void step(benchmark::State& state, const std::string& config, const std::vector<std::string>& overrides) { stepOn(state, *make(config, overrides)); }

}  // namespace heerk_rotor
