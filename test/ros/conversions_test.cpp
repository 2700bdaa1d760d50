#include "heerk_rotor/ros/conversions.hpp"

#include <gtest/gtest.h>

#include "heerk_rotor/ros/stamp_base.hpp"

namespace heerk_rotor {
namespace {

/// Every field another value, so that a mix-up shows.
RotorReading distinctReading() {
  RotorReading r;
  r.step = 1234567890123;
  r.epoch = 3;
  r.sim_time = 17.25;
  r.blades = 4;
  r.azimuth = 700.5;
  r.rotor_speed = 41.5;
  double next = 1.0;
  for (RotorReading::PerBlade* values : {&r.lag, &r.lag_rate, &r.flap, &r.flap_rate, &r.pitch, &r.pitch_rate, &r.tip_twist})
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

std::vector<double> firstFour(const RotorReading::PerBlade& values) { return {values.begin(), values.begin() + 4}; }

template <class Vector3>
std::array<double, 3> array(const Vector3& v) {
  return {v.x, v.y, v.z};
}

const ros::Time kStamp(100, 5);

TEST(RosConversions, rotorStateHoldsEveryField) {
  const RotorReading r = distinctReading();
  RotorState m;
  toRotorState({r, CommandSource::kRos}, kStamp, {11, 12}, m);
  EXPECT_EQ(m.header.stamp, kStamp);
  EXPECT_EQ(m.header.frame_id, "hub_link");
  EXPECT_EQ(m.step, r.step);
  EXPECT_EQ(m.epoch, 3u);
  EXPECT_EQ(m.sim_time, r.sim_time);
  EXPECT_EQ(m.azimuth, r.azimuth);
  EXPECT_EQ(m.rotor_speed, r.rotor_speed);
  EXPECT_EQ(m.lag, firstFour(r.lag));
  EXPECT_EQ(m.lag_rate, firstFour(r.lag_rate));
  EXPECT_EQ(m.flap, firstFour(r.flap));
  EXPECT_EQ(m.flap_rate, firstFour(r.flap_rate));
  EXPECT_EQ(m.pitch, firstFour(r.pitch));
  EXPECT_EQ(m.tip_twist, firstFour(r.tip_twist));
  EXPECT_EQ(m.lag_collective, r.lag_collective);
  EXPECT_EQ(m.lag_cosine, r.lag_cosine);
  EXPECT_EQ(m.lag_sine, r.lag_sine);
  EXPECT_EQ(m.flap_collective, r.flap_collective);
  EXPECT_EQ(m.flap_cosine, r.flap_cosine);
  EXPECT_EQ(m.flap_sine, r.flap_sine);
  EXPECT_EQ(array(m.hub.force), r.hub_force);
  EXPECT_EQ(array(m.hub.torque), r.hub_moment);
  EXPECT_EQ(array(m.fuselage_pose.position), r.position);
  EXPECT_EQ(m.fuselage_pose.orientation.w, 0.1);
  EXPECT_EQ(m.fuselage_pose.orientation.x, 0.2);
  EXPECT_EQ(m.fuselage_pose.orientation.y, 0.3);
  EXPECT_EQ(m.fuselage_pose.orientation.z, 0.4);
  EXPECT_EQ(array(m.fuselage_twist.linear), r.velocity);
  EXPECT_EQ(array(m.fuselage_twist.angular), r.angular_velocity);
  EXPECT_EQ(m.thrust_coefficient, r.thrust_coefficient);
  EXPECT_EQ(m.torque_coefficient, r.torque_coefficient);
  EXPECT_EQ(m.power_coefficient, r.power_coefficient);
  EXPECT_EQ(m.advance_ratio, r.advance_ratio);
  EXPECT_EQ(m.inflow, std::vector<double>(r.inflow.begin(), r.inflow.begin() + 3));
  EXPECT_EQ(m.collective, r.collective);
  EXPECT_EQ(m.lateral_cyclic, r.lateral_cyclic);
  EXPECT_EQ(m.longitudinal_cyclic, r.longitudinal_cyclic);
  EXPECT_EQ(m.command_source, "ros");
  EXPECT_EQ(m.newton_iterations, 9u);
  EXPECT_EQ(m.residual_evaluations, 21u);
  EXPECT_EQ(m.overruns, 11u);
  EXPECT_EQ(m.dropped, 12u);
}

TEST(RosConversions, odometryAndTransformSayTheSame) {
  const RotorReading r = distinctReading();
  nav_msgs::Odometry odometry;
  geometry_msgs::TransformStamped transform;
  toOdometry(r, kStamp, odometry);
  toTransform(r, kStamp, transform);
  EXPECT_EQ(odometry.header.frame_id, "odom");
  EXPECT_EQ(odometry.child_frame_id, "base_link");
  EXPECT_EQ(transform.header.frame_id, "odom");
  EXPECT_EQ(transform.child_frame_id, "base_link");
  EXPECT_EQ(array(odometry.pose.pose.position), r.position);
  EXPECT_EQ(array(transform.transform.translation), r.position);
  EXPECT_EQ(odometry.pose.pose.orientation, transform.transform.rotation);
  EXPECT_EQ(transform.transform.rotation.w, 0.1);
  EXPECT_EQ(array(odometry.twist.twist.linear), r.velocity);
  EXPECT_EQ(array(odometry.twist.twist.angular), r.angular_velocity);
}

TEST(RosConversions, lagAnglesAndHubWrench) {
  const RotorReading r = distinctReading();
  BladeAngles lag;
  geometry_msgs::WrenchStamped wrench;
  toLagAngles(r, kStamp, lag);
  toHubWrench(r, kStamp, wrench);
  EXPECT_EQ(lag.step, r.step);
  EXPECT_EQ(lag.angle, firstFour(r.lag));
  EXPECT_EQ(lag.rate, firstFour(r.lag_rate));
  EXPECT_EQ(wrench.header.frame_id, "hub_link");
  EXPECT_EQ(array(wrench.wrench.force), r.hub_force);
  EXPECT_EQ(array(wrench.wrench.torque), r.hub_moment);
}

TEST(RosConversions, jointsAreNamedPerBladeAndFollowItsNumber) {
  RotorReading r = distinctReading();
  sensor_msgs::JointState joints;
  toJointState(r, kStamp, joints);
  ASSERT_EQ(joints.name.size(), 13u);
  EXPECT_EQ(joints.name[0], "rotor_joint");
  EXPECT_EQ(joints.name[4], "blade_2_flap_joint");
  EXPECT_EQ(joints.name[5], "blade_2_lag_joint");
  EXPECT_EQ(joints.name[6], "blade_2_pitch_joint");
  ASSERT_EQ(joints.position.size(), 13u);
  ASSERT_EQ(joints.velocity.size(), 13u);
  EXPECT_EQ(joints.position[0], r.azimuth);
  EXPECT_EQ(joints.position[4], r.flap[1]);
  EXPECT_EQ(joints.position[5], r.lag[1]);
  EXPECT_EQ(joints.position[6], r.pitch[1]);
  EXPECT_EQ(joints.velocity[4], r.flap_rate[1]);
  EXPECT_EQ(joints.velocity[5], r.lag_rate[1]);
  EXPECT_EQ(joints.velocity[6], r.pitch_rate[1]);
  r.blades = 2;
  toJointState(r, kStamp, joints);  // the same message again
  EXPECT_EQ(joints.name.size(), 7u);
  EXPECT_EQ(joints.position.size(), 7u);
}

TEST(StampBase, addsSimulationTimeToTheStart) {
  EXPECT_EQ(StampBase{5000000000}.at(1.25), ros::Time(6, 250000000));
  EXPECT_EQ(StampBase{}.at(3600.000000001), ros::Time(3600, 1));
}

}  // namespace
}  // namespace heerk_rotor
