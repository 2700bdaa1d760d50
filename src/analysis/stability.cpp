#include "heerk_rotor/analysis/stability.hpp"

#include <stdexcept>

#include "heerk_rotor/analysis/trim.hpp"

namespace heerk_rotor {

namespace {

Stability mapStability(const std::function<std::unique_ptr<Simulation>()>& build, long steps, const Vector& x, const Vector& w, const Vector& scales, unsigned threads) {
  const MapTeam maps = makeTeam(build, steps, {}, threads);
  // Wider than for a trim, which wants a direction only: 1e-9 of an eigenvalue is wanted, and central differences forgive it.
  DifferenceOptions options;
  options.width = 1e-4;
  options.central = true;
  const MapGradient gradient = differenceMap(maps, x, w, {}, {scales, Vector(), Vector()}, options);
  if (!gradient.complete) throw std::runtime_error("stability: a step from a slightly changed state failed");
  return floquetStability(gradient.scaled, maps.front()->period(), maps.front()->system().stateNames());
}

}  // namespace

Stability stepStability(const std::function<std::unique_ptr<Simulation>()>& build, const Vector& x, const Vector& w, const Vector& scales, unsigned threads) {
  return mapStability(build, 1, x, w, scales, threads);
}

Stability revolutionStability(const std::function<std::unique_ptr<Simulation>()>& build, double revolution, const Vector& x, const Vector& w, const Vector& scales, unsigned threads) {
  return mapStability(build, stepsPerRevolution(revolution, build()->stepSize()), x, w, scales, threads);
}

Stability floquetStability(const Matrix& monodromy, double period, const std::vector<std::string>& state_names) {
  Stability stability;
  stability.period = period;
  stability.modes = multipliers(monodromy, period, state_names);
  if (!stability.modes.empty()) stability.spectral_radius = std::abs(stability.modes.front().mu);
  return stability;
}

}  // namespace heerk_rotor
