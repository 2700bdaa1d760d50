#include "heerk_rotor/models/speed_ramp.hpp"

#include <algorithm>
#include <cmath>

#include "model_factories.hpp"

namespace heerk_rotor {

SpeedRamp::SpeedRamp(const Parameters& p) : p_(p), acceleration_(0.0), duration_(0.0) {
  if (p.initial_speed == p.final_speed) return;
  acceleration_ = std::copysign(p.acceleration, p.final_speed - p.initial_speed);
  duration_ = (p.final_speed - p.initial_speed) / acceleration_;
}

std::vector<OutputPort> SpeedRamp::outputs() const {
  return {{"drive", 3, "rad, rad/s, rad/s^2", "angle, rate and acceleration of the drive relative to Omega t", {}, 1.0, {"drive_angle", "drive_rate", "drive_acceleration"}, false, {"rad", "rad/s", "rad/s^2"}}};
}

void SpeedRamp::evalOutput(Index, double t, const In&, const In&, Out y) noexcept {
  const double on_ramp = std::clamp(t - p_.start, 0.0, duration_);
  const double after = std::max(0.0, t - p_.start - duration_);
  const double initial = p_.initial_speed - p_.rotor_speed, final = p_.final_speed - p_.rotor_speed;
  const bool done = t - p_.start >= duration_;
  y[0] = initial * (t - after) + 0.5 * acceleration_ * on_ramp * on_ramp + final * after;
  y[1] = done ? final : initial + acceleration_ * on_ramp;
  y[2] = !done && t >= p_.start ? acceleration_ : 0.0;
}

Made makeSpeedRamp(Section& section, const BuildContext& context) {
  constexpr double kRpm = 3.14159265358979323846 / 30.0;
  const double nominal = context.simulation.rotor_speed;
  SpeedRamp::Parameters p;
  p.rotor_speed = nominal;
  // A speed that is not given is the nominal one to the last bit, and so is one that is given as the nominal speed was.
  p.initial_speed = section.has("initial_speed_rpm") ? section.number("initial_speed_rpm", 0.0, "rpm", nonNegative()) * kRpm : nominal;
  p.final_speed = section.has("final_speed_rpm") ? section.number("final_speed_rpm", 0.0, "rpm", nonNegative()) * kRpm : nominal;
  if (p.initial_speed != p.final_speed) p.acceleration = section.requiredNumber("acceleration_rpm_per_s", "rpm/s", positive()) * kRpm;
  for (const char* key : {"initial_speed_rpm", "final_speed_rpm", "acceleration_rpm_per_s"}) section.text(key);  // known, also when it has no effect
  p.start = section.number("start", p.start, "s", nonNegative());
  section.finish();
  return std::make_unique<SpeedRamp>(p);
}

}  // namespace heerk_rotor
