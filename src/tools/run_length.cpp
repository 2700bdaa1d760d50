#include "heerk_rotor/tools/run_length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "heerk_rotor/config/problems.hpp"

namespace heerk_rotor {

RunLength runLength(const SimulateOptions& options, const SimulationSettings& settings, double h) {
  const double duration = options.revolutions ? *options.revolutions * settings.revolution() : options.duration.value_or(settings.duration);
  const double exact = duration / h;
  const double rounded = std::round(exact);
  constexpr double kMost = 9007199254740992.0;  // 2^53: t = t0 + k h needs k as an exact double
  std::ostringstream text;
  text.precision(17);
  if (!(rounded <= kMost)) {
    const std::string key = options.revolutions ? "--revolutions" : options.duration ? "--duration" : "simulation.duration";
    text << duration << " s";
    Problems problems;
    problems.add({"length of the run", key, text.str(), "at most 2^53 steps of " + std::to_string(h) + " s"});
    throw ConfigurationError(problems);
  }
  RunLength length;
  length.steps = static_cast<std::uint64_t>(rounded);
  // Round-off of the quotient is no deviation: a millionth of a step, or a few units in its last place when that is more.
  const double round_off = std::max(1e-6, 4.0 * std::numeric_limits<double>::epsilon() * exact);
  // The file's default length is "about so long"; only a length that was asked for is worth a warning.
  const bool asked_for = options.revolutions || options.duration;
  if (asked_for && std::abs(exact - rounded) > round_off) {
    text.precision(10);
    text << duration << " s are " << exact << " steps of " << h << " s; running " << length.steps << " steps, "
         << static_cast<double>(length.steps) * h << " s";
    length.warning = text.str();
  }
  return length;
}

}  // namespace heerk_rotor
