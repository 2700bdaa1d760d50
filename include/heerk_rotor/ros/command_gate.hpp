#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "heerk_rotor/realtime/instant.hpp"

namespace heerk_rotor {

/// A swashplate command on its way to the step thread.
struct Command {
  std::array<double, 3> values{};  // collective, lateral cyclic, longitudinal cyclic [rad]
  CommandSource source = CommandSource::kNone;
  std::int64_t arrival = 0;        // CLOCK_MONOTONIC [ns]
};

/// Travel of the swashplate [rad].
struct CommandLimits {
  double collective_min = -0.0524;
  double collective_max = 0.349;
  double cyclic_limit = 0.1745;  // both cyclics, either sign
};

struct CheckedCommand {
  enum class Verdict { kAccepted, kClamped, kRefused };
  Verdict verdict = Verdict::kAccepted;
  std::array<double, 3> values{};  // within the limits; meaningless when refused
  std::string complaint;           // which value, found, expected; empty when accepted as it is
};

/// Refuses what is not finite, clamps what is beyond the travel.
CheckedCommand checkCommand(const std::array<double, 3>& values, const CommandLimits& limits);

/// The same for a message with any number of values: refused unless there are three.
CheckedCommand checkCommand(const std::vector<double>& values, const CommandLimits& limits);

}  // namespace heerk_rotor
