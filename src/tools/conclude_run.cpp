#include "heerk_rotor/tools/conclude_run.hpp"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <sstream>

#include "heerk_rotor/assembly/file_replacement.hpp"
#include "heerk_rotor/assembly/snapshot.hpp"
#include "heerk_rotor/assembly/start_file.hpp"
#include "heerk_rotor/tools/stop_request.hpp"

namespace heerk_rotor {
namespace {

void complain(const std::string& message) { std::fprintf(stderr, "simulate: %s\n", message.c_str()); }

bool solutionFailed(const RunSummary& summary) {
  return summary.status == RunStatus::kSolverStalled || summary.status == RunStatus::kNonFinite;
}

/// An output error outranks an interruption, but not a failed solution.
void outputFailed(RunSummary& summary, const std::string& reason) {
  complain(reason);
  if (!solutionFailed(summary)) summary.status = RunStatus::kOutputFailed;
}

void closeRecorders(Recorders& recorders, RunSummary& summary) {
  for (const auto& recorder : recorders) {
    try {
      recorder->close();
    } catch (const RecordError& error) {
      outputFailed(summary, error.what());
    }
  }
}

void reportFailure(const SimulateOptions& options, RunSetup& setup, const std::vector<Signal>& signals, const RecentInstants& recent) {
  complain(text(setup.simulation->failure()));
  const std::string file = failureFile(options);
  try {
    writeFailureDump(file, *setup.simulation, recent, signals, setup.settings.rotor_speed);
    complain("the last revolution before it (" + std::to_string(recent.size()) + " instants) is in " + file);
  } catch (const RecordError& error) {
    complain(std::string("the last revolution before it could not be written: ") + error.what());
  }
}

/// The summary's object with further members in front.
std::string withMembers(const std::string& members, const std::string& object) { return members.empty() ? object : "{" + members + ", " + object.substr(1); }

/// The final state by name, so that a run with another step or other parameters can start from it; a snapshot goes on with the same ones.
void saveFinalStart(const std::string& file, const RunSetup& setup, const Simulation::Checkpoint& final) {
  replaceFile(file, startText(setup.simulation->system(), final.x, final.w,
                              {{"made_by", "simulate"},
                               {"configuration", std::filesystem::path(setup.configuration.file()).filename().string()},
                               {"configuration_hash", configurationHash(setup.configuration)},
                               {"steps", std::to_string(final.step)}}));
}

bool print(const std::string& text) { return std::fputs(text.c_str(), stdout) >= 0 && std::fflush(stdout) == 0; }

}  // namespace

std::string text(const StepFailure& failure) {
  std::ostringstream message;
  message.precision(12);
  message << "step " << failure.step << ", t = " << failure.t << " s: ";
  if (failure.status == StepStatus::kNonFinite) message << failure.where << " is not finite";
  else message << "the solver stalled at " << failure.where;
  message << ": " << failure.cause;
  return message.str();
}

std::string failureFile(const SimulateOptions& options) {
  return (options.outputs.empty() ? std::string("simulate") : options.outputs.front()) + ".failure.csv";
}

int exitStatus(RunStatus status, int signal) {
  switch (status) {
    case RunStatus::kDone: return 0;
    case RunStatus::kOutputFailed: return 1;
    case RunStatus::kInterrupted: return 128 + signal;
    case RunStatus::kSolverStalled:
    case RunStatus::kNonFinite: break;
  }
  return 3;
}

int concludeRun(const SimulateOptions& options, RunSetup& setup, const std::vector<Signal>& signals,
                const StepCompanions& companions, RunSummary summary) {
  companions.progress->finish();
  // Taken before the final instant is solved: the run that goes on from it solves that instant itself, from the same start.
  const Simulation::Checkpoint checkpoint = setup.simulation->checkpoint();
  if (!solutionFailed(summary)) recordFinalInstant(*setup.simulation, companions, summary);
  closeRecorders(*companions.recorders, summary);
  if (solutionFailed(summary)) {
    reportFailure(options, setup, signals, *companions.recent);
  } else {
    try {
      if (!options.save_snapshot.empty()) saveSnapshot(options.save_snapshot, {setup.configuration.resolvedText(), checkpoint});
      if (!options.save_start.empty() && !options.trim) saveFinalStart(options.save_start, setup, checkpoint);
    } catch (const std::exception& error) {
      outputFailed(summary, error.what());
    }
  }
  const std::string report = options.json ? withMembers(setup.json, json(summary)) : options.quiet ? "" : text(summary);
  if (!print(report)) outputFailed(summary, "the summary could not be written to the standard output");
  return exitStatus(summary.status, StopRequest::signal());
}

}  // namespace heerk_rotor
