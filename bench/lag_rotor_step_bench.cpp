// Cost of one step of the lag rotor through the general coupled system, and of the paper's 1e5-step case.
#include "step_benchmark.hpp"

namespace heerk_rotor {
namespace {

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
