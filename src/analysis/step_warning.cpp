#include "heerk_rotor/analysis/step_warning.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "heerk_rotor/analysis/scales.hpp"
#include "heerk_rotor/analysis/stability.hpp"
#include "heerk_rotor/assembly/build_simulation.hpp"

namespace heerk_rotor {
namespace {
constexpr double kHarmless = 1e-4;       // growth per step that may pass
constexpr double kResolved = 0.5;        // |h s| of a motion that the step resolves: such a one grows, if at all, as the linearised rotor does
constexpr double kShareOfTheRun = 0.05;  // that the check may cost
}  // namespace

std::string stepWarning(const Configuration& configuration, const Simulation& simulation, const Vector& command, double revolution, std::uint64_t run_steps) {
  const Vector x = simulation.state();
  if (x.size() == 0 || 2.0 * static_cast<double>(x.size()) > kShareOfTheRun * static_cast<double>(run_steps)) return "";
  const auto build = [&configuration, &x] {
    std::unique_ptr<Simulation> copy = buildSimulation(configuration);
    copy->setState(x);
    return copy;
  };
  Stability stability;
  try {
    stability = stepStability(build, x, command, stateScales(simulation.system(), x.cwiseAbs(), revolution), 1);
  } catch (const std::runtime_error&) {
    return "";
  }
  const auto found = std::find_if(stability.modes.begin(), stability.modes.end(), [](const Multiplier& m) { return std::abs(m.mu) > 1.0 + kHarmless && std::abs(std::log(m.mu)) > kResolved; });
  if (found == stability.modes.end()) return "";
  const Multiplier& worst = *found;
  char text[512];
  std::snprintf(text, sizeof text,
                "%s is unstable with a step of %g s: at the start one step multiplies small deviations by up to %.6g (%s, %.4g Hz); expected at most 1; hint: %s",
                simulation.method().name().c_str(), simulation.stepSize(), std::abs(worst.mu), worst.state.c_str(), worst.frequency,
                simulation.method().exponential() ? "a smaller step, HEERK4, or more of the damping in S" : "a smaller step, or HEERK4");
  return text;
}

}  // namespace heerk_rotor
