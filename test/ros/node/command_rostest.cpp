// Swashplate commands over ROS and LCM: effect on the rotor, refusal, clamping, ageing.
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>

#include <cmath>
#include <limits>

#include "heerk_rotor/RotorState.h"
#include "heerk_rotor/SwashplateCommand.h"
#include "heerk_rotor/lcm/lcm_bridge.hpp"
#include "ros/node/node_process.hpp"
#include "ros/node/offline_run.hpp"

namespace heerk_rotor {
namespace {

/// The command until one arrives [rad].
const double kTrim = Configuration::load(shippedConfig("lag_rotor_controlled.yaml")).root()["subsystems"]["swashplate"]["trim_collective"].as<double>();
constexpr double kCollectiveMax = 0.349;  // [rad]
constexpr double kCyclicLimit = 0.1745;   // [rad]

struct Commands : ::testing::Test {
  Collector<RotorState> states{"rotor/state"};
  NodeProcess node;
  ros::NodeHandle handle;
  ros::Publisher publisher = handle.advertise<SwashplateCommand>("rotor/swashplate_command", 1);
  ros::Publisher array_publisher = handle.advertise<std_msgs::Float64MultiArray>("rotor/swashplate_array", 1);

  void begin(const std::string& policy) {
    node.set("timeout_policy", policy).set("publish_every", 1);
    node.start();
    ASSERT_TRUE(states.waitForSize(10)) << node.output();
    ASSERT_TRUE(eventually([&] { return publisher.getNumSubscribers() == 1 && array_publisher.getNumSubscribers() == 1; }));
  }
  void send(double collective, double lateral, double longitudinal) {
    SwashplateCommand command;
    command.collective = collective;
    command.lateral_cyclic = lateral;
    command.longitudinal_cyclic = longitudinal;
    publisher.publish(command);
  }
  void sendArray(const std::vector<double>& values) {
    std_msgs::Float64MultiArray array;
    array.data = values;
    array_publisher.publish(array);
  }
  /// Index of the first state with that source.
  static std::size_t first(const std::vector<RotorState>& all, const std::string& source) {
    std::size_t i = 0;
    while (i < all.size() && all[i].command_source != source) ++i;
    return i;
  }
};

TEST_F(Commands, aStepMovesThePitchWithinTheActuatorsDynamicsAndThenTheLagAngles) {
  begin("hold");
  send(0.12, 0.0, 0.0);
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.command_source == "ros"; }));
  const std::uint64_t now = states.last().step;
  ASSERT_TRUE(states.waitForLast([now](const RotorState& s) { return s.step > now + 2000; }));
  const std::vector<RotorState> all = states.messages();
  const std::size_t begin = first(all, "ros");
  ASSERT_GT(begin, 0u);
  ASSERT_EQ(all[begin].step, all[begin - 1].step + 1);

  // Reference: the actuator's equations of the model card, integrated here with classical RK4 and ten times smaller steps.
  constexpr double wn = 40.0, zeta = 0.8, r = 0.7;
  double delta = kTrim, v = 0.0;
  const auto advance = [&](double h) {
    const auto rate = [&](double d, double s, double& dd, double& ds) {
      dd = r * std::tanh(s / r);
      ds = wn * wn * (0.12 - d) - 2.0 * zeta * wn * s;
    };
    double d1, s1, d2, s2, d3, s3, d4, s4;
    rate(delta, v, d1, s1);
    rate(delta + 0.5 * h * d1, v + 0.5 * h * s1, d2, s2);
    rate(delta + 0.5 * h * d2, v + 0.5 * h * s2, d3, s3);
    rate(delta + h * d3, v + h * s3, d4, s4);
    delta += h / 6.0 * (d1 + 2.0 * d2 + 2.0 * d3 + d4);
    v += h / 6.0 * (s1 + 2.0 * s2 + 2.0 * s3 + s4);
  };
  // And the whole rotor offline with the command from that step on: bit by bit.
  OfflineRun offline(shippedConfig("lag_rotor_controlled.yaml"));
  for (std::size_t i = 0; i < begin; ++i) expectSamePhysics(all[i], offline.at(all[i].step));
  const RotorState& before = all[begin - 1];
  offline.at(before.step + 1);
  offline.command(0.12, 0.0, 0.0);
  for (std::size_t i = begin; i < begin + 2000; ++i) {
    ASSERT_EQ(all[i].step, all[begin].step + (i - begin));
    EXPECT_EQ(all[i].collective, 0.12);
    // Both methods are of order four with h wn = 0.017: their difference is far below this.
    ASSERT_NEAR(all[i].pitch[0], delta, 1e-7);
    for (int part = 0; part < 10; ++part) advance(0.1 * offline.stepSize());
    expectSamePhysics(all[i], offline.at(all[i].step));
    if (HasFailure()) break;
  }
  const RotorState& after = all[begin + 2000];  // 0.85 s later
  EXPECT_NEAR(after.pitch[2], 0.12, 1e-6);
  EXPECT_NEAR(all[begin].lag[0], before.lag[0], 1e-4);     // the lag angles follow, they do not jump
  EXPECT_GT(after.lag_collective, before.lag_collective + 0.005);  // less drag: the blades lag less
  EXPECT_LT(after.hub.force.z, 0.8 * before.hub.force.z);
}

TEST_F(Commands, cyclicPitchMovesTheFuselage) {
  begin("hold");
  const double still = std::abs(states.last().fuselage_pose.position.x) + std::abs(states.last().fuselage_pose.position.y);
  sendArray({kTrim, 0.0, 0.05});
  ASSERT_TRUE(states.waitForLast([&](const RotorState& s) {
    return s.command_source == "ros_array" && std::abs(s.fuselage_pose.position.x) + std::abs(s.fuselage_pose.position.y) > still + 1e-6;
  }));
  const RotorState last = states.last();
  EXPECT_EQ(last.longitudinal_cyclic, 0.05);
}

TEST_F(Commands, whatIsNotFiniteOrNotThreeValuesIsRefused) {
  begin("hold");
  send(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  EXPECT_TRUE(eventually([&] { return node.says("swashplate command (ros) refused: collective = nan rad, expected [-0.0524, 0.349]"); })) << node.output();
  ros::WallDuration(1.1).sleep();  // warnings come at most once a second
  sendArray({0.1, 0.0});
  EXPECT_TRUE(eventually([&] { return node.says("swashplate command (ros_array) refused: 2 values, expected 3"); })) << node.output();
  send(0.15, 0.0, 0.0);  // a good one gets through after them
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.command_source == "ros"; }));
  for (const RotorState& state : states.messages()) {
    ASSERT_EQ(state.collective, state.command_source == "ros" ? 0.15 : kTrim);
    ASSERT_TRUE(std::isfinite(state.pitch[0]));
  }
}

TEST_F(Commands, whatIsOutOfRangeIsClamped) {
  begin("hold");
  send(1.0, -1.0, 0.01);
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.command_source == "ros"; }));
  const RotorState state = states.last();
  EXPECT_EQ(state.collective, kCollectiveMax);
  EXPECT_EQ(state.lateral_cyclic, -kCyclicLimit);
  EXPECT_EQ(state.longitudinal_cyclic, 0.01);
  EXPECT_TRUE(eventually([&] { return node.says("clamped: collective = 1 rad, expected [-0.0524, 0.349]; lateral_cyclic = -1 rad, expected [-0.1745, 0.1745]"); }))
      << node.output();
}

TEST_F(Commands, aStaleCommandGoesBackToTrim) {
  begin("trim");
  send(0.14, 0.0, 0.0);
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.command_source == "timeout"; }));
  const std::vector<RotorState> all = states.messages();
  const std::size_t arrival = first(all, "ros"), timeout = first(all, "timeout");
  ASSERT_LT(arrival, timeout);
  EXPECT_EQ(all[timeout - 1].collective, 0.14);
  EXPECT_EQ(all[timeout].collective, kTrim);
  // ~command_timeout is 0.5 s of real time. The simulation may make up for a lag of 50 ms at most; on a busy machine it
  // may slip behind, so that less simulated time passes.
  EXPECT_LE(all[timeout].sim_time - all[arrival].sim_time, 0.56);
  EXPECT_GE(all[timeout].sim_time - all[arrival].sim_time, 0.2);
  send(0.15, 0.0, 0.0);
  EXPECT_TRUE(states.waitForLast([](const RotorState& s) { return s.command_source == "ros" && s.collective == 0.15; }));
}

TEST_F(Commands, withHoldAStaleCommandStays) {
  begin("hold");
  send(0.14, 0.0, 0.0);
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.command_source == "ros"; }));
  const double since = states.last().sim_time;
  ASSERT_TRUE(states.waitForLast([since](const RotorState& s) { return s.sim_time > since + 0.8; }));
  EXPECT_EQ(states.last().command_source, "ros");
  EXPECT_EQ(states.last().collective, 0.14);
}

TEST_F(Commands, overLcmTheyCountLikewiseAndTheLatestArrivalWins) {
  const std::string url = "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 20000) + "?ttl=0";
  node.set("lcm_url", url);
  begin("hold");
  lcm::LCM lcm(url);
  swashplate_command_t command{};
  command.collective = 0.13;
  ASSERT_EQ(lcm.publish(LcmBridge<RotorInstant>::kCommandChannel, &command), 0);
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.command_source == "lcm"; }));
  EXPECT_EQ(states.last().collective, 0.13);
  send(0.14, 0.0, 0.0);
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.command_source == "ros"; }));
  EXPECT_EQ(states.last().collective, 0.14);
  ASSERT_EQ(lcm.publish(LcmBridge<RotorInstant>::kCommandChannel, &command), 0);
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.command_source == "lcm"; }));
}

TEST_F(Commands, theRotorSpeedFollowsItsCommandWithinTheDrivesRange) {
  ros::Publisher speed = handle.advertise<std_msgs::Float64>("rotor/speed_command", 1);
  const auto sendSpeed = [&](double value) {
    std_msgs::Float64 message;
    message.data = value;
    speed.publish(message);
  };
  node.set("publish_every", 4).set("command_timeout", 0.05).set("timeout_policy", std::string("trim"));
  node.start();
  ASSERT_TRUE(states.waitForSize(10)) << node.output();
  ASSERT_TRUE(eventually([&] { return speed.getNumSubscribers() == 1 && publisher.getNumSubscribers() == 1; }));
  sendSpeed(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(eventually([&] { return node.says("speed command refused: speed = nan rad/s, expected [20.5, 49.2]"); })) << node.output();
  EXPECT_NEAR(states.last().rotor_speed, 41.0, 0.01);
  sendSpeed(42.0);
  // A swashplate command that times out does not take the speed along.
  send(0.17, 0.0, 0.0);
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.command_source == "timeout"; }));
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.rotor_speed > 41.95; }, 20.0)) << states.last().rotor_speed;
  const double reached = states.last().sim_time;
  ASSERT_TRUE(states.waitForLast([&](const RotorState& s) { return s.sim_time > reached + 1.5; }, 20.0));
  double previous = 41.0;
  for (const RotorState& s : states.messages()) {
    // The drive's acceleration is limited to 2 rad/s^2, on top of which the mast swings: no jump between messages (1.7 ms).
    ASSERT_NEAR(s.rotor_speed, previous, 0.05);
    previous = s.rotor_speed;
    if (s.sim_time > reached + 0.5) {
      ASSERT_NEAR(s.rotor_speed, 42.0, 0.1);  // held, without a time-out of its own
    }
  }
  sendSpeed(1000.0);
  EXPECT_TRUE(eventually([&] { return node.says("speed command clamped: speed = 1000 rad/s, expected [20.5, 49.2]"); })) << node.output();
  EXPECT_TRUE(states.waitForLast([](const RotorState& s) { return s.rotor_speed > 43.0; }, 20.0));
}

TEST_F(Commands, withoutASwashplateTheyAreNotSubscribedTo) {
  node.set("config", shippedConfig("lag_rotor.yaml"));
  node.start();
  ASSERT_TRUE(states.waitForSize(10)) << node.output();
  EXPECT_TRUE(node.says("the configuration has no swashplate"));
  EXPECT_EQ(publisher.getNumSubscribers(), 0u);
  EXPECT_EQ(array_publisher.getNumSubscribers(), 0u);
}

}  // namespace
}  // namespace heerk_rotor

int main(int argc, char** argv) { return heerk_rotor::runRosTests(argc, argv, "command_rostest"); }
