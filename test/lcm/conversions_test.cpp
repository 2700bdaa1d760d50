#include "heerk_rotor/lcm/conversions.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace heerk_rotor {
namespace {

/// Every field another value, so that a mix-up shows.
RotorReading distinctReading(int blades) {
  RotorReading r;
  r.step = 1234567890123;
  r.epoch = 3;
  r.sim_time = 17.25;
  r.blades = blades;
  r.azimuth = 700.5;
  r.rotor_speed = 41.5;
  double next = 1.0;
  for (RotorReading::PerBlade* values : {&r.lag, &r.lag_rate, &r.flap, &r.flap_rate, &r.pitch, &r.tip_twist})
    for (double& value : *values) value = next++;
  for (double* value : {&r.lag_collective, &r.lag_cosine, &r.lag_sine, &r.flap_collective, &r.flap_cosine, &r.flap_sine}) *value = next++;
  for (auto* values : {&r.hub_force, &r.hub_moment, &r.position, &r.velocity, &r.angular_velocity})
    for (double& value : *values) value = next++;
  r.orientation = {0.1, 0.2, 0.3, 0.4};
  for (double* value : {&r.thrust_coefficient, &r.torque_coefficient, &r.power_coefficient, &r.advance_ratio, &r.collective, &r.lateral_cyclic, &r.longitudinal_cyclic}) *value = next++;
  r.inflow_states = 3;
  for (double& value : r.inflow) value = next++;
  r.newton_iterations = 9;
  r.residual_evaluations = 21;
  return r;
}

TEST(LcmConversions, everyFieldSurvivesEncodingAndDecoding) {
  const RotorReading r = distinctReading(4);
  rotor_state_t written, m;
  toLcmState(RotorInstant{r, CommandSource::kLcm}, {987654321, 11, 12}, written);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(written.getEncodedSize()));
  ASSERT_EQ(written.encode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  ASSERT_EQ(m.decode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));

  EXPECT_EQ(m.stamp, 987654321);
  EXPECT_EQ(m.step, 1234567890123);
  EXPECT_EQ(m.epoch, 3);
  EXPECT_EQ(m.sim_time, r.sim_time);
  EXPECT_EQ(m.azimuth, r.azimuth);
  EXPECT_EQ(m.rotor_speed, r.rotor_speed);
  ASSERT_EQ(m.blades, 4);
  const auto expectPerBlade = [](const std::vector<double>& found, const RotorReading::PerBlade& expected) {
    ASSERT_EQ(found.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(found[k], expected[k]);
  };
  expectPerBlade(m.lag, r.lag);
  expectPerBlade(m.lag_rate, r.lag_rate);
  expectPerBlade(m.flap, r.flap);
  expectPerBlade(m.flap_rate, r.flap_rate);
  expectPerBlade(m.pitch, r.pitch);
  expectPerBlade(m.tip_twist, r.tip_twist);
  EXPECT_EQ(m.lag_collective, r.lag_collective);
  EXPECT_EQ(m.lag_cosine, r.lag_cosine);
  EXPECT_EQ(m.lag_sine, r.lag_sine);
  EXPECT_EQ(m.flap_collective, r.flap_collective);
  EXPECT_EQ(m.flap_cosine, r.flap_cosine);
  EXPECT_EQ(m.flap_sine, r.flap_sine);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(m.hub_force[i], r.hub_force[i]);
    EXPECT_EQ(m.hub_torque[i], r.hub_moment[i]);
    EXPECT_EQ(m.fuselage_position[i], r.position[i]);
    EXPECT_EQ(m.fuselage_linear[i], r.velocity[i]);
    EXPECT_EQ(m.fuselage_angular[i], r.angular_velocity[i]);
  }
  EXPECT_EQ(m.fuselage_orientation[0], 0.2);  // x y z w from w x y z
  EXPECT_EQ(m.fuselage_orientation[1], 0.3);
  EXPECT_EQ(m.fuselage_orientation[2], 0.4);
  EXPECT_EQ(m.fuselage_orientation[3], 0.1);
  EXPECT_EQ(m.thrust_coefficient, r.thrust_coefficient);
  EXPECT_EQ(m.torque_coefficient, r.torque_coefficient);
  EXPECT_EQ(m.power_coefficient, r.power_coefficient);
  EXPECT_EQ(m.advance_ratio, r.advance_ratio);
  ASSERT_EQ(m.inflow_states, 3);
  EXPECT_EQ(m.inflow, std::vector<double>(r.inflow.begin(), r.inflow.begin() + 3));
  EXPECT_EQ(m.collective, r.collective);
  EXPECT_EQ(m.lateral_cyclic, r.lateral_cyclic);
  EXPECT_EQ(m.longitudinal_cyclic, r.longitudinal_cyclic);
  EXPECT_EQ(m.command_source, "lcm");
  EXPECT_EQ(m.newton_iterations, 9);
  EXPECT_EQ(m.residual_evaluations, 21);
  EXPECT_EQ(m.overruns, 11);
  EXPECT_EQ(m.dropped, 12);
}

TEST(LcmConversions, aReusedMessageShrinksWithTheNumberOfBlades) {
  rotor_state_t m;
  toLcmState(RotorInstant{distinctReading(5)}, {}, m);
  toLcmState(RotorInstant{distinctReading(2)}, {}, m);
  EXPECT_EQ(m.blades, 2);
  EXPECT_EQ(m.lag, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(m.tip_twist.size(), 2u);
}

}  // namespace
}  // namespace heerk_rotor
