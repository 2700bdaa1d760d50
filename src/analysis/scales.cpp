#include "heerk_rotor/analysis/scales.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace heerk_rotor {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kShareOfKin = 1e-3;
constexpr double kSmallest = 1e-4;  // [the unit]

std::string subsystemOf(const std::string& name) { return name.substr(0, name.find('.')); }

/// Largest magnitude by subsystem and unit.
using Kin = std::map<std::pair<std::string, std::string>, double>;

/// Motion at once per revolution relates rates to what they are rates of: a rotor in steady hover has lag angles, and lag rates
/// of round-off only.
double kinOf(const Kin& kin, const std::string& subsystem, const std::string& unit, double rotor_speed) {
  const auto largest = [&](const std::string& of) {
    const auto found = kin.find({subsystem, of});
    return found == kin.end() ? 0.0 : found->second;
  };
  double value = largest(unit), factor = 1.0;
  for (const char* per : {"/s", "/s^2"}) {
    const std::string suffix = per;
    factor *= rotor_speed;
    if (unit.size() > suffix.size() && unit.compare(unit.size() - suffix.size(), suffix.size(), suffix) == 0)
      value = std::max(value, factor * largest(unit.substr(0, unit.size() - suffix.size())));
  }
  return value;
}

}  // namespace

Vector stateScales(const CoupledSystem& system, const Vector& magnitudes, double revolution, double share_of_kin) {
  const std::vector<std::string> names = system.stateNames(), units = system.stateUnits();
  Kin kin;
  for (std::size_t i = 0; i < names.size(); ++i) {
    double& largest = kin[{subsystemOf(names[i]), units[i]}];
    largest = std::max(largest, magnitudes[static_cast<Index>(i)]);
  }
  Vector scales(magnitudes.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto entry = static_cast<Index>(i);
    scales[entry] = std::max({magnitudes[entry], share_of_kin * kinOf(kin, subsystemOf(names[i]), units[i], 2.0 * kPi / revolution), kSmallest});
  }
  return scales;
}

Vector targetScales(const CoupledSystem& system, const std::vector<Signal>& signals, const std::vector<double>& targets,
                    const Vector& state_magnitudes, const Vector& output_magnitudes) {
  const auto magnitude = [&](const Signal& signal) { return signal.kind == Signal::Kind::kState ? state_magnitudes[signal.index] : output_magnitudes[signal.index]; };
  Kin largest;
  for (const Signal& signal : system.signals()) {
    double& kin = largest[{subsystemOf(signal.name), signal.unit}];
    kin = std::max(kin, magnitude(signal));
  }
  Vector scales(static_cast<Index>(signals.size()));
  for (std::size_t k = 0; k < signals.size(); ++k) {
    const Signal& signal = signals[k];
    double scale = std::max({std::abs(targets[k]), magnitude(signal), kShareOfKin * largest[{subsystemOf(signal.name), signal.unit}]});
    if (signal.kind == Signal::Kind::kOutput)
      for (const CoupledSystem::Output& output : system.outputs())
        if (signal.index >= output.begin && signal.index < output.begin + output.size) scale = std::max(scale, output.nominal);
    scales[static_cast<Index>(k)] = std::max(scale, kSmallest);
  }
  return scales;
}

Vector controlScales(const CoupledSystem& system, const Vector& w, const std::vector<Index>& controls) {
  Vector scales(static_cast<Index>(controls.size()));
  for (std::size_t k = 0; k < controls.size(); ++k) {
    const double travel = system.commandHigh()[controls[k]] - system.commandLow()[controls[k]];
    scales[static_cast<Index>(k)] = std::isfinite(travel) && travel > 0.0 ? 0.1 * travel : std::max(std::abs(w[controls[k]]), 1.0);
  }
  return scales;
}

}  // namespace heerk_rotor
