#pragma once
#include <memory>
#include <string>

#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// A snapshot file: format version, the resolved configuration text and a Simulation::Checkpoint with every double exact.
/// It needs no other file, so it can be moved between folders and machines.
struct Snapshot {
  static constexpr int kVersion = 1;
  std::string configuration;  // Configuration::resolvedText()
  Simulation::Checkpoint checkpoint;
};

/// Writes to a temporary name beside `file` and renames, so that a file is complete or absent. Throws std::runtime_error.
void saveSnapshot(const std::string& file, const Snapshot& snapshot);

/// Throws std::runtime_error naming the file and what is wrong (not a snapshot, version, truncated, non-finite state).
Snapshot loadSnapshot(const std::string& file);

}  // namespace heerk_rotor
