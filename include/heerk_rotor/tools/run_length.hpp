#pragma once
#include <cstdint>
#include <string>

#include "heerk_rotor/config/simulation_settings.hpp"
#include "heerk_rotor/tools/simulate_options.hpp"

namespace heerk_rotor {

/// How many steps a run takes.
struct RunLength {
  std::uint64_t steps = 0;
  std::string warning;  // not empty when the length asked for is no multiple of the step
};

/// From --duration, --revolutions or simulation.duration: the nearest whole number of steps of h [s].
/// Throws ConfigurationError when that is more than a step counter kept in a double can hold exactly (2^53).
RunLength runLength(const SimulateOptions& options, const SimulationSettings& settings, double h);

}  // namespace heerk_rotor
