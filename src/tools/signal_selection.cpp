#include "heerk_rotor/tools/signal_selection.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>

#include "heerk_rotor/config/problems.hpp"
#include "heerk_rotor/core/nearest_name.hpp"

namespace heerk_rotor {
namespace {

/// "rotor.lag" of "rotor.lag_12"; "" when the name is not numbered.
std::string groupOf(const std::string& name) {
  const std::size_t digits = name.find_last_not_of("0123456789");
  if (digits == std::string::npos || digits + 1 == name.size() || name[digits] != '_') return "";
  return name.substr(0, digits);
}

/// What one name stands for; empty when it is unknown.
std::vector<Signal> expand(const CoupledSystem& system, const std::string& name) {
  if (name == "all") return system.signals();
  if (const Signal* signal = system.findSignal(name)) return {*signal};
  std::vector<Signal> group;
  for (const Signal& signal : system.signals())
    if (groupOf(signal.name) == name) group.push_back(signal);
  if (!group.empty()) return group;
  // An output port whose entries have names of their own (hub_force: hub_force_x, ...).
  for (const CoupledSystem::Output& port : system.outputs())
    if (port.name == name)
      for (const Signal& signal : system.signals())
        if (signal.kind == Signal::Kind::kOutput && signal.index >= port.begin && signal.index < port.begin + port.size)
          group.push_back(signal);
  return group;
}

std::vector<std::string> knownNames(const CoupledSystem& system) {
  std::set<std::string> names = {"all"};
  for (const Signal& signal : system.signals()) {
    names.insert(signal.name);
    const std::string group = groupOf(signal.name);
    if (!group.empty()) names.insert(group);
  }
  for (const CoupledSystem::Output& port : system.outputs()) names.insert(port.name);
  return {names.begin(), names.end()};
}

/// Columns on a terminal, not bytes: units such as "°" take several bytes.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::vector<Signal> selectSignals(const CoupledSystem& system, const std::vector<std::string>& names) {
  std::vector<Signal> selection;
  if (names.empty()) {
    std::copy_if(system.signals().begin(), system.signals().end(), std::back_inserter(selection),
                 [](const Signal& signal) { return signal.published; });
    return selection;
  }
  Problems problems;
  std::set<std::string> taken;
  for (const std::string& name : names) {
    const std::vector<Signal> found = expand(system, name);
    if (found.empty())
      problems.add({"--signals", "signal", name, "a signal of this configuration, see --list-signals" + didYouMean(name, knownNames(system))});
    for (const Signal& signal : found)
      if (taken.insert(signal.name).second) selection.push_back(signal);
  }
  if (!problems.empty()) throw ConfigurationError(problems);
  return selection;
}

std::string signalTable(const CoupledSystem& system) {
  std::vector<std::vector<std::string>> rows = {{"name", "unit", "kind", "default", "meaning (frame, sign)"}};
  for (const Signal& signal : system.signals())
    rows.push_back({signal.name, "[" + (signal.unit.empty() ? "-" : signal.unit) + "]",
                    signal.kind == Signal::Kind::kState ? "state" : "output", signal.published ? "yes" : "no", signal.meaning});
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  std::ostringstream table;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) table << row[i] << std::string(widths[i] - width(row[i]) + 2, ' ');
    table << row.back() << '\n';
  }
  return table.str();
}

}  // namespace heerk_rotor
