// What the node publishes on its own: completeness, agreement of the topics with each other, rates, stamps.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/WrenchStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <map>

#include "heerk_rotor/BladeAngles.h"
#include "heerk_rotor/RotorState.h"
#include "ros/node/node_process.hpp"
#include "ros/node/offline_run.hpp"

namespace heerk_rotor {
namespace {

struct StateStream : ::testing::Test {
  Collector<RotorState> states{"rotor/state"};
  NodeProcess node;
};

TEST_F(StateStream, everyPublishedStepArrivesOnceInOrderAndEqualsTheOfflineRun) {
  node.set("publish_every", 3);
  node.start();
  ASSERT_TRUE(states.waitForSize(2000)) << node.output();
  node.interrupt();
  const std::vector<RotorState> all = states.messages();
  OfflineRun offline(shippedConfig("lag_rotor_controlled.yaml"));
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(all[i].step, all[0].step + 3 * i);
    EXPECT_EQ(all[i].epoch, 0u);
    EXPECT_EQ(all[i].dropped, 0u);
    EXPECT_EQ(all[i].command_source, "none");
    EXPECT_EQ(all[i].header.frame_id, "hub_link");
    // Header stamp = ROS time at the start + simulation time, to the nanosecond.
    EXPECT_NEAR((all[i].header.stamp - all[0].header.stamp).toSec(), all[i].sim_time - all[0].sim_time, 2e-9);
    expectSamePhysics(all[i], offline.at(all[i].step));
  }
}

TEST_F(StateStream, theOtherTopicsAgreeWithTheState) {
  Collector<BladeAngles> lags("rotor/lag_angles");
  Collector<geometry_msgs::WrenchStamped> wrenches("rotor/hub_wrench");
  Collector<sensor_msgs::JointState> joints("joint_states");
  Collector<nav_msgs::Odometry> odometry("rotor/odom");
  Collector<tf2_msgs::TFMessage> transforms("/tf");
  Collector<visualization_msgs::MarkerArray> markers("rotor/blades");
  node.set("publish_every", 1);
  // A lively start, so that equal values mean something.
  const std::vector<std::string> lively = {"subsystems.rotor.initial.lag_1=0.02", "subsystems.rotor.initial.fuselage_x=0.01", "subsystems.swashplate.trim_lateral_cyclic=0.02"};
  node.set("set", lively);
  node.start();
  ASSERT_TRUE(markers.waitForSize(90)) << node.output();
  node.interrupt();

  std::map<std::pair<std::uint32_t, std::uint32_t>, RotorState> by_stamp;
  for (const RotorState& state : states.messages()) by_stamp[{state.header.stamp.sec, state.header.stamp.nsec}] = state;
  const auto find = [&](const ros::Time& stamp) {
    const auto found = by_stamp.find({stamp.sec, stamp.nsec});
    return found == by_stamp.end() ? nullptr : &found->second;
  };
  std::size_t matched = 0;
  for (const BladeAngles& lag : lags.messages()) {
    const RotorState* state = find(lag.header.stamp);
    if (state == nullptr) continue;
    ++matched;
    ASSERT_EQ(lag.step, state->step);
    ASSERT_EQ(lag.angle, state->lag);
    ASSERT_EQ(lag.rate, state->lag_rate);
  }
  EXPECT_GE(matched, lags.size() * 9 / 10);

  matched = 0;
  for (const geometry_msgs::WrenchStamped& wrench : wrenches.messages()) {
    const RotorState* state = find(wrench.header.stamp);
    if (state == nullptr) continue;
    ++matched;
    ASSERT_EQ(wrench.header.frame_id, "hub_link");
    ASSERT_EQ(wrench.wrench, state->hub);
  }
  EXPECT_GE(matched, wrenches.size() * 9 / 10);

  const std::vector<std::string> names = {"rotor_joint",         "blade_1_flap_joint", "blade_1_lag_joint", "blade_1_pitch_joint", "blade_2_flap_joint",
                                          "blade_2_lag_joint",   "blade_2_pitch_joint", "blade_3_flap_joint", "blade_3_lag_joint",  "blade_3_pitch_joint",
                                          "blade_4_flap_joint",  "blade_4_lag_joint",  "blade_4_pitch_joint"};
  OfflineRun offline(shippedConfig("lag_rotor_controlled.yaml"), lively);  // for what the state does not hold
  matched = 0;
  for (const sensor_msgs::JointState& joint : joints.messages()) {
    ASSERT_EQ(joint.name, names);
    ASSERT_EQ(joint.position.size(), names.size());
    const RotorState* state = find(joint.header.stamp);
    if (state == nullptr) continue;
    ++matched;
    EXPECT_EQ(joint.position[0], state->azimuth);
    EXPECT_EQ(joint.velocity[0], state->rotor_speed);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(joint.position[2 + 3 * k], state->lag[k]);
      EXPECT_EQ(joint.position[3 + 3 * k], state->pitch[k]);
      EXPECT_EQ(joint.velocity[3 + 3 * k], offline.at(state->step).pitch_rate[k]);
      EXPECT_NE(joint.velocity[3 + 3 * k], 0.0);
    }
  }
  EXPECT_GE(matched, 100u);

  matched = 0;
  double travel = 0.0;
  for (const nav_msgs::Odometry& o : odometry.messages()) {
    ASSERT_EQ(o.header.frame_id, "odom");
    ASSERT_EQ(o.child_frame_id, "base_link");
    const RotorState* state = find(o.header.stamp);
    if (state == nullptr) continue;
    ++matched;
    EXPECT_EQ(o.pose.pose, state->fuselage_pose);
    EXPECT_EQ(o.twist.twist, state->fuselage_twist);
    travel = std::max(travel, std::abs(o.pose.pose.position.x));
  }
  EXPECT_GE(matched, 150u);
  EXPECT_GT(travel, 1e-3);  // the fuselage really moved

  matched = 0;
  for (const tf2_msgs::TFMessage& message : transforms.messages())
    for (const geometry_msgs::TransformStamped& transform : message.transforms) {
      ASSERT_EQ(transform.header.frame_id, "odom");
      ASSERT_EQ(transform.child_frame_id, "base_link");
      const RotorState* state = find(transform.header.stamp);
      if (state == nullptr) continue;
      ++matched;
      EXPECT_EQ(transform.transform.translation.x, state->fuselage_pose.position.x);
      EXPECT_EQ(transform.transform.translation.y, state->fuselage_pose.position.y);
      EXPECT_EQ(transform.transform.rotation, state->fuselage_pose.orientation);
    }
  EXPECT_GE(matched, 100u);

  // Slower only if this machine is too busy; never faster, up to how evenly messages arrive.
  EXPECT_LE(odometry.rate(), 105.0);
  EXPECT_GE(odometry.rate(), 60.0);
  EXPECT_LE(joints.rate(), 63.0);
  EXPECT_GE(joints.rate(), 36.0);
  EXPECT_LE(markers.rate(), 31.5);
  EXPECT_GE(markers.rate(), 18.0);
  EXPECT_EQ(markers.last().markers.size(), 6u);  // four blades, tip path, hub force
}

TEST_F(StateStream, withPublishClockStampsAreSimulationTimeAndTheClockNeverGoesBack) {
  Collector<rosgraph_msgs::Clock> clock("/clock");
  node.set("publish_clock", true).set("real_time_factor", 2.0);
  node.start();
  ASSERT_TRUE(states.waitForSize(500)) << node.output();
  ASSERT_TRUE(clock.waitForSize(500)) << node.output();
  node.interrupt();
  for (const RotorState& state : states.messages()) ASSERT_NEAR(state.header.stamp.toSec(), state.sim_time, 1e-9);
  const auto ticks = clock.messages();
  for (std::size_t i = 1; i < ticks.size(); ++i) ASSERT_GT(ticks[i].clock, ticks[i - 1].clock);
}

TEST_F(StateStream, diagnosticsAccountForEveryOverrun) {
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  node.start();
  std::map<std::string, std::string> values;
  std::map<std::string, int> levels;
  const auto read = [&] {
    for (const diagnostic_msgs::DiagnosticArray& array : diagnostics.messages())
      for (const diagnostic_msgs::DiagnosticStatus& status : array.status) {
        levels[status.name] = status.level;
        for (const diagnostic_msgs::KeyValue& value : status.values) values[value.key] = value.value;
      }
    return values.count("overruns") > 0 && std::stod(values["steps"]) > 2000;
  };
  ASSERT_TRUE(eventually(read)) << node.output();
  EXPECT_EQ(std::stoll(values["overruns"]), std::stoll(values["overruns: late wake-up"]) + std::stoll(values["overruns: long step"]));
  EXPECT_EQ(values["ROS dropped"], "0");
  EXPECT_EQ(values["source in effect"], "none");
  EXPECT_EQ(values["age of the last command [s]"], "none yet");
  EXPECT_EQ(levels["rotor: Simulation"], diagnostic_msgs::DiagnosticStatus::OK);
  EXPECT_GT(std::stod(values["Newton iterations per step"]), 0.0);
  EXPECT_EQ(levels.count("rotor: Real time"), 1u);
  EXPECT_NEAR(std::stod(values["real-time factor wanted"]), 1.0, 0.0);
  EXPECT_GT(std::stod(values["real-time factor"]), 0.5);
}

}  // namespace
}  // namespace heerk_rotor

int main(int argc, char** argv) { return heerk_rotor::runRosTests(argc, argv, "state_stream_rostest"); }
