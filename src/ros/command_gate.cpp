#include "heerk_rotor/ros/command_gate.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace heerk_rotor {

CheckedCommand checkCommand(const std::array<double, 3>& values, const CommandLimits& limits) {
  static const char* const kNames[3] = {"collective", "lateral_cyclic", "longitudinal_cyclic"};
  const double low[3] = {limits.collective_min, -limits.cyclic_limit, -limits.cyclic_limit};
  const double high[3] = {limits.collective_max, limits.cyclic_limit, limits.cyclic_limit};
  CheckedCommand checked;
  std::ostringstream complaint;
  for (std::size_t i = 0; i < 3; ++i) {
    checked.values[i] = std::clamp(values[i], low[i], high[i]);
    if (!std::isfinite(values[i])) {
      checked.verdict = CheckedCommand::Verdict::kRefused;
    } else if (checked.values[i] == values[i]) {
      continue;
    } else if (checked.verdict == CheckedCommand::Verdict::kAccepted) {
      checked.verdict = CheckedCommand::Verdict::kClamped;
    }
    complaint << (complaint.tellp() > 0 ? "; " : "") << kNames[i] << " = " << values[i] << " rad, expected [" << low[i] << ", " << high[i] << ']';
  }
  checked.complaint = complaint.str();
  return checked;
}

CheckedCommand checkCommand(const std::vector<double>& values, const CommandLimits& limits) {
  if (values.size() == 3) return checkCommand(std::array<double, 3>{values[0], values[1], values[2]}, limits);
  CheckedCommand checked;
  checked.verdict = CheckedCommand::Verdict::kRefused;
  checked.complaint = std::to_string(values.size()) + " values, expected 3: collective, lateral_cyclic, longitudinal_cyclic";
  return checked;
}

}  // namespace heerk_rotor
