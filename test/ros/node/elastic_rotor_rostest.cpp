// The rotor with elastic blades on its fuselage: answers to the swashplate, to wind and to an external load, in lock step, so that the
// load of the machine does not matter.
#include <geometry_msgs/Vector3Stamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <limits>

#include "heerk_rotor/RotorState.h"
#include "heerk_rotor/SwashplateCommand.h"
#include "heerk_rotor/config/configuration.hpp"
#include "ros/node/node_process.hpp"

namespace heerk_rotor {
namespace {

constexpr int kRevolution = 360;          // steps
constexpr int kBatch = 2 * kRevolution;   // steps per command
constexpr double kCollective = 0.12;      // [rad]

/// Means over one batch: two revolutions, so that whatever is periodic cancels.
struct Mean {
  double thrust = 0.0, nose_down = 0.0, coning = 0.0, flap_cosine = 0.0, height = 0.0, thrust_coefficient = 0.0;
};

struct ElasticRotor : ::testing::Test {
  Collector<RotorState> states{"rotor/state"};
  NodeProcess node;
  ros::NodeHandle handle;
  ros::Publisher swashplate = handle.advertise<SwashplateCommand>("rotor/swashplate_command", 1);
  ros::Publisher wind = handle.advertise<geometry_msgs::Vector3Stamped>("rotor/wind", 1);
  ros::Publisher wrench = handle.advertise<geometry_msgs::WrenchStamped>("rotor/external_wrench", 1);
  std::uint64_t reached = 0;

  /// In lock step nothing moves, and nothing is published, before the first command.
  void begin() {
    node.set("config", shippedConfig("bo105.yaml")).set("real_time_factor", 0.0).set("lock_step", kBatch).set("publish_every", 4);
    node.start();
    ASSERT_TRUE(eventually([&] { return swashplate.getNumSubscribers() == 1 && wind.getNumSubscribers() == 1 && wrench.getNumSubscribers() == 1 && states.connected(); }, 60.0))
        << node.output();
  }

  /// Advances by that many batches; the mean over the last one.
  Mean run(int batches, double collective, double longitudinal = 0.0, double lateral = 0.0) {
    for (int batch = 0; batch < batches; ++batch) {
      SwashplateCommand command;
      command.collective = collective;
      command.longitudinal_cyclic = longitudinal;
      command.lateral_cyclic = lateral;
      swashplate.publish(command);
      reached += kBatch;
      if (!states.waitForLast([this](const RotorState& s) { return s.step >= reached; }, 60.0)) {
        ADD_FAILURE() << "no state of step " << reached << '\n' << node.output();
        return {};
      }
    }
    Mean mean;
    int count = 0;
    for (const RotorState& s : states.messages()) {
      if (s.step + kBatch <= reached || s.step > reached) continue;
      mean.thrust += s.hub.force.z;
      mean.nose_down += s.hub.torque.y;
      mean.coning += s.flap_collective;
      mean.flap_cosine += s.flap_cosine;
      mean.height += s.fuselage_pose.position.z;
      mean.thrust_coefficient += s.thrust_coefficient;
      ++count;
    }
    for (double* value : {&mean.thrust, &mean.nose_down, &mean.coning, &mean.flap_cosine, &mean.height, &mean.thrust_coefficient}) *value /= count;
    return mean;
  }
};

TEST_F(ElasticRotor, answersTheSwashplateWithTheRightSignsAndWithoutAGap) {
  begin();
  const Mean hover = run(12, kCollective);
  const Mean climb = run(8, kCollective + 0.02);
  EXPECT_GT(climb.thrust, 1.05 * hover.thrust);
  EXPECT_GT(climb.thrust_coefficient, 1.05 * hover.thrust_coefficient);
  EXPECT_GT(climb.coning, hover.coning + 0.003);
  const Mean again = run(8, kCollective);
  const Mean forward = run(8, kCollective, -0.02);  // stick forward: theta1s < 0
  EXPECT_GT(forward.flap_cosine, again.flap_cosine + 0.005);  // aft side up: disc tilted forward
  EXPECT_GT(forward.nose_down, again.nose_down + 1000.0);     // and the hub moment is nose down

  const std::vector<RotorState> all = states.messages();
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(all[i].step, all.front().step + 4 * i);
    const RotorState& s = all[i];
    ASSERT_EQ(s.flap.size(), 4u);
    ASSERT_EQ(s.inflow.size(), 3u);
    // The message's multiblade coordinates belong to its angles.
    EXPECT_NEAR(s.flap_collective, 0.25 * (s.flap[0] + s.flap[1] + s.flap[2] + s.flap[3]), 1e-14);
    EXPECT_NEAR(s.flap_cosine, 0.5 * ((s.flap[0] - s.flap[2]) * std::cos(s.azimuth) - (s.flap[1] - s.flap[3]) * std::sin(s.azimuth)), 1e-12);
    if (HasFailure()) break;
  }
  EXPECT_LT(all.front().step, static_cast<std::uint64_t>(kBatch));
  EXPECT_EQ(states.last().step, reached);
  EXPECT_EQ(states.last().dropped, 0u);
}

TEST_F(ElasticRotor, anUpdraftRaisesTheThrustAndNotANumberIsRefused) {
  begin();
  const Mean calm = run(12, kCollective);
  geometry_msgs::Vector3Stamped message;
  message.vector.z = std::numeric_limits<double>::quiet_NaN();
  wind.publish(message);
  EXPECT_TRUE(eventually([&] { return node.says("wind refused: wind_z = nan m/s, expected a finite number"); })) << node.output();
  message.header.frame_id = "base_link";
  message.vector.z = 5.0;
  ros::WallDuration(1.1).sleep();  // warnings come at most once a second
  wind.publish(message);
  EXPECT_TRUE(eventually([&] { return node.says("wind refused: frame 'base_link', expected 'odom'"); })) << node.output();
  EXPECT_NEAR(run(1, kCollective).thrust, calm.thrust, 0.01 * calm.thrust);
  message.header.frame_id = "odom";
  message.vector.z = 3.0;
  wind.publish(message);
  // 3 m/s reduce the inflow angle at 0.75 R by 1 deg, of about 5 deg angle of attack; Glauert's inflow gives half of it back.
  Mean updraft;
  for (int tries = 0; tries < 20 && updraft.thrust < 1.03 * calm.thrust; ++tries) updraft = run(2, kCollective);
  EXPECT_GT(updraft.thrust, 1.03 * calm.thrust);
  updraft = run(4, kCollective);  // held
  EXPECT_GT(updraft.thrust, 1.03 * calm.thrust);
  EXPECT_LT(updraft.thrust, 1.6 * calm.thrust);
}

TEST_F(ElasticRotor, anUpwardForceLiftsTheFuselageByWhatItsSpringsYield) {
  const double stiffness = Configuration::load(shippedConfig("bo105.yaml")).root()["subsystems"]["fuselage"]["gear_stiffness"][2].as<double>();
  begin();
  const Mean before = run(12, kCollective);
  geometry_msgs::WrenchStamped message;
  message.header.frame_id = "base_link";
  message.wrench.force.z = std::numeric_limits<double>::infinity();
  wrench.publish(message);
  EXPECT_TRUE(eventually([&] { return node.says("external wrench refused: external_force_z = inf N, expected a finite number"); })) << node.output();
  message.wrench.force.z = 5000.0;
  wrench.publish(message);
  const double lift = 5000.0 / stiffness;
  Mean lifted = before;
  for (int tries = 0; tries < 20 && lifted.height < before.height + 0.9 * lift; ++tries) lifted = run(1, kCollective);
  lifted = run(6, kCollective);  // held, and settled
  // The thrust goes on settling a little meanwhile (see thrust); the springs carry the difference.
  EXPECT_NEAR(lifted.height - before.height, lift + (lifted.thrust - before.thrust) / stiffness, 0.02 * lift);
}

TEST_F(ElasticRotor, bladesAreDrawnDeformed) {
  Collector<visualization_msgs::MarkerArray> pictures{"rotor/blades"};
  begin();
  ASSERT_TRUE(eventually([&] { return pictures.connected(); }));
  run(6, kCollective);
  ASSERT_TRUE(pictures.waitForSize(2));
  const visualization_msgs::MarkerArray picture = pictures.last();
  ASSERT_EQ(picture.markers.size(), 6u);
  for (int k = 0; k < 4; ++k) {
    const visualization_msgs::Marker& blade = picture.markers[static_cast<std::size_t>(k)];
    EXPECT_EQ(blade.type, visualization_msgs::Marker::TRIANGLE_LIST);
    ASSERT_GT(blade.points.size(), 200u);
    ASSERT_EQ(blade.points.size() % 3, 0u);
    ASSERT_EQ(blade.colors.size(), blade.points.size());
    double reach = 0.0, height = 0.0;
    for (const geometry_msgs::Point& p : blade.points) {
      reach = std::max(reach, std::hypot(p.x, p.y));
      height = std::max(height, p.z);
    }
    EXPECT_NEAR(reach, 4.91, 0.02);   // the radius, and a corner of the chord
    // The highest point is the tip's, where the node says it is: flap is its height over R. The chord adds what its pitch lifts of the
    // leading edge (a quarter of 0.27 m at 0.1 rad) and half the drawn thickness: less than 3 cm. The blades of a rotor on its way into
    // hover move by a centimetre between picture and state.
    EXPECT_NEAR(height, states.last().flap[static_cast<std::size_t>(k)] * 4.91, 0.04);
  }
}

TEST_F(ElasticRotor, disturbancesThatNobodyTakesAreReportedOnce) {
  node.set("config", shippedConfig("lag_rotor_controlled.yaml"));
  node.start();
  ASSERT_TRUE(eventually([&] { return wind.getNumSubscribers() == 1 && wrench.getNumSubscribers() == 1; })) << node.output();
  const std::string text = "wind ignored: no subsystem of the configuration takes it";
  for (int k = 0; k < 5; ++k) wind.publish(geometry_msgs::Vector3Stamped());
  EXPECT_TRUE(eventually([&] { return node.says(text); })) << node.output();
  wrench.publish(geometry_msgs::WrenchStamped());
  EXPECT_TRUE(eventually([&] { return node.says("external wrench ignored: no subsystem of the configuration takes it"); })) << node.output();
  const std::string output = node.output();
  EXPECT_EQ(output.find(text), output.rfind(text));
}

}  // namespace
}  // namespace heerk_rotor

int main(int argc, char** argv) { return heerk_rotor::runRosTests(argc, argv, "elastic_rotor_rostest"); }
