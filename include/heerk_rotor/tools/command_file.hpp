#pragma once
#include <array>
#include <string>
#include <vector>

#include "heerk_rotor/core/types.hpp"

namespace heerk_rotor {

/// Swashplate commands over time: each row holds from its time until the next one.
struct CommandRow {
  double time;                      // [s] of simulation time
  std::array<double, 3> commands;   // collective, lateral_cyclic (theta1c), longitudinal_cyclic (theta1s) [rad]
};

/// Reads a CSV file with a header line that names the columns time, collective, lateral_cyclic and longitudinal_cyclic
/// (any order; a unit in brackets is allowed and must be [s] or [rad]). Empty lines and lines that start with # are
/// skipped. Throws ConfigurationError with all problems as file:line: cells that are no finite number, rows with too
/// few or too many cells, time that does not increase, unknown or missing columns, no rows at all.
std::vector<CommandRow> readCommandFile(const std::string& file);

/// The same from text; `name` stands for the file in messages.
std::vector<CommandRow> parseCommandFile(const std::string& text, const std::string& name);

/// Plays rows into the command vector w as time goes on.
class CommandSchedule {
 public:
  /// entries: where the three commands are in w. `slack` [s]: a row counts as reached when it is at most that much in
  /// the future, so that round-off of t = t0 + k h does not delay it by a whole step.
  CommandSchedule(std::vector<CommandRow> rows, std::array<Index, 3> entries, double slack);

  /// Writes the row in effect at time t into w; before the first row w stays as it is. t must not decrease.
  void apply(double t, Vector& w) noexcept;

 private:
  std::vector<CommandRow> rows_;
  std::array<Index, 3> entries_;
  double slack_;
  std::size_t next_ = 0;  // first row that is not reached yet
};

}  // namespace heerk_rotor
