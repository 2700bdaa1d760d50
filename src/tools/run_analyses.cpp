#include "heerk_rotor/tools/run_analyses.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>

#include "heerk_rotor/analysis/analysis_report.hpp"
#include "heerk_rotor/analysis/coupling_picture.hpp"
#include "heerk_rotor/analysis/coupling_report.hpp"
#include "heerk_rotor/analysis/evaluation_counts.hpp"
#include "heerk_rotor/analysis/scales.hpp"
#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/assembly/file_replacement.hpp"
#include "heerk_rotor/assembly/start_file.hpp"

namespace heerk_rotor {
namespace {

constexpr double kAnalysisTolerance = 1e-12;  // of the algebraic part: differences would show a looser one as noise

/// The configuration with an algebraic tolerance good enough for differences.
Configuration forAnalysis(const RunSetup& setup) {
  if (!setup.settings.paper_tolerance && setup.settings.newton_tolerance <= kAnalysisTolerance) return setup.configuration;
  return Configuration::parse(setup.configuration.resolvedText(), setup.configuration.file(), {"simulation.newton_tolerance=1e-12"});
}

std::string revolutionProblem(const RunSetup& setup, const std::string& what) {
  Problems problems;
  const std::string key = "simulation.azimuth_step_deg";
  problems.add({setup.configuration.where("simulation"), key, "a step of " + std::to_string(setup.settings.step) + " s", what});
  return problems.text();
}

void append(Analyses& analyses, const std::string& key, const std::string& object) {
  analyses.json += (analyses.json.empty() ? "\"" : ", \"") + key + "\": " + object;
}

/// The set-up from the trimmed start: the same as loading the start file.
void startFrom(RunSetup& setup, const TrimResult& result, const SimulateOptions& options) {
  const CoupledSystem& system = setup.simulation->system();
  char residual[32];
  std::snprintf(residual, sizeof residual, "%.3e", std::max(result.worst_periodicity, result.worst_target));
  const std::string start = startText(system, result.x, result.w,
                                      {{"made_by", "simulate --trim"},
                                       {"configuration", std::filesystem::path(setup.configuration.file()).filename().string()},
                                       {"configuration_hash", configurationHash(setup.configuration)},
                                       {"largest_residual", residual}});
  if (!options.save_start.empty()) replaceFile(options.save_start, start);
  setup.configuration = setup.configuration.withStart(start, options.save_start.empty() ? "(trimmed start)" : options.save_start);
  setup.simulation = buildSimulation(setup.configuration);
  setup.command = setup.simulation->system().defaultCommand();
}

void addStability(Analyses& analyses, const std::string& key, const Stability& stability, const std::string& what, const RunSetup& setup) {
  analyses.text += text(stability, what, setup.settings.revolution());
  append(analyses, key, json(stability, setup.settings.revolution()));
}

void showCoupling(const SimulateOptions& options, const RunSetup& setup, Analyses& analyses) {
  CoupledSystem system = buildSystem(setup.configuration);
  const Coupling coupling = analyseCoupling(system);
  analyses.text += couplingText(system, coupling);
  if (!options.show_coupling->empty()) replaceFile(*options.show_coupling, couplingPicture(system, coupling));
  append(analyses, "coupling", couplingJson(system, coupling));
}

void countEvaluations(const RunSetup& setup, Analyses& analyses) {
  const auto simulation = buildSimulation(setup.configuration);
  const long steps = std::max(1l, std::lround(setup.settings.revolution() / setup.settings.step));
  const EvaluationCounts counts = countEvaluations(*simulation, setup.command, steps);
  analyses.text += text(counts);
  append(analyses, "evaluations", json(counts));
}

/// Multipliers of the revolution from the start: with periodic coefficients the step map alone hides instabilities such as ground resonance.
/// Left out where the step does not divide the revolution.
void addRevolution(Analyses& analyses, const std::function<std::unique_ptr<Simulation>()>& build, const RunSetup& setup, const Vector& scales) {
  const double revolution = setup.settings.revolution(), steps = revolution / setup.settings.step;
  if (std::abs(steps - std::round(steps)) > 1e-9 * steps) return;
  const Stability stability = revolutionStability(build, revolution, setup.simulation->state(), setup.command, scales);
  addStability(analyses, "floquet", stability, "one revolution from the start (Floquet multipliers if this is periodic)", setup);
}

/// Typical magnitudes of the states: over a revolution where the step divides it, otherwise at this instant.
Vector scalesAt(const Configuration& configuration, const RunSetup& setup, const Vector& x) {
  Vector states = x.cwiseAbs(), outputs;
  const long steps = std::max(1l, std::lround(setup.settings.revolution() / setup.settings.step));
  RevolutionMap map(buildSimulation(configuration), steps, {});
  Vector magnitudes;
  if (map.magnitudes(x, setup.command, magnitudes, outputs)) states = magnitudes;
  return stateScales(map.system(), states, setup.settings.revolution());
}

}  // namespace

Analyses runAnalyses(const SimulateOptions& options, RunSetup& setup) {
  Analyses analyses;
  Problems problems;
  const TrimSettings settings = readTrimSettings(setup.configuration, setup.simulation->system(), problems);
  if (!problems.empty()) throw ConfigurationError(problems);
  const bool asked = options.trim || options.stability || options.show_coupling || options.evaluation_counts;
  analyses.run = !asked || options.duration || options.revolutions || !options.outputs.empty() || !options.save_snapshot.empty();
  if (!asked) return analyses;
  if (options.show_coupling) showCoupling(options, setup, analyses);
  if (options.evaluation_counts) countEvaluations(setup, analyses);
  if (!options.trim && !options.stability) return analyses;

  const Vector start = setup.simulation->state();
  const Configuration configuration = forAnalysis(setup);
  const auto build = [&configuration, &start] {
    std::unique_ptr<Simulation> simulation = buildSimulation(configuration);
    simulation->setState(start);
    return simulation;
  };
  Vector scales;
  if (options.trim) {
    TrimOptions trim_options;
    if (!options.quiet && !options.json) trim_options.progress = [](const std::string& line) { std::fprintf(stderr, "trim: %s\n", line.c_str()); };
    TrimResult result;
    try {
      result = trim(build, setup.settings.revolution(), settings, trim_options);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(revolutionProblem(setup, error.what()));
    }
    analyses.text += "trim: " + text(result, settings, setup.simulation->system());
    append(analyses, "trim", json(result, settings, setup.simulation->system()));
    if (result.monodromy.size() > 0)
      addStability(analyses, "floquet", floquetStability(result.monodromy, result.period, setup.simulation->system().stateNames()), "one revolution (Floquet multipliers)", setup);
    if (!result.trimmed()) {
      analyses.status = 3;
      analyses.run = false;
      return analyses;
    }
    scales = result.scales.states;
    startFrom(setup, result, options);
  }
  if (scales.size() == 0) scales = scalesAt(configuration, setup, start);
  if (options.stability && !options.trim) addRevolution(analyses, build, setup, scales);
  addStability(analyses, "stability", stepStability(build, setup.simulation->state(), setup.command, scales), "one step", setup);
  return analyses;
}

}  // namespace heerk_rotor
