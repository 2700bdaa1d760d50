// Cost of one step of the complete elastic rotor (config/bo105.yaml: 4 blades x 10 elements x 10 sections, C81 tables, Pitt-Peters, fuselage on
// springs, HEERK4, 360 steps per revolution), and where it goes. At 360 steps per revolution a step has 393 us.
// Every measurement starts from a saved state past the start-up of rotor and solver. CPU time of the thread: other work on the machine
// does not count, although it still slows caches and clock down.
#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/integrate/linear_propagator.hpp"
#include "thread_time.hpp"

namespace heerk_rotor {
namespace {

constexpr int kWarmUp = 1800;      // steps, five revolutions
constexpr int kIterations = 3600;  // steps, ten revolutions
constexpr int kStretch = 60;       // steps between two looks at the clock

double cpuMicroseconds() { return 1e6 * threadSeconds(); }

double wallMicroseconds() { return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

Configuration configuration(const std::vector<std::string>& overrides) { return Configuration::load(std::string(HEERK_SOURCE_DIR) + "/config/bo105.yaml", overrides); }

/// Forwards to a model and adds up the time that its evaluations take.
class Timed final : public SubsystemModel {
 public:
  explicit Timed(double& spent) : spent_(spent) {}
  void to(std::unique_ptr<SubsystemModel> model) { model_ = std::move(model); }
  std::vector<State> states() const override { return model_->states(); }
  std::vector<InputPort> inputs() const override { return model_->inputs(); }
  std::vector<OutputPort> outputs() const override { return model_->outputs(); }
  StiffPart stiffPart() const override { return model_->stiffPart(); }
  bool providesRemainder() const override { return model_->providesRemainder(); }
  std::vector<std::string> ignoredInitialValues() const override { return model_->ignoredInitialValues(); }
  void completeInitialState(const In& u, Out x) const override { model_->completeInitialState(u, x); }
  bool holdState(bool held) noexcept override { return model_->holdState(held); }
  bool outputJacobian(Index port, double t, const In& x, const In& u, Eigen::Map<Matrix> jacobian) noexcept override { return model_->outputJacobian(port, t, x, u, jacobian); }

  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override {
    const double begin = wallMicroseconds();
    model_->evalOutput(port, t, x, u, y);
    spent_ += wallMicroseconds() - begin;
  }
  void evalOutputs(const PortValue* values, Index count, double t, const In& x, const In& u) noexcept override {
    const double begin = wallMicroseconds();
    model_->evalOutputs(values, count, t, x, u);
    spent_ += wallMicroseconds() - begin;
  }
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override {
    const double begin = wallMicroseconds();
    model_->evalDerivatives(t, x, u, xdot);
    spent_ += wallMicroseconds() - begin;
  }
  void evalRemainder(double t, const In& x, const In& u, Out remainder) noexcept override {
    const double begin = wallMicroseconds();
    model_->evalRemainder(t, x, u, remainder);
    spent_ += wallMicroseconds() - begin;
  }

 private:
  std::unique_ptr<SubsystemModel> model_;
  double& spent_;
};

void report(benchmark::State& state, const Simulation& simulation, const SolverCounters& before, std::vector<double> cpu, std::vector<double> wall) {
  const SolverCounters& after = simulation.solver().counters();
  const double solves = static_cast<double>(after.solves - before.solves);
  state.counters["residuals/solve"] = static_cast<double>(after.residual_evaluations - before.residual_evaluations) / solves;
  state.counters["h"] = simulation.stepSize();  // [s] of simulated time per step
  state.counters["factorizations"] = static_cast<double>(after.factorizations - before.factorizations);
  state.counters["cpu_median_us"] = median(std::move(cpu));
  std::sort(wall.begin(), wall.end());
  state.counters["wall_median_us"] = wall[wall.size() / 2];
  state.counters["wall_99.9%_us"] = wall[std::min(wall.size() - 1, wall.size() * 999 / 1000)];
  state.counters["wall_longest_us"] = wall.back();
}

/// Iterations are stretches of a sixth of a revolution, at whose ends the clock of the thread is read; times are per step. Other guests of the machine slow
/// it down for moments that are longer than a stretch, so that the shortest one tells what the machine can do. With a `speed_change` another rotor
/// speed, higher by this part or nominal again, is commanded with every revolution.
void step(benchmark::State& state, const std::vector<std::string>& overrides, double speed_change = 0.0) {
  const auto simulation = buildSimulation(configuration(overrides));
  const Vector nominal = simulation->system().defaultCommand();
  Vector changed = nominal;
  const auto& names = simulation->system().commandNames();
  changed[std::find(names.begin(), names.end(), "drive.speed") - names.begin()] *= 1.0 + speed_change;
  for (int k = 0; k < kWarmUp; ++k) simulation->step(nominal);
  const Simulation::Checkpoint start = simulation->checkpoint();
  const SolverCounters before = simulation->solver().counters();
  std::vector<double> cpu, wall;
  for (auto _ : state) {
    if (simulation->stepCount() == start.step + kIterations) simulation->restore(start);
    const Vector& command = simulation->stepCount() / 360 % 2 == 0 ? nominal : changed;
    const double cpu_begin = cpuMicroseconds();
    for (int k = 0; k < kStretch; ++k) {
      const double wall_begin = wallMicroseconds();
      if (simulation->step(command) != StepStatus::kOk) return state.SkipWithError("the step failed");
      wall.push_back(wallMicroseconds() - wall_begin);
    }
    cpu.push_back((cpuMicroseconds() - cpu_begin) / kStretch);
    state.SetIterationTime(1e-6 * cpu.back());
  }
  state.counters["shortest_us"] = *std::min_element(cpu.begin(), cpu.end());
  report(state, *simulation, before, std::move(cpu), std::move(wall));
}

/// Medians per step of: structure (rotor), airloads, all other models, propagation by the matrix functions of S, and the rest: Newton's
/// linear algebra, moving of data and control. Reading the clock adds about 5 % to the models' shares.
void parts(benchmark::State& state, const std::vector<std::string>& overrides) {
  std::map<std::string, double> spent;
  CoupledSystem system = buildSystem(configuration(overrides));
  for (std::size_t k = 0; k < system.subsystems().size(); ++k) {
    const std::string& name = system.subsystems()[k].name;
    const std::string part = name == "rotor" ? "structure" : name == "airloads" ? "airloads" : "other_models";
    auto timed = std::make_unique<Timed>(spent[part]);
    Timed& forwards = *timed;
    forwards.to(system.exchangeModel(static_cast<Index>(k), std::move(timed)));
  }
  const auto ordinary = buildSimulation(configuration(overrides));
  const StepOptions options = ordinary->options();
  const Tableau& method = tableau(options.method);
  std::vector<std::unique_ptr<LinearPropagator>> propagators;
  for (const CoupledSystem::Subsystem& s : system.subsystems()) propagators.push_back(s.x_size > 0 ? makePropagator(s.stiff, options.step, method) : nullptr);
  std::vector<Index> begins;
  for (const CoupledSystem::Subsystem& s : system.subsystems()) begins.push_back(s.x_begin);

  Simulation simulation(std::move(system), options);
  const Vector command = simulation.system().defaultCommand();
  for (int k = 0; k < kWarmUp; ++k) simulation.step(command);
  const Simulation::Checkpoint start = simulation.checkpoint();
  const SolverCounters before = simulation.solver().counters();
  const Index n = simulation.state().size();
  const std::vector<double> remainders(static_cast<std::size_t>(method.stages() * n), 1.0);
  Vector result = Vector::Zero(n);
  std::map<std::string, std::vector<double>> shares;
  std::vector<double> cpu, wall;
  for (auto _ : state) {
    if (simulation.stepCount() == start.step + 3600) simulation.restore(start);
    for (auto& [name, time] : spent) time = 0.0;
    const double cpu_begin = cpuMicroseconds(), begin = wallMicroseconds();
    simulation.step(command);
    const double total = wallMicroseconds() - begin;
    cpu.push_back(cpuMicroseconds() - cpu_begin);
    wall.push_back(total);
    double rest = total;
    for (const auto& [name, time] : spent) {
      shares[name].push_back(time);
      rest -= time;
    }
    // The same propagation once more, by itself.
    const double propagation_begin = wallMicroseconds();
    for (int row = 1; row <= method.stages(); ++row)
      for (std::size_t k = 0; k < propagators.size(); ++k)
        if (propagators[k]) propagators[k]->combine(row, simulation.state().data() + begins[k], remainders.data() + begins[k], n, result.data() + begins[k]);
    benchmark::DoNotOptimize(result.data());
    const double propagation = wallMicroseconds() - propagation_begin;
    shares["propagation"].push_back(propagation);
    shares["algebra_and_rest"].push_back(rest - propagation);
    state.SetIterationTime(1e-6 * cpu.back());
  }
  report(state, simulation, before, std::move(cpu), std::move(wall));
  for (auto& [name, times] : shares) state.counters[name + "_us"] = median(times);
}

BENCHMARK_CAPTURE(step, bo105, {})->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(kIterations / kStretch);
BENCHMARK_CAPTURE(step, bo105_20_sections, {"subsystems.rotor.sections=20"})->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(kIterations / kStretch);
BENCHMARK_CAPTURE(step, bo105_linear_airloads, {"subsystems.airloads.polar=linear"})->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(kIterations / kStretch);
BENCHMARK_CAPTURE(step, bo105_rigid_mount, {"subsystems.fuselage.mode=rigid"})->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(kIterations / kStretch);
BENCHMARK_CAPTURE(step, bo105_speed_changes, {}, 0.05)->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(kIterations / kStretch);
BENCHMARK_CAPTURE(parts, bo105_20_sections, {"subsystems.rotor.sections=20"})->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(kIterations);
BENCHMARK_CAPTURE(parts, bo105, {})->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(kIterations);

}  // namespace
}  // namespace heerk_rotor
