#pragma once
#include <string>

#include "heerk_rotor/tools/sweep.hpp"

namespace heerk_rotor {

/// The runs that a file lists, as one axis.
/// *.csv: a header line of dotted keys (a unit in brackets behind a key is not read), then one line per run; an empty cell leaves the
/// configuration's own value, a cell in double quotes may hold commas; empty lines and lines that start with # are skipped.
/// *.yaml, *.yml: a list of runs, each a list of words KEY=VALUE, or a mapping written as in the configuration: - subsystems: {mast: {stiffness: 3e6}}.
/// Problems carry file and line.
SweepAxis readSweepFile(const std::string& file, Problems& problems);

/// The same from text; the ending of `name` says which format it is.
SweepAxis parseSweepFile(const std::string& text, const std::string& name, Problems& problems);

}  // namespace heerk_rotor
