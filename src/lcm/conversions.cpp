#include "heerk_rotor/lcm/conversions.hpp"

#include <algorithm>

namespace heerk_rotor {

void toLcmState(const RotorInstant& instant, const LcmNote& note, rotor_state_t& message) {
  const RotorReading& reading = instant.reading;
  const auto perBlade = [&reading](const RotorReading::PerBlade& values, std::vector<double>& target) {
    target.assign(values.begin(), values.begin() + reading.blades);
  };
  message.stamp = note.stamp;
  message.step = static_cast<std::int64_t>(reading.step);
  message.epoch = static_cast<std::int32_t>(reading.epoch);
  message.sim_time = reading.sim_time;
  message.azimuth = reading.azimuth;
  message.rotor_speed = reading.rotor_speed;
  message.blades = reading.blades;
  perBlade(reading.lag, message.lag);
  perBlade(reading.lag_rate, message.lag_rate);
  perBlade(reading.flap, message.flap);
  perBlade(reading.flap_rate, message.flap_rate);
  perBlade(reading.pitch, message.pitch);
  perBlade(reading.tip_twist, message.tip_twist);
  message.lag_collective = reading.lag_collective;
  message.lag_cosine = reading.lag_cosine;
  message.lag_sine = reading.lag_sine;
  message.flap_collective = reading.flap_collective;
  message.flap_cosine = reading.flap_cosine;
  message.flap_sine = reading.flap_sine;
  std::copy(reading.hub_force.begin(), reading.hub_force.end(), message.hub_force);
  std::copy(reading.hub_moment.begin(), reading.hub_moment.end(), message.hub_torque);
  std::copy(reading.position.begin(), reading.position.end(), message.fuselage_position);
  // The message has x y z w, the reading w x y z.
  std::rotate_copy(reading.orientation.begin(), reading.orientation.begin() + 1, reading.orientation.end(), message.fuselage_orientation);
  std::copy(reading.velocity.begin(), reading.velocity.end(), message.fuselage_linear);
  std::copy(reading.angular_velocity.begin(), reading.angular_velocity.end(), message.fuselage_angular);
  message.thrust_coefficient = reading.thrust_coefficient;
  message.torque_coefficient = reading.torque_coefficient;
  message.power_coefficient = reading.power_coefficient;
  message.advance_ratio = reading.advance_ratio;
  message.inflow_states = reading.inflow_states;
  message.inflow.assign(reading.inflow.begin(), reading.inflow.begin() + reading.inflow_states);
  message.collective = reading.collective;
  message.lateral_cyclic = reading.lateral_cyclic;
  message.longitudinal_cyclic = reading.longitudinal_cyclic;
  message.command_source = name(instant.source);
  message.newton_iterations = static_cast<std::int32_t>(reading.newton_iterations);
  message.residual_evaluations = static_cast<std::int32_t>(reading.residual_evaluations);
  message.overruns = static_cast<std::int64_t>(note.overruns);
  message.dropped = static_cast<std::int64_t>(note.dropped);
}

void toLcmState(const ShaftInstant& instant, const LcmNote& note, shaft_state_t& message) {
  const ShaftReading& reading = instant.reading;
  message.stamp = note.stamp;
  message.step = static_cast<std::int64_t>(reading.step);
  message.epoch = static_cast<std::int32_t>(reading.epoch);
  message.sim_time = reading.sim_time;
  message.azimuth = reading.azimuth;
  message.rotor_speed = reading.rotor_speed;
  message.discs = reading.discs;
  message.disc_x.assign(reading.disc_x.begin(), reading.disc_x.begin() + reading.discs);
  message.disc_y.assign(reading.disc_y.begin(), reading.disc_y.begin() + reading.discs);
  message.journal_x = reading.journal_x;
  message.journal_y = reading.journal_y;
  message.eccentricity_ratio = reading.eccentricity_ratio;
  message.bearing_force_x = reading.bearing_force_x;
  message.bearing_force_y = reading.bearing_force_y;
  message.film_force_x = reading.film_force_x;
  message.film_force_y = reading.film_force_y;
  message.newton_iterations = static_cast<std::int32_t>(reading.newton_iterations);
  message.residual_evaluations = static_cast<std::int32_t>(reading.residual_evaluations);
  message.overruns = static_cast<std::int64_t>(note.overruns);
  message.dropped = static_cast<std::int64_t>(note.dropped);
}

}  // namespace heerk_rotor
