#include "heerk_rotor/analysis/trim_settings.hpp"

#include <algorithm>

#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/core/nearest_name.hpp"

namespace heerk_rotor {
namespace {

/// Names of a list key as places in `known`; a name that is unknown or given twice is a problem at its line.
std::vector<Index> places(const Configuration& configuration, Section& section, const std::string& key, const std::string& what,
                          const std::vector<std::string>& known, Problems& problems) {
  std::vector<Index> result;
  const std::vector<std::string> names = section.words(key);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string path = section.path() + "." + key + "." + std::to_string(i);
    const auto found = std::find(known.begin(), known.end(), names[i]);
    const auto place = static_cast<Index>(found - known.begin());
    if (found == known.end()) {
      problems.add({configuration.where(path), path, names[i], "the name of a " + what + " of this system" + (known.empty() ? "; it has none" : didYouMean(names[i], known))});
    } else if (std::find(result.begin(), result.end(), place) != result.end()) {
      problems.add({configuration.where(path), path, names[i], "each " + what + " once"});
    } else {
      result.push_back(place);
    }
  }
  return result;
}

void readTargets(const Configuration& configuration, const CoupledSystem& system, Section& section, TrimSettings& settings, Problems& problems) {
  Section targets = section.child("targets");
  std::vector<std::string> known;
  for (const Signal& signal : system.signals()) known.push_back(signal.name);
  for (const std::string& subsystem : targets.keys()) {
    Section entries = targets.child(subsystem);
    for (const std::string& name : entries.keys()) {
      const std::string signal = subsystem + "." + name, path = targets.path() + "." + signal;
      const Signal* found = system.findSignal(signal);
      const double value = entries.requiredNumber(name, found != nullptr ? found->unit : "");
      if (found == nullptr) {
        problems.add({configuration.where(path), path, entries.text(name), "the name of a signal of this system" + didYouMean(signal, known)});
        continue;
      }
      settings.signals.push_back(*found);
      settings.targets.push_back(value);
    }
    entries.finish();
  }
  targets.finish();
}

}  // namespace

TrimSettings readTrimSettings(const Configuration& configuration, const CoupledSystem& system, Problems& problems) {
  TrimSettings settings;
  Section section(configuration, "trim", problems);
  settings.controls = places(configuration, section, "controls", "command", system.commandNames(), problems);
  settings.hold = places(configuration, section, "hold", "state", system.stateNames(), problems);
  readTargets(configuration, system, section, settings, problems);
  Range tolerance = positive();
  tolerance.high = 1e-2;  // what returns to within a per cent is no periodic motion
  settings.tolerance = section.number("tolerance", settings.tolerance, "of the quantity's magnitude", tolerance);
  settings.max_iterations = section.integer("max_iterations", settings.max_iterations, 1, 1000);
  settings.settle_revolutions = section.integer("settle_revolutions", settings.settle_revolutions, 0, 100000);
  section.finish();
  if (settings.signals.size() > settings.controls.size() + settings.hold.size() || (settings.controls.empty() && !settings.signals.empty()))
    section.problem("targets", "at most one target per control (and per held state), found " + std::to_string(settings.signals.size()) + " for " +
                                   std::to_string(settings.controls.size()) + " controls");
  return settings;
}

}  // namespace heerk_rotor
