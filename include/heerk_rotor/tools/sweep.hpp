#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "heerk_rotor/config/problems.hpp"
#include "heerk_rotor/tools/simulate_options.hpp"

namespace heerk_rotor {

constexpr std::uint64_t kMostRuns = 1000000;  // of a sweep; what is larger was not meant

/// Keys of the configuration that vary together, and the values they take one after the other.
struct SweepAxis {
  std::string where;                             // "--sweep subsystems.mast.stiffness" or the name of the file, for messages
  std::vector<std::string> keys;                 // dotted
  std::vector<std::vector<std::string>> points;  // [point][key]: a value as after `--set KEY=`, or "" where the configuration's own value stays
};

/// All combinations of the points of one or more axes. Runs are numbered from 0; the last axis varies fastest.
class Sweep {
 public:
  explicit Sweep(std::vector<SweepAxis> axes);

  std::uint64_t size() const { return size_; }
  const std::vector<SweepAxis>& axes() const { return axes_; }
  /// The keys of all axes, in order.
  std::vector<std::string> keys() const;
  /// Their values in one run; "" where the configuration's own value stays.
  std::vector<std::string> values(std::uint64_t run) const;
  /// The same as overrides KEY=VALUE, to be applied after those of the command line.
  std::vector<std::string> overrides(std::uint64_t run) const;
  /// The options of one run: the common ones with these overrides after their own.
  SimulateOptions optionsOf(std::uint64_t run, SimulateOptions common) const;
  /// The first run in which that key (its number in keys()) is set, or 0 when it is set in none.
  std::uint64_t firstRunWith(std::size_t key) const;

 private:
  std::vector<SweepAxis> axes_;
  std::uint64_t size_ = 1;
};

/// One axis from KEY=ITEM,ITEM,... Each item is a value as for --set, or a range FROM:TO:COUNT (equal steps, both ends included) or
/// FROM:TO:COUNT:log (equal ratios). Commas and colons within brackets or quotes belong to the value. Values of ranges have 15 digits.
SweepAxis parseSweepAxis(const std::string& text, Problems& problems);

/// The sweep that --sweep-file and --sweep ask for: the runs of the file outermost, then the --sweep options in order.
/// Throws ConfigurationError with everything wrong: malformed items, a key that is set or swept twice, too many runs, a file that cannot be read.
Sweep readSweep(const SimulateOptions& options);

}  // namespace heerk_rotor
