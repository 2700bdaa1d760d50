#include "heerk_rotor/tools/failure_dump.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "heerk_rotor/tools/csv_recorder.hpp"

namespace heerk_rotor {
namespace {

constexpr double kMostBytes = 64.0 * 1024.0 * 1024.0;

std::size_t ringCapacity(const Simulation& simulation, double revolution) {
  const double steps = std::ceil(revolution / simulation.stepSize()) + 1.0;  // both ends of the revolution
  const CoupledSystem& system = simulation.system();
  const double bytes = 8.0 * static_cast<double>(1 + system.stateSize() + system.commandSize());
  return static_cast<std::size_t>(std::max(1.0, std::min(steps, kMostBytes / bytes)));
}

std::vector<Signal> statesAnd(const CoupledSystem& system, const std::vector<Signal>& signals) {
  std::vector<Signal> columns;
  for (const Signal& signal : system.signals())
    if (signal.kind == Signal::Kind::kState) columns.push_back(signal);
  std::copy_if(signals.begin(), signals.end(), std::back_inserter(columns),
               [](const Signal& signal) { return signal.kind == Signal::Kind::kOutput; });
  return columns;
}

}  // namespace

RecentInstants::RecentInstants(const Simulation& simulation, double revolution)
    : start_(simulation.checkpoint()),
      steps_(ringCapacity(simulation, revolution), 0),
      states_(Matrix::Zero(simulation.system().stateSize(), static_cast<Index>(steps_.size()))),
      commands_(Matrix::Zero(simulation.system().commandSize(), static_cast<Index>(steps_.size()))) {}

void RecentInstants::push(const Simulation& simulation, const Vector& command) noexcept {
  const std::size_t slot = static_cast<std::size_t>(count_ % steps_.size());
  steps_[slot] = simulation.stepCount();
  states_.col(static_cast<Index>(slot)) = simulation.state();
  commands_.col(static_cast<Index>(slot)) = command;
  ++count_;
}

void writeFailureDump(const std::string& file, Simulation& simulation, const RecentInstants& instants,
                      const std::vector<Signal>& signals, double rotor_speed) {
  const CoupledSystem& system = simulation.system();
  CsvRecorder recorder(file, system, statesAnd(system, signals), rotor_speed, RecordGrid{});
  simulation.addObserver(recorder);
  const Vector unknown = Vector::Constant(system.outputSize(), std::numeric_limits<double>::quiet_NaN());
  Simulation::Checkpoint instant = instants.start();
  for (std::size_t i = 0; i < instants.size(); ++i) {
    instant.step = instants.step(i);
    instant.x = instants.state(i);
    instant.w = instants.command(i);
    simulation.restore(instant);
    if (simulation.observe(instant.w) == StepStatus::kOk) {
      instant.solver_cache = simulation.checkpoint().solver_cache;  // a good start for the next instant
    } else {
      recorder.writeRow(instant.step, simulation.time(), instant.x, unknown);
      instant.solver_cache = instants.start().solver_cache;
    }
  }
  simulation.removeObserver(recorder);
  recorder.close();
}

}  // namespace heerk_rotor
