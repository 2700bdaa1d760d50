#include "heerk_rotor/tools/step_loop.hpp"

#include <algorithm>
#include <chrono>

#include "heerk_rotor/tools/stop_request.hpp"

namespace heerk_rotor {
namespace {

RunStatus runStatus(StepStatus status) {
  switch (status) {
    case StepStatus::kOk: return RunStatus::kDone;
    case StepStatus::kSolverStalled: return RunStatus::kSolverStalled;
    case StepStatus::kNonFinite: return RunStatus::kNonFinite;
  }
  return RunStatus::kNonFinite;
}

bool anyFailed(const StepCompanions& companions) {
  return companions.recorders != nullptr &&
         std::any_of(companions.recorders->begin(), companions.recorders->end(), [](const auto& recorder) { return recorder->failed(); });
}

SolverCounters difference(const SolverCounters& after, const SolverCounters& before) {
  SolverCounters spent;
  spent.solves = after.solves - before.solves;
  spent.newton_iterations = after.newton_iterations - before.newton_iterations;
  spent.residual_evaluations = after.residual_evaluations - before.residual_evaluations;
  spent.jacobians = after.jacobians - before.jacobians;
  spent.factorizations = after.factorizations - before.factorizations;
  spent.pruning_failures = after.pruning_failures - before.pruning_failures;
  return spent;
}

}  // namespace

RunSummary runSteps(Simulation& simulation, std::uint64_t steps, const StepCompanions& companions) noexcept {
  RunSummary summary;
  Vector& command = *companions.command;
  const SolverCounters before = simulation.solver().counters();
  const auto start = std::chrono::steady_clock::now();
  while (summary.steps < steps) {
    if (StopRequest::signal() != 0) {
      summary.status = RunStatus::kInterrupted;
      break;
    }
    if (companions.commands != nullptr) companions.commands->apply(simulation.time(), command);
    if (companions.recent != nullptr) companions.recent->push(simulation, command);
    summary.status = runStatus(simulation.step(command));
    if (summary.status != RunStatus::kDone) break;
    ++summary.steps;
    if (anyFailed(companions)) {
      summary.status = RunStatus::kOutputFailed;
      break;
    }
    if (companions.progress != nullptr) companions.progress->update(summary.steps);
  }
  summary.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  summary.simulated_time = static_cast<double>(summary.steps) * simulation.stepSize();
  summary.spent = difference(simulation.solver().counters(), before);
  summary.state_hash = simulation.stateHash();
  return summary;
}

void recordFinalInstant(Simulation& simulation, const StepCompanions& companions, RunSummary& summary) noexcept {
  const std::uint64_t step = simulation.stepCount();
  const bool wanted = std::any_of(companions.recorders->begin(), companions.recorders->end(),
                                  [step](const auto& recorder) { return recorder->wants(step); });
  if (!wanted) return;
  Vector& command = *companions.command;
  if (companions.commands != nullptr) companions.commands->apply(simulation.time(), command);
  companions.recent->push(simulation, command);
  const RunStatus status = runStatus(simulation.observe(command));
  if (status != RunStatus::kDone) summary.status = status;
  else if (anyFailed(companions)) summary.status = RunStatus::kOutputFailed;
}

}  // namespace heerk_rotor
