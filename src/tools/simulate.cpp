// The program `simulate`: one configuration, advanced as fast as possible and recorded to files. See --help.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>

#include "heerk_rotor/analysis/step_warning.hpp"
#include "heerk_rotor/tools/conclude_run.hpp"
#include "heerk_rotor/analysis/limit_watch.hpp"
#include "heerk_rotor/tools/run_analyses.hpp"
#include "heerk_rotor/tools/run_length.hpp"
#include "heerk_rotor/tools/run_sweep.hpp"
#include "heerk_rotor/tools/signal_selection.hpp"
#include "heerk_rotor/tools/stop_request.hpp"

namespace {

using namespace heerk_rotor;

int print(const std::string& text) { return std::fputs(text.c_str(), stdout) >= 0 && std::fflush(stdout) == 0 ? 0 : 1; }

void warn(const SimulateOptions& options, const std::string& text) {
  if (!text.empty() && !options.quiet) std::fprintf(stderr, "simulate: warning: %s\n", text.c_str());
}

std::string unusedSignals(const SimulateOptions& options) {
  const bool used = std::any_of(options.outputs.begin(), options.outputs.end(), [](const std::string& file) { return outputKind(file) == OutputKind::kCsv; });
  return used || options.signals.empty() ? "" : "--signals chooses the columns of .csv outputs; there is none";
}

int run(const SimulateOptions& options, RunSetup& setup) {
  // Everything that can be wrong shows here, before any file is written.
  Simulation& simulation = *setup.simulation;
  const std::vector<Signal> signals = selectSignals(simulation.system(), options.signals);
  const RunLength length = runLength(options, setup.settings, simulation.stepSize());
  std::optional<CommandSchedule> commands;
  std::vector<std::string> warnings;
  if (!options.commands.empty()) commands = openCommands(options.commands, simulation, warnings);
  Recorders recorders = openRecorders(options, setup, signals);
  for (const std::string& warning : warnings) warn(options, warning);
  warn(options, length.warning);
  warn(options, unusedSignals(options));
  if (!options.quiet) warn(options, stepWarning(setup.configuration, simulation, setup.command, setup.settings.revolution(), length.steps));

  // The run.
  const StopRequest stop;
  const LimitWatch limits(simulation, setup.settings.revolution());
  RecentInstants recent(simulation, setup.settings.revolution());
  ProgressBar progress(length.steps, simulation.stepSize(), !options.quiet);
  const StepCompanions companions = {&setup.command, commands ? &*commands : nullptr, &recorders, &recent, &progress};
  const RunSummary summary = runSteps(simulation, length.steps, companions);

  // Files, messages, exit status.
  const int status = concludeRun(options, setup, signals, companions, summary);
  for (const std::string& reached : limits.warnings()) warn(options, reached);
  return status;
}

int analyseAndRun(const SimulateOptions& options) {
  if (options.isSweep() && !options.list_signals) return runSweep(options);
  RunSetup setup = setUpRun(options);
  if (options.list_signals) return print(signalTable(setup.simulation->system()));
  for (const std::string& note : setup.notes) warn(options, note);
  const Analyses analyses = runAnalyses(options, setup);
  if (!analyses.run) return std::max(analyses.status, print(options.json ? "{" + analyses.json + "}\n" : analyses.text));
  if (!options.json && print(analyses.text) != 0) return 1;
  setup.json = analyses.json;
  return run(options, setup);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const SimulateOptions options = parseSimulateOptions(argc, argv);
    return options.help.empty() ? analyseAndRun(options) : print(options.help);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "simulate: %s\n", error.what());
    return 2;
  }
}
