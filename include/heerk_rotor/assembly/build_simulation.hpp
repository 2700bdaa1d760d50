#pragma once
#include <memory>

#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/config/simulation_settings.hpp"
#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// The coupled system a configuration describes, initial values applied. Throws ConfigurationError with all problems:
/// unknown types and keys, values out of range, connections that do not fit, unconnected inputs, loops that are not index 1.
CoupledSystem buildSystem(const Configuration& configuration);

/// The one way from a configuration to a simulation: node, tools and tests all use it.
std::unique_ptr<Simulation> buildSimulation(const Configuration& configuration);

}  // namespace heerk_rotor
