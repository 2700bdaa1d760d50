#pragma once
#include <string>
#include <utility>
#include <vector>

#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/core/coupled_system.hpp"

namespace heerk_rotor {

/// A start file holds states and commands by name, as `simulate --save-start FILE` writes them (with --trim: the trimmed ones), and the key
/// simulation.start of a configuration loads them:
///   provenance: {configuration: NAME, configuration_hash: 16 digits, ...}      for people, without effect
///   states:   {rotor: {lag_1: -0.034, ...}, ...}
///   commands: {swashplate: {collective: 0.17}, ...}
/// These are entries of x and w as they are, not what `initial:` takes (which models may still complete). A state that has a value
/// under `initial:` in the configuration keeps that one; a state that the file does not name keeps its initial value. Names that this
/// system does not have are passed over with a note: one line that swaps a model must not need another start file.
struct StartValues {
  std::vector<std::pair<Index, double>> states;  // entry of x, value
  Vector command;                                // (commandSize()) the defaults where the file says nothing
  std::vector<std::string> notes;                // what the file leaves open, and where `initial:` takes precedence
};

/// Reads simulation.start for this system; nothing there: the declared values and no note. Values that are no numbers, or out of
/// a command's range, become problems.
StartValues readStart(const Configuration& configuration, const CoupledSystem& system, Problems& problems);

/// A fact about where start values come from: key and value.
using Provenance = std::vector<std::pair<std::string, std::string>>;

/// The text of a start file. Numbers have 17 digits, so that they read back bit by bit.
std::string startText(const CoupledSystem& system, const Vector& x, const Vector& w, const Provenance& provenance);

/// 64-bit hash of the resolved configuration, 16 hexadecimal digits.
std::string configurationHash(const Configuration& configuration);

}  // namespace heerk_rotor
