#include "heerk_rotor/ros/conversions.hpp"

namespace heerk_rotor {
namespace {

void assign(const RotorReading::PerBlade& values, int size, std::vector<double>& target) {
  target.assign(values.begin(), values.begin() + size);
}

template <class Vector3>
void assign(const std::array<double, 3>& values, Vector3& target) {
  target.x = values[0];
  target.y = values[1];
  target.z = values[2];
}

void assign(const std::array<double, 4>& wxyz, geometry_msgs::Quaternion& target) {
  target.w = wxyz[0];
  target.x = wxyz[1];
  target.y = wxyz[2];
  target.z = wxyz[3];
}

}  // namespace

void toRotorState(const RotorInstant& instant, const ros::Time& stamp, const PublisherNote& note, RotorState& message) {
  const RotorReading& reading = instant.reading;
  message.header.stamp = stamp;
  message.header.frame_id = frames::kHub;
  message.step = reading.step;
  message.epoch = reading.epoch;
  message.sim_time = reading.sim_time;
  message.azimuth = reading.azimuth;
  message.rotor_speed = reading.rotor_speed;
  assign(reading.lag, reading.blades, message.lag);
  assign(reading.lag_rate, reading.blades, message.lag_rate);
  assign(reading.flap, reading.blades, message.flap);
  assign(reading.flap_rate, reading.blades, message.flap_rate);
  assign(reading.pitch, reading.blades, message.pitch);
  assign(reading.tip_twist, reading.blades, message.tip_twist);
  message.lag_collective = reading.lag_collective;
  message.lag_cosine = reading.lag_cosine;
  message.lag_sine = reading.lag_sine;
  message.flap_collective = reading.flap_collective;
  message.flap_cosine = reading.flap_cosine;
  message.flap_sine = reading.flap_sine;
  assign(reading.hub_force, message.hub.force);
  assign(reading.hub_moment, message.hub.torque);
  assign(reading.position, message.fuselage_pose.position);
  assign(reading.orientation, message.fuselage_pose.orientation);
  assign(reading.velocity, message.fuselage_twist.linear);
  assign(reading.angular_velocity, message.fuselage_twist.angular);
  message.thrust_coefficient = reading.thrust_coefficient;
  message.torque_coefficient = reading.torque_coefficient;
  message.power_coefficient = reading.power_coefficient;
  message.advance_ratio = reading.advance_ratio;
  message.inflow.assign(reading.inflow.begin(), reading.inflow.begin() + reading.inflow_states);
  message.collective = reading.collective;
  message.lateral_cyclic = reading.lateral_cyclic;
  message.longitudinal_cyclic = reading.longitudinal_cyclic;
  message.command_source = name(instant.source);
  message.newton_iterations = reading.newton_iterations;
  message.residual_evaluations = reading.residual_evaluations;
  message.overruns = note.overruns;
  message.dropped = note.dropped;
}

void toShaftState(const ShaftInstant& instant, const ros::Time& stamp, const PublisherNote& note, ShaftState& message) {
  const ShaftReading& reading = instant.reading;
  message.header.stamp = stamp;
  message.header.frame_id = frames::kShaft;
  message.step = reading.step;
  message.epoch = reading.epoch;
  message.sim_time = reading.sim_time;
  message.azimuth = reading.azimuth;
  message.rotor_speed = reading.rotor_speed;
  message.disc_x.assign(reading.disc_x.begin(), reading.disc_x.begin() + reading.discs);
  message.disc_y.assign(reading.disc_y.begin(), reading.disc_y.begin() + reading.discs);
  message.journal_x = reading.journal_x;
  message.journal_y = reading.journal_y;
  message.eccentricity_ratio = reading.eccentricity_ratio;
  message.bearing_force_x = reading.bearing_force_x;
  message.bearing_force_y = reading.bearing_force_y;
  message.film_force_x = reading.film_force_x;
  message.film_force_y = reading.film_force_y;
  message.newton_iterations = reading.newton_iterations;
  message.residual_evaluations = reading.residual_evaluations;
  message.overruns = note.overruns;
  message.dropped = note.dropped;
}

void toLagAngles(const RotorReading& reading, const ros::Time& stamp, BladeAngles& message) {
  message.header.stamp = stamp;
  message.header.frame_id = frames::kHub;
  message.step = reading.step;
  assign(reading.lag, reading.blades, message.angle);
  assign(reading.lag_rate, reading.blades, message.rate);
}

void toHubWrench(const RotorReading& reading, const ros::Time& stamp, geometry_msgs::WrenchStamped& message) {
  message.header.stamp = stamp;
  message.header.frame_id = frames::kHub;
  assign(reading.hub_force, message.wrench.force);
  assign(reading.hub_moment, message.wrench.torque);
}

void toOdometry(const RotorReading& reading, const ros::Time& stamp, nav_msgs::Odometry& message) {
  message.header.stamp = stamp;
  message.header.frame_id = frames::kOdom;
  message.child_frame_id = frames::kBase;
  assign(reading.position, message.pose.pose.position);
  assign(reading.orientation, message.pose.pose.orientation);
  assign(reading.velocity, message.twist.twist.linear);
  assign(reading.angular_velocity, message.twist.twist.angular);
}

void toTransform(const RotorReading& reading, const ros::Time& stamp, geometry_msgs::TransformStamped& message) {
  message.header.stamp = stamp;
  message.header.frame_id = frames::kOdom;
  message.child_frame_id = frames::kBase;
  assign(reading.position, message.transform.translation);
  assign(reading.orientation, message.transform.rotation);
}

void toJointState(const RotorReading& reading, const ros::Time& stamp, sensor_msgs::JointState& message) {
  message.header.stamp = stamp;
  const std::size_t joints = 1 + 3 * static_cast<std::size_t>(reading.blades);
  if (message.name.size() != joints) {
    message.name = {"rotor_joint"};
    for (int k = 1; k <= reading.blades; ++k)
      for (const char* motion : {"flap", "lag", "pitch"}) message.name.push_back("blade_" + std::to_string(k) + "_" + motion + "_joint");
  }
  message.position.assign({reading.azimuth});
  message.velocity.assign({reading.rotor_speed});
  for (int k = 0; k < reading.blades; ++k) {
    message.position.insert(message.position.end(), {reading.flap[k], reading.lag[k], reading.pitch[k]});
    message.velocity.insert(message.velocity.end(), {reading.flap_rate[k], reading.lag_rate[k], reading.pitch_rate[k]});
  }
}

}  // namespace heerk_rotor
