// One run of a sweep.
#include <algorithm>
#include <exception>
#include <optional>

#include "heerk_rotor/tools/conclude_run.hpp"
#include "heerk_rotor/analysis/limit_watch.hpp"
#include "heerk_rotor/tools/run_analyses.hpp"
#include "heerk_rotor/tools/run_length.hpp"
#include "heerk_rotor/tools/run_setup.hpp"
#include "heerk_rotor/tools/run_sweep.hpp"
#include "heerk_rotor/tools/step_loop.hpp"

namespace heerk_rotor {
namespace {

/// The signals of the table that this system has, with their places in it.
std::vector<Signal> signalsOf(const CoupledSystem& system, const std::vector<Signal>& columns, std::vector<bool>& present) {
  std::vector<Signal> list;
  for (const Signal& column : columns) {
    const Signal* signal = system.findSignal(column.name);
    present.push_back(signal != nullptr);
    if (signal != nullptr) list.push_back(*signal);
  }
  return list;
}

/// All steps, a part at a time for the progress; ends early on failure or interruption.
RunSummary runInParts(Simulation& simulation, std::uint64_t steps, const StepCompanions& companions, SweepProgress& progress, std::uint64_t& parts) {
  RunSummary whole;
  for (std::uint64_t part = 1; part <= SweepProgress::kPartsOfRun && whole.status == RunStatus::kDone; ++part) {
    const std::uint64_t until = steps / SweepProgress::kPartsOfRun * part + steps % SweepProgress::kPartsOfRun * part / SweepProgress::kPartsOfRun;
    const RunSummary summary = runSteps(simulation, until - whole.steps, companions);
    whole.steps += summary.steps;
    whole.status = summary.status;
    progress.addParts(1);
    ++parts;
  }
  return whole;
}

SweepOutcome runSetUp(const SimulateOptions& options, RunSetup& setup, const std::vector<Signal>& columns, SweepProgress& progress, std::uint64_t& parts) {
  SweepOutcome outcome;
  const Analyses analyses = runAnalyses(options, setup);
  if (analyses.status != 0) return {"not_trimmed", 0, 0.0, 0, {}, {}, analyses.text};

  Simulation& simulation = *setup.simulation;
  const RunLength length = runLength(options, setup.settings, simulation.stepSize());
  std::vector<std::string> ignored;  // warnings: those of the first run were shown
  std::optional<CommandSchedule> commands;
  if (!options.commands.empty()) commands = openCommands(options.commands, simulation, ignored);
  const LimitWatch limits(simulation, setup.settings.revolution());
  const std::uint64_t first = simulation.stepCount();
  SignalStatistics statistics(signalsOf(simulation.system(), columns, outcome.present), first, first + length.steps, simulation.stepSize(), setup.settings.revolution(), options.every);
  simulation.addObserver(statistics);

  const StepCompanions companions = {&setup.command, commands ? &*commands : nullptr, nullptr, nullptr, nullptr};
  RunSummary summary = runInParts(simulation, length.steps, companions, progress, parts);
  outcome.steps = summary.steps;
  outcome.simulated_time = static_cast<double>(summary.steps) * simulation.stepSize();
  outcome.state_hash = simulation.stateHash();
  if (summary.status == RunStatus::kDone) {
    if (commands) commands->apply(simulation.time(), setup.command);
    const StepStatus final = simulation.observe(setup.command);
    if (final != StepStatus::kOk) summary.status = final == StepStatus::kNonFinite ? RunStatus::kNonFinite : RunStatus::kSolverStalled;
  }
  outcome.status = name(summary.status);
  if (summary.status == RunStatus::kSolverStalled || summary.status == RunStatus::kNonFinite) outcome.message = text(simulation.failure());
  for (const std::string& reached : limits.warnings()) outcome.message += (outcome.message.empty() ? "" : "; ") + reached;
  std::size_t i = 0;
  for (const bool present : outcome.present) outcome.summaries.push_back(present ? statistics.summary(i++) : SignalSummary());
  return outcome;
}

}  // namespace

SweepOutcome runOne(const SimulateOptions& options, const Sweep& sweep, std::uint64_t run, const std::vector<Signal>& columns, SweepProgress& progress) noexcept {
  std::uint64_t parts = 0;
  SweepOutcome outcome;
  try {
    SimulateOptions own = sweep.optionsOf(run, options);
    own.quiet = true;
    RunSetup setup = setUpRun(own);
    outcome = runSetUp(own, setup, columns, progress, parts);
  } catch (const ConfigurationError& error) {
    outcome.status = "bad_configuration";
    outcome.message = error.what();
  } catch (const std::exception& error) {
    outcome.status = "error";
    outcome.message = error.what();
  }
  progress.addParts(SweepProgress::kPartsOfRun - parts);
  return outcome;
}

}  // namespace heerk_rotor
