#include "heerk_rotor/tools/run_setup.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/assembly/command_view.hpp"
#include "heerk_rotor/assembly/snapshot.hpp"
#include "heerk_rotor/assembly/start_file.hpp"

namespace heerk_rotor {
namespace {

/// How far --load-snapshot was carried on is no property of the system.
const char* const kFreeKey = "simulation.duration";

using FlatConfiguration = std::map<std::string, std::string>;  // dotted key -> scalar as written

void flatten(const YAML::Node& node, const std::string& path, FlatConfiguration& flat) {
  const auto child = [&path](const std::string& key) { return path.empty() ? key : path + "." + key; };
  if (node.IsMap()) {
    for (const auto& entry : node) flatten(entry.second, child(entry.first.as<std::string>()), flat);
  } else if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) flatten(node[i], child(std::to_string(i)), flat);
  } else {
    flat[path] = node.IsScalar() ? node.Scalar() : "(empty)";
  }
}

bool sameValue(const std::string& a, const std::string& b) {
  if (a == b) return true;
  char* end_a = nullptr;
  char* end_b = nullptr;
  const double number_a = std::strtod(a.c_str(), &end_a), number_b = std::strtod(b.c_str(), &end_b);
  return !a.empty() && !b.empty() && *end_a == '\0' && *end_b == '\0' && number_a == number_b;
}

/// A simulation of that configuration at its initial instant.
RunSetup fresh(Configuration configuration) {
  std::unique_ptr<Simulation> simulation = buildSimulation(configuration);
  Problems problems;
  SimulationSettings settings = readSimulationSettings(configuration, problems);
  std::vector<std::string> notes = readStart(configuration, simulation->system(), problems).notes;
  if (!problems.empty()) throw ConfigurationError(problems);
  Vector command = simulation->system().defaultCommand();
  return {std::move(configuration), std::move(settings), std::move(simulation), std::move(command), std::move(notes), ""};
}

/// What the user says the snapshot's configuration is; nothing said: nothing returned.
std::optional<Configuration> statedConfiguration(const SimulateOptions& options, const std::string& snapshot_text,
                                                 const std::string& snapshot_name) {
  if (!options.configuration.empty()) return Configuration::load(options.configuration, options.overrides);
  if (!options.overrides.empty()) return Configuration::parse(snapshot_text, snapshot_name, options.overrides);
  return {};
}

RunSetup continued(const SimulateOptions& options) {
  const Snapshot snapshot = loadSnapshot(options.load_snapshot);
  const std::string name = options.load_snapshot + " (configuration)";
  Configuration configuration = Configuration::parse(snapshot.configuration, name);
  if (const auto stated = statedConfiguration(options, snapshot.configuration, name)) {
    const Problems problems = differences(*stated, configuration);
    if (!problems.empty()) throw ConfigurationError(problems);
    configuration = *stated;
  }
  RunSetup setup = fresh(std::move(configuration));
  try {
    setup.simulation->restore(snapshot.checkpoint);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(options.load_snapshot + ": state and configuration do not fit each other: " + error.what());
  }
  if (snapshot.checkpoint.w.size() == setup.command.size()) setup.command = snapshot.checkpoint.w;
  return setup;
}

}  // namespace

Problems differences(const Configuration& given, const Configuration& expected) {
  FlatConfiguration mine, theirs;
  flatten(given.root(), "", mine);
  flatten(expected.root(), "", theirs);
  mine.erase(kFreeKey);
  theirs.erase(kFreeKey);
  Problems problems;
  for (const auto& [key, value] : mine) {
    const auto other = theirs.find(key);
    if (other == theirs.end()) problems.add({given.where(key), key, value, "no such key, as in the snapshot"});
    else if (!sameValue(value, other->second)) problems.add({given.where(key), key, value, other->second + ", as in the snapshot"});
  }
  for (const auto& [key, value] : theirs)
    if (mine.count(key) == 0) problems.add({given.where(key), key, "(absent)", value + ", as in the snapshot"});
  return problems;
}

RunSetup setUpRun(const SimulateOptions& options) {
  if (!options.load_snapshot.empty()) return continued(options);
  return fresh(Configuration::load(options.configuration, options.overrides));
}

namespace {

/// What the model would clamp is clamped here already, so that recorded commands are those in effect.
void clampToRange(std::vector<CommandRow>& rows, const std::array<Index, 3>& entries, const CoupledSystem& system, const std::string& file,
                  std::vector<std::string>& warnings) {
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const double low = system.commandLow()[entries[k]], high = system.commandHigh()[entries[k]];
    std::size_t clamped = 0;
    double first = 0.0;
    for (CommandRow& row : rows) {
      const double allowed = std::clamp(row.commands[k], low, high);
      if (allowed == row.commands[k]) continue;
      if (clamped++ == 0) first = row.time;
      row.commands[k] = allowed;
    }
    if (clamped == 0) continue;
    std::ostringstream warning;
    warning << file << ": " << system.commandNames()[static_cast<std::size_t>(entries[k])] << " of " << clamped << " rows clamped to the travel [" << low << ", " << high
            << "] rad, first at " << first << " s";
    warnings.push_back(warning.str());
  }
}

}  // namespace

CommandSchedule openCommands(const std::string& file, const Simulation& simulation, std::vector<std::string>& warnings) {
  std::vector<CommandRow> rows = readCommandFile(file);
  const CommandView commands(simulation.system());
  const std::array<Index, 3> entries = {commands.collective(), commands.lateralCyclic(), commands.longitudinalCyclic()};
  for (const Index entry : entries)
    if (entry < 0) {
      std::string taken;
      for (const std::string& name : simulation.system().commandNames()) taken += (taken.empty() ? "" : ", ") + name;
      Problems problems;
      problems.add({"command line", "--commands", file,
                    "a configuration whose swashplate takes collective, lateral_cyclic and longitudinal_cyclic; this one takes " +
                        (taken.empty() ? std::string("no commands") : taken)});
      throw ConfigurationError(problems);
    }
  clampToRange(rows, entries, simulation.system(), file, warnings);
  // A millionth of a step absorbs the round-off of t = t0 + k h up to about 1e9 steps.
  return CommandSchedule(std::move(rows), entries, 1e-6 * simulation.stepSize());
}

}  // namespace heerk_rotor
