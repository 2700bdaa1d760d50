#include "heerk_rotor/assembly/start_file.hpp"

#include <cstdint>
#include <locale>
#include <map>
#include <sstream>

#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/config/yaml_value.hpp"
#include "heerk_rotor/core/hash_text.hpp"

namespace heerk_rotor {
namespace {

const std::string kStart = "simulation.start";

/// Calls `use(subsystem, name, value)` for every number of the mapping of mappings at kStart.`part`.
template <class Use>
void forEachValue(const Configuration& configuration, const std::string& part, Problems& problems, const Use& use) {
  const std::string key = kStart + "." + part;
  const YAML::Node mapping = findValue(configuration.root(), key);
  if (!mapping.IsDefined() || mapping.IsNull()) return;
  const auto wrong = [&](const std::string& path, const YAML::Node& found, const std::string& expected) {
    problems.add({configuration.where(path), path, asWritten(found), expected});
  };
  if (!mapping.IsMap()) return wrong(key, mapping, "a mapping <subsystem>: {<name>: <value>, ...}");
  for (const auto& subsystem : mapping) {
    const std::string path = key + "." + subsystem.first.Scalar();
    if (!subsystem.second.IsMap()) {
      wrong(path, subsystem.second, "a mapping <name>: <value>");
      continue;
    }
    for (const auto& entry : subsystem.second) {
      double value = 0.0;
      const std::string& name = entry.first.Scalar();
      if (readNumber(entry.second, value)) use(subsystem.first.Scalar(), name, value);
      else wrong(path + "." + name, entry.second, "a number");
    }
  }
}

void reportValue(const Configuration& configuration, const std::string& part, const std::string& name, const std::string& expected, Problems& problems) {
  const std::string path = kStart + "." + part + "." + name;
  problems.add({configuration.where(path), path, asWritten(findValue(configuration.root(), path)), expected});
}

/// "4 states: a, b, c, ..."
std::string counted(const std::vector<std::string>& names, const std::string& what) {
  constexpr std::size_t kShown = 6;
  std::string text = std::to_string(names.size()) + " " + what + (names.size() == 1 ? ": " : "s: ");
  for (std::size_t i = 0; i < names.size() && i < kShown; ++i) text += (i > 0 ? ", " : "") + names[i];
  return text + (names.size() > kShown ? ", ..." : "");
}

void checkParts(const Configuration& configuration, Problems& problems) {
  Section start(configuration, kStart, problems);
  for (const char* part : {"provenance", "states", "commands"}) start.child(part);
  start.finish();
}

void readStates(const Configuration& configuration, const CoupledSystem& system, StartValues& start, Problems& problems) {
  std::map<std::string, Index> entries;
  std::vector<std::string> initial_wins, missing, foreign;
  const std::vector<std::string> names = system.stateNames();
  for (std::size_t i = 0; i < names.size(); ++i) entries[names[i]] = static_cast<Index>(i);

  std::vector<char> found(names.size(), 0), given(names.size(), 0);
  for (const CoupledSystem::Subsystem& subsystem : system.subsystems()) {
    const YAML::Node initial = findValue(configuration.root(), "subsystems." + subsystem.name + ".initial");
    if (!initial.IsDefined() || !initial.IsMap()) continue;
    const std::vector<State> states = subsystem.model->states();
    for (std::size_t i = 0; i < states.size(); ++i) given[static_cast<std::size_t>(subsystem.x_begin) + i] = findChild(initial, states[i].initialKey()).IsDefined();
  }
  forEachValue(configuration, "states", problems, [&](const std::string& subsystem, const std::string& name, double value) {
    const auto entry = entries.find(subsystem + "." + name);
    if (entry == entries.end()) {
      foreign.push_back(subsystem + "." + name);
      return;
    }
    const auto i = static_cast<std::size_t>(entry->second);
    found[i] = 1;
    if (given[i]) initial_wins.push_back(names[i]);
    else start.states.emplace_back(entry->second, value);
  });
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!found[i]) missing.push_back(names[i]);
  if (!foreign.empty()) start.notes.push_back("the start file belongs to another variant of this configuration: it names " + counted(foreign, "state") + ", which this one does not have");
  if (!missing.empty()) start.notes.push_back("the start file leaves out " + counted(missing, "state") + "; initial values stay");
  if (!initial_wins.empty()) start.notes.push_back("values under initial: take precedence over the start file for " + counted(initial_wins, "state"));
}

void readCommands(const Configuration& configuration, const CoupledSystem& system, StartValues& start, Problems& problems) {
  const std::vector<std::string>& names = system.commandNames();
  std::vector<std::string> foreign;
  forEachValue(configuration, "commands", problems, [&](const std::string& subsystem, const std::string& name, double value) {
    const std::string command = subsystem + "." + name;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != command) continue;
      const auto entry = static_cast<Index>(i);
      if (value >= system.commandLow()[entry] && value <= system.commandHigh()[entry]) start.command[entry] = value;
      else reportValue(configuration, "commands", command, "a value in [" + std::to_string(system.commandLow()[entry]) + ", " + std::to_string(system.commandHigh()[entry]) + "]", problems);
      return;
    }
    foreign.push_back(command);
  });
  if (!foreign.empty()) start.notes.push_back("the start file names " + counted(foreign, "command") + ", which this configuration does not take");
}

std::string exact(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << value;
  return text.str();
}

/// Names "subsystem.name" in the order of the system as a mapping of mappings.
void writeValues(std::ostringstream& out, const std::string& part, const std::vector<std::string>& names, const Vector& values) {
  if (names.empty()) return;
  out << part << ":\n";
  std::string subsystem;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t dot = names[i].find('.');
    if (names[i].substr(0, dot) != subsystem) out << "  " << (subsystem = names[i].substr(0, dot)) << ":\n";
    out << "    " << names[i].substr(dot + 1) << ": " << exact(values[static_cast<Index>(i)]) << "\n";
  }
}

}  // namespace

StartValues readStart(const Configuration& configuration, const CoupledSystem& system, Problems& problems) {
  StartValues start;
  start.command = system.defaultCommand();
  const YAML::Node value = findValue(configuration.root(), kStart);
  if (!value.IsDefined() || !value.IsMap()) return start;
  checkParts(configuration, problems);
  readStates(configuration, system, start, problems);
  readCommands(configuration, system, start, problems);
  return start;
}

std::string startText(const CoupledSystem& system, const Vector& x, const Vector& w, const Provenance& provenance) {
  std::ostringstream out;
  out << "# Start values, loaded by the key simulation.start of a configuration: entries of the state x and of the command w.\n";
  if (!provenance.empty()) out << "provenance:\n";
  for (const auto& [key, text] : provenance) out << "  " << key << ": \"" << text << "\"\n";
  writeValues(out, "states", system.stateNames(), x);
  writeValues(out, "commands", system.commandNames(), w);
  return out.str();
}

std::string configurationHash(const Configuration& configuration) {
  std::uint64_t hash = 14695981039346656037ull;  // FNV-1a
  for (const char c : configuration.resolvedText()) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return hashText(hash);
}

}  // namespace heerk_rotor
