#include "heerk_rotor/assembly/rotor_view.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "heerk_rotor/assembly/non_finite.hpp"

namespace heerk_rotor {
namespace {

constexpr double kTwoPi = 6.283185307179586476925;

void fail(const std::string& what) { throw std::invalid_argument("rotor view: " + what); }

/// Multiblade coordinates of one quantity: (1/N) sum q, (2/N) sum q cos psi_k, (2/N) sum q sin psi_k.
void multiblade(const RotorReading::PerBlade& values, int blades, double azimuth, double& collective, double& cosine, double& sine) noexcept {
  collective = cosine = sine = 0.0;
  for (int k = 0; k < blades; ++k) {
    const double psi = azimuth + kTwoPi * k / blades;
    collective += values[k] / blades;
    cosine += 2.0 * values[k] * std::cos(psi) / blades;
    sine += 2.0 * values[k] * std::sin(psi) / blades;
  }
}

}  // namespace

bool isFinite(const RotorReading& r) noexcept {
  double sum = 0.0;
  for (const RotorReading::PerBlade* values : {&r.lag, &r.lag_rate, &r.flap, &r.flap_rate, &r.pitch, &r.pitch_rate, &r.tip_twist}) sum += nonFinite(*values);
  for (const auto* values : {&r.hub_force, &r.hub_moment, &r.position, &r.velocity, &r.angular_velocity}) sum += nonFinite(*values);
  sum += nonFinite(r.orientation) + nonFinite(r.inflow);
  sum += nonFinite(std::array<double, 6>{r.azimuth, r.rotor_speed, r.thrust_coefficient, r.torque_coefficient, r.power_coefficient, r.advance_ratio});
  return sum == 0.0;
}

RotorView::RotorView(const CoupledSystem& system) : commands_(system) {
  const auto find = [&system](const std::string& quantity, Index size) { return findPort(system, "rotor view", quantity, size); };
  // Quantities per blade must agree on the number of blades, which the first one present decides.
  std::string counted;
  const auto findPerBlade = [&](const std::string& quantity) {
    const PortRange range = find(quantity, 0);
    if (!range.present()) return range;
    if (range.size > RotorReading::kMaxBlades)
      fail(quantity + " has " + std::to_string(range.size) + " blades, expected at most " + std::to_string(RotorReading::kMaxBlades));
    if (!counted.empty() && range.size != blades_)
      fail(quantity + " has " + std::to_string(range.size) + " blades, but " + counted + " has " + std::to_string(blades_));
    counted = quantity;
    blades_ = static_cast<int>(range.size);
    return range;
  };

  azimuth_ = find("azimuth", 1);
  rotor_speed_ = find("rotor_speed", 1);
  lag_ = findPerBlade("lag");
  lag_rate_ = findPerBlade("lag_rate");
  flap_ = findPerBlade("flap");
  flap_rate_ = findPerBlade("flap_rate");
  pitch_ = findPerBlade("pitch");
  pitch_rate_ = findPerBlade("pitch_rate");
  tip_twist_ = findPerBlade("tip_twist");
  hub_force_ = find("hub_force", 3);
  hub_moment_ = find("hub_moment", 3);
  position_ = find("fuselage_position", 3);
  velocity_ = find("fuselage_velocity", 3);
  orientation_ = find("fuselage_orientation", 4);
  rates_ = find("fuselage_rates", 3);
  thrust_coefficient_ = find("thrust_coefficient", 1);
  torque_coefficient_ = find("torque_coefficient", 1);
  power_coefficient_ = find("power_coefficient", 1);
  advance_ratio_ = find("advance_ratio", 1);
  inflow_ = find("inflow", 0);
  if (inflow_.size > RotorReading::kMaxInflow)
    fail("inflow has " + std::to_string(inflow_.size) + " entries, expected at most " + std::to_string(RotorReading::kMaxInflow));
}

void RotorView::read(const Sample& sample, RotorReading& reading) const noexcept {
  const auto copy = [&sample](const PortRange& range, auto& target) {
    if (range.present()) std::copy_n(sample.y.data() + range.begin, range.size, target.begin());
  };
  const auto value = [&sample](const PortRange& range) { return range.present() ? sample.y[range.begin] : 0.0; };
  const auto command = [&sample](Index entry) { return entry >= 0 ? sample.w[entry] : 0.0; };

  reading.step = sample.step;
  reading.epoch = sample.epoch;
  reading.sim_time = sample.t;
  reading.blades = blades_;
  reading.azimuth = value(azimuth_);
  reading.rotor_speed = value(rotor_speed_);
  copy(lag_, reading.lag);
  copy(lag_rate_, reading.lag_rate);
  copy(flap_, reading.flap);
  copy(flap_rate_, reading.flap_rate);
  copy(pitch_, reading.pitch);
  copy(pitch_rate_, reading.pitch_rate);
  copy(tip_twist_, reading.tip_twist);
  multiblade(reading.lag, blades_, reading.azimuth, reading.lag_collective, reading.lag_cosine, reading.lag_sine);
  multiblade(reading.flap, blades_, reading.azimuth, reading.flap_collective, reading.flap_cosine, reading.flap_sine);
  copy(hub_force_, reading.hub_force);
  copy(hub_moment_, reading.hub_moment);
  copy(position_, reading.position);
  copy(velocity_, reading.velocity);
  copy(orientation_, reading.orientation);
  copy(rates_, reading.angular_velocity);
  reading.thrust_coefficient = value(thrust_coefficient_);
  reading.torque_coefficient = value(torque_coefficient_);
  reading.power_coefficient = value(power_coefficient_);
  reading.advance_ratio = value(advance_ratio_);
  reading.inflow_states = static_cast<int>(inflow_.size);
  copy(inflow_, reading.inflow);
  reading.collective = command(commands_.collective());
  reading.lateral_cyclic = command(commands_.lateralCyclic());
  reading.longitudinal_cyclic = command(commands_.longitudinalCyclic());

  reading.newton_iterations = static_cast<std::uint32_t>(sample.newton_iterations);
  reading.residual_evaluations = static_cast<std::uint32_t>(sample.residual_evaluations);
}

}  // namespace heerk_rotor
