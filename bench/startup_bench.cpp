// Start-up of each machine from its YAML file to the end of the first step, files in the page cache. Counters [ms]: reading the file, building the coupled system
// (element matrices, modes, tables), building the simulation (analysis of the loops, matrix functions), the first step.
#include "step_benchmark.hpp"

namespace heerk_rotor {
namespace {

double cpuMilliseconds() { return 1e3 * threadSeconds(); }

/// The same parts as in buildSimulation(), one after the other.
void toFirstStep(benchmark::State& state, const std::string& config) {
  const StepOptions options = make(config, {})->options();
  double reading = 0.0, system_time = 0.0, simulation_time = 0.0, first_step = 0.0;
  for (auto _ : state) {
    const double begin = cpuMilliseconds();
    const Configuration configuration = Configuration::load(std::string(HEERK_SOURCE_DIR) + "/config/" + config);
    const double read = cpuMilliseconds();
    CoupledSystem system = buildSystem(configuration);
    const double built = cpuMilliseconds();
    Simulation simulation(std::move(system), options);
    const double ready = cpuMilliseconds();
    if (simulation.step(simulation.system().defaultCommand()) != StepStatus::kOk) state.SkipWithError("the step failed");
    const double end = cpuMilliseconds();
    reading += read - begin;
    system_time += built - read;
    simulation_time += ready - built;
    first_step += end - ready;
    state.SetIterationTime(1e-3 * (end - begin));
  }
  const auto mean = [](double sum) { return benchmark::Counter(sum, benchmark::Counter::kAvgIterations); };
  state.counters["reading_ms"] = mean(reading);
  state.counters["system_ms"] = mean(system_time);
  state.counters["simulation_ms"] = mean(simulation_time);
  state.counters["first_step_ms"] = mean(first_step);
}

BENCHMARK_CAPTURE(toFirstStep, lag_rotor, "lag_rotor.yaml")->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(toFirstStep, dual_disc, "dual_disc.yaml")->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(toFirstStep, bo105, "bo105.yaml")->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(toFirstStep, hart2, "hart2.yaml")->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace heerk_rotor
