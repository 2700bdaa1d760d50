#include "heerk_rotor/analysis/trim.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "heerk_rotor/analysis/scales.hpp"
#include "shooting.hpp"

namespace heerk_rotor {

long stepsPerRevolution(double revolution, double h) {
  const long steps = std::lround(revolution / h);
  if (steps < 1 || std::abs(static_cast<double>(steps) * h - revolution) > 1e-9 * revolution)
    throw std::invalid_argument("a revolution of " + std::to_string(revolution) + " s is " + std::to_string(revolution / h) +
                                " steps, expected a whole number; give simulation.azimuth_step_deg that divides 360");
  return steps;
}

MapTeam makeTeam(const std::function<std::unique_ptr<Simulation>()>& build, long steps, const std::vector<Signal>& signals, unsigned threads) {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  MapTeam maps;
  for (unsigned i = 0; i < threads; ++i) maps.push_back(std::make_unique<RevolutionMap>(build(), steps, signals));
  return maps;
}

TrimResult trim(const std::function<std::unique_ptr<Simulation>()>& build, double revolution, const TrimSettings& settings, const TrimOptions& options) {
  std::unique_ptr<Simulation> first = build();
  const long steps = stepsPerRevolution(revolution, first->stepSize());
  MapTeam maps = makeTeam(build, steps, settings.signals, options.threads);
  for (const auto& each : maps) each->setCancel(options.cancel);
  RevolutionMap& map = *maps.front();
  const CoupledSystem& system = map.system();

  TrimResult result;
  result.period = map.period();
  result.x = map.simulation().state();
  result.w = system.defaultCommand();
  result.means = Vector::Zero(static_cast<Index>(settings.signals.size()));
  result.periodicity = Vector::Zero(result.x.size());
  for (const Index control : settings.controls) result.w[control] = std::clamp(result.w[control], system.commandLow()[control], system.commandHigh()[control]);
  const auto finish = [&] {
    for (const auto& each : maps) result.revolutions += each->revolutions();
    return result;
  };
  Vector settled = result.x, outputs, states;
  const Vector start = result.x;
  if (!map.settle(settled, result.w, settings.settle_revolutions) || !map.magnitudes(settled, result.w, states, outputs)) {
    result.message = "the run before the first iteration failed: " + map.simulation().failure().where + ", " + map.simulation().failure().cause;
    return finish();
  }
  result.x = settled;
  for (const Index held : settings.hold) result.x[held] = start[held];
  result.scales = {stateScales(system, states, result.period), targetScales(system, settings.signals, settings.targets, states, outputs), controlScales(system, result.w, settings.controls),
                   stateScales(system, states, result.period, 1.0)};
  for (const auto& each : maps) each->setBase(map.base());

  result.message = "a revolution from the settled state failed";
  Shooting(maps, settings, options, result).solve();
  return finish();
}

}  // namespace heerk_rotor
