#pragma once
#include <string>

#include "heerk_rotor/tools/run_setup.hpp"

namespace heerk_rotor {

/// What --trim, --stability, --show-coupling and --evaluation-counts found, before a run that may follow.
struct Analyses {
  std::string text;         // reports for people
  std::string json;         // "\"trim\": {...}, \"stability\": {...}", or empty
  int status = 0;           // exit status so far: 3 when the trim failed
  bool run = true;          // whether the run is to follow
};

/// Does what the options ask for; after a trim the set-up continues from the trimmed state, exactly as with the start file that
/// --save-start writes. Throws ConfigurationError for a bad trim section.
Analyses runAnalyses(const SimulateOptions& options, RunSetup& setup);

}  // namespace heerk_rotor
