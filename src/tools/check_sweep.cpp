#include <algorithm>
#include <exception>

#include "heerk_rotor/tools/run_length.hpp"
#include "heerk_rotor/tools/run_setup.hpp"
#include "heerk_rotor/tools/run_sweep.hpp"
#include "heerk_rotor/tools/signal_selection.hpp"

namespace heerk_rotor {
namespace {

// Quoted text is no number, flag or mapping, and no word that any key knows: what the key expects instead says its unit.
const char* const kNothingMeant = "=\"?\"";

bool startsWith(const std::string& text, const std::string& begin) { return text.compare(0, begin.size(), begin) == 0; }

/// Unit of a key; a problem when nothing is called so.
std::string probe(const SimulateOptions& options, const Sweep& sweep, std::size_t number, const std::string& where, Problems& problems) {
  const std::uint64_t run = sweep.firstRunWith(number);
  const std::string key = sweep.keys()[number];
  SimulateOptions own = sweep.optionsOf(run, options);
  own.overrides.push_back(key + kNothingMeant);
  try {
    setUpRun(own);
  } catch (const ConfigurationError& error) {
    for (const Problem& problem : error.problems.list())
      if (problem.unknown_key && (problem.key == key || startsWith(key, problem.key + "."))) {
        problems.add({where, key, sweep.values(run)[number], problem.expected});
        return "";
      }
    for (const Problem& problem : error.problems.list())
      if (problem.key == key) return problem.unit;
  } catch (const std::exception&) {  // no answer, no unit
  }
  return "";
}

}  // namespace

SweepColumns checkSweep(const SimulateOptions& options, const Sweep& sweep) {
  SweepColumns columns;
  Problems problems;
  std::size_t number = 0;
  for (const SweepAxis& axis : sweep.axes())
    for (std::size_t k = 0; k < axis.keys.size(); ++k) columns.units.push_back(probe(options, sweep, number++, axis.where, problems));
  if (!problems.empty()) throw ConfigurationError(problems);

  std::exception_ptr first;
  for (std::uint64_t run = 0; run < sweep.size(); ++run) {
    std::unique_ptr<RunSetup> setup;
    try {
      setup = std::make_unique<RunSetup>(setUpRun(sweep.optionsOf(run, options)));
    } catch (const std::exception&) {
      if (!first) first = std::current_exception();
      continue;
    }
    columns.signals = selectSignals(setup->simulation->system(), options.signals);
    columns.warnings = setup->notes;
    const RunLength length = runLength(options, setup->settings, setup->simulation->stepSize());
    if (!length.warning.empty()) columns.warnings.push_back(length.warning);
    if (!options.commands.empty()) openCommands(options.commands, *setup->simulation, columns.warnings);
    return columns;
  }
  std::rethrow_exception(first);
}

}  // namespace heerk_rotor
