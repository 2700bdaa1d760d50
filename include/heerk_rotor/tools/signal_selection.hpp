#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"

namespace heerk_rotor {

/// The signals to record, each once, in the order asked for. A name is a signal ("rotor.lag_1"), a group of numbered
/// signals or an output port ("rotor.lag" is rotor.lag_1, rotor.lag_2, ...), or "all". No names: the published signals.
/// Throws ConfigurationError that lists every unknown name with the nearest known one.
std::vector<Signal> selectSignals(const CoupledSystem& system, const std::vector<std::string>& names);

/// The table of --list-signals: name, unit, kind, whether it is recorded by default, and what it means (frame, sign).
std::string signalTable(const CoupledSystem& system);

}  // namespace heerk_rotor
