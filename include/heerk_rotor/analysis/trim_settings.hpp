#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/core/coupled_system.hpp"

namespace heerk_rotor {

/// The `trim:` section of a configuration, names resolved.
struct TrimSettings {
  std::vector<Index> controls;       // entries of w that are found
  std::vector<Signal> signals;       // whose mean over a revolution is given
  std::vector<double> targets;       // its value, one per signal
  std::vector<Index> hold;           // entries of x that keep their value, though they must return to it
  double tolerance = 1e-9;           // on residuals in units of the quantity's magnitude
  long max_iterations = 30;
  long settle_revolutions = 10;      // plain run before the first iteration
};

/// Reads the section for this system; absent: the defaults, which look for the periodic motion under the default commands.
TrimSettings readTrimSettings(const Configuration& configuration, const CoupledSystem& system, Problems& problems);

}  // namespace heerk_rotor
