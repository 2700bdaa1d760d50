#include "heerk_rotor/models/inflow_ports.hpp"

#include <algorithm>
#include <cmath>

namespace heerk_rotor {
namespace {
constexpr double kFloor = 1e-4;  // [-], over Omega R: well below any inflow that matters (hover: 0.05)
}

std::vector<InputPort> inflowInputs() {
  return {{"rotor_loads", 3, "-", "aerodynamic thrust coefficient and its first harmonics over the disc", Unconnected::kError, {}, {"thrust", "sine", "cosine"}},
          {"hub_flow", 3, "-", "velocity of the hub through the air in hub_link over Omega R (forward, left, up)", Unconnected::kDefault, {}, {"forward", "left", "up"}}};
}

std::vector<OutputPort> inflowOutputs(std::vector<std::string> feedthrough) {
  return {{"inflow", 3, "-", "induced flow over Omega R, downwards positive: mean, sine and cosine part", std::move(feedthrough), 0.05,
           {"inflow_mean", "inflow_sine", "inflow_cosine"}, true}};
}

double readInducedPowerFactor(Section& section) { return section.number("induced_power_factor", 1.0, "-", {0.5, 2.0, false}); }

void acceptKeysOfAllInflowModels(Section& section) {
  section.flag("corrected_mass", false);
  for (const char* part : {"mean", "sine", "cosine"}) section.number(part, 0.0, "-", {-1.0, 1.0, false});
}

WindAxes::WindAxes(double forward, double left) noexcept
    : mu(std::hypot(forward, left)), cosine(mu > 0.0 ? forward / mu : 1.0), sine(mu > 0.0 ? left / mu : 0.0) {}

void WindAxes::toWind(double sine_part, double cosine_part, double& sine_wind, double& cosine_wind) const noexcept {
  sine_wind = sine_part * cosine - cosine_part * sine;
  cosine_wind = cosine_part * cosine + sine_part * sine;
}

void WindAxes::toHub(double sine_wind, double cosine_wind, double& sine_part, double& cosine_part) const noexcept {
  sine_part = sine_wind * cosine + cosine_wind * sine;
  cosine_part = cosine_wind * cosine - sine_wind * sine;
}

double halfSkewTangent(double mu, double through_flow) noexcept {
  const double total = std::sqrt(mu * mu + through_flow * through_flow + kFloor * kFloor);
  return std::min(1.0, mu / (total + through_flow));
}

double glauertInflow(double thrust_coefficient, double mu, double mu_z) noexcept {
  // For thrust against the flow mirror the problem, so that the root is positive.
  const double sign = thrust_coefficient < 0.0 ? -1.0 : 1.0, target = std::abs(thrust_coefficient), climb = sign * mu_z;
  const auto excess = [&](double l) { return 2.0 * l * std::sqrt(mu * mu + (climb + l) * (climb + l) + kFloor * kFloor) - target; };
  // Bracket [0, hover inflow + |descent|]: the function is negative at 0 and positive at the end. Newton, kept inside.
  double low = 0.0, high = std::sqrt(0.5 * target) + std::max(0.0, -climb) + kFloor;
  double l = high;
  for (int i = 0; i < 60; ++i) {
    const double value = excess(l);
    (value > 0.0 ? high : low) = l;
    const double total = std::sqrt(mu * mu + (climb + l) * (climb + l) + kFloor * kFloor);
    const double slope = 2.0 * total + 2.0 * l * (climb + l) / total;
    double next = l - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - l) <= 1e-16 + 4e-16 * l) return sign * next;
    l = next;
  }
  return sign * l;
}

}  // namespace heerk_rotor
