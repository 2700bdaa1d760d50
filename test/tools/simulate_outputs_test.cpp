// One run recorded to all three formats: they must tell the same story.
#include <gtest/gtest.h>

#include "program.hpp"

#if defined(HEERK_WITH_ROS) && defined(HEERK_WITH_LCM)

#include <lcm/lcm-cpp.hpp>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include "heerk_rotor/RotorState.h"
#include "heerk_rotor/BladeAngles.h"
#include "heerk_rotor/rotor_state_t.hpp"
#include <geometry_msgs/WrenchStamped.h>

namespace heerk_rotor {
namespace {

class SimulateOutputs : public ::testing::Test {
 protected:
  static constexpr int kEvery = 5;

  void SetUp() override {
    const std::string commands = folder_.write("c.csv", "time,collective,lateral_cyclic,longitudinal_cyclic\n0.05,0.18,0.01,-0.02\n");
    const Finished run = simulate({shippedConfiguration("lag_rotor_controlled.yaml"), "--duration", "0.5", "--set", "simulation.step=1e-3", "--every",
                                   std::to_string(kEvery), "--commands", commands, "--output", csv(), "--output", bag(), "--output", lcm(),
                                   "--signals", "all"});
    ASSERT_EQ(run.status, 0) << run.err;
    table_ = parseTable(readText(csv()));
    ASSERT_EQ(table_.rows.size(), 101u);
  }

  std::string csv() const { return folder_.file("x.csv"); }
  std::string bag() const { return folder_.file("x.bag"); }
  std::string lcm() const { return folder_.file("x.lcm"); }

  TestFolder folder_;
  Table table_;
};

template <class Message>
std::vector<std::pair<ros::Time, Message>> messages(const rosbag::Bag& bag, const std::string& topic) {
  std::vector<std::pair<ros::Time, Message>> result;
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<Message>();
    if (message) result.emplace_back(instance.getTime(), *message);
  }
  return result;
}

TEST_F(SimulateOutputs, theBagHoldsTheNodesTopicsWithTheNumbersOfTheCsvFile) {
  const rosbag::Bag bag_file(bag(), rosbag::bagmode::Read);
  const auto states = messages<RotorState>(bag_file, "/rotor/state");
  const auto angles = messages<BladeAngles>(bag_file, "/rotor/lag_angles");
  const auto wrenches = messages<geometry_msgs::WrenchStamped>(bag_file, "/rotor/hub_wrench");
  ASSERT_EQ(states.size(), table_.rows.size());
  ASSERT_EQ(angles.size(), table_.rows.size());
  ASSERT_EQ(wrenches.size(), table_.rows.size());
  for (std::size_t row = 0; row < states.size(); ++row) {
    const RotorState& state = states[row].second;
    EXPECT_EQ(state.step, row * kEvery);
    EXPECT_EQ(state.sim_time, table_.number(row, "time [s]"));
    EXPECT_EQ(state.azimuth, table_.number(row, "azimuth [rad]"));
    EXPECT_EQ(state.header.stamp, ros::Time(1.0 + state.sim_time));
    EXPECT_EQ(states[row].first, state.header.stamp) << "bag time";
    ASSERT_EQ(state.lag.size(), 4u);
    for (int blade = 1; blade <= 4; ++blade) {
      const double lag = table_.number(row, "rotor.lag_" + std::to_string(blade) + " [rad]");
      EXPECT_EQ(state.lag[blade - 1], lag);
      EXPECT_EQ(angles[row].second.angle[blade - 1], lag);
      EXPECT_EQ(state.lag_rate[blade - 1], table_.number(row, "rotor.lag_rate_" + std::to_string(blade) + " [rad/s]"));
    }
    EXPECT_EQ(state.hub.force.z, table_.number(row, "rotor.hub_force_z [N]"));
    EXPECT_EQ(wrenches[row].second.wrench.torque.z, table_.number(row, "rotor.hub_moment_z [N m]"));
    EXPECT_EQ(state.command_source, "file");
    EXPECT_EQ(state.collective, row * kEvery < 50 ? 0.17 : 0.18) << "trim, then the file's command from 0.05 s on";
  }
}

TEST_F(SimulateOutputs, slowTopicsOfTheBagHaveTheNodesRates) {
  const rosbag::Bag bag_file(bag(), rosbag::bagmode::Read);
  // Half a second: 50 periods of 100 Hz and 30 of 60 Hz, and the instant 0.5 s that begins the next one.
  EXPECT_EQ(rosbag::View(bag_file, rosbag::TopicQuery("/rotor/odom")).size(), 51u);
  EXPECT_EQ(rosbag::View(bag_file, rosbag::TopicQuery("/joint_states")).size(), 31u);
  const auto transforms = messages<tf2_msgs::TFMessage>(bag_file, "/tf");
  ASSERT_EQ(transforms.size(), 31u);
  EXPECT_EQ(transforms.front().second.transforms.at(0).child_frame_id, "base_link");
}

TEST_F(SimulateOutputs, theLcmLogHoldsTheNumbersOfTheCsvFile) {
  ::lcm::LogFile log(lcm(), "r");
  ASSERT_TRUE(log.good());
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    const ::lcm::LogEvent* event = log.readNextEvent();
    ASSERT_NE(event, nullptr) << "row " << row;
    EXPECT_EQ(event->channel, "ROTOR_STATE");
    EXPECT_EQ(event->eventnum, static_cast<std::int64_t>(row));
    rotor_state_t state;
    ASSERT_EQ(state.decode(event->data, 0, event->datalen), event->datalen);
    EXPECT_EQ(state.step, static_cast<std::int64_t>(row * kEvery));
    EXPECT_EQ(state.sim_time, table_.number(row, "time [s]"));
    EXPECT_EQ(event->timestamp, static_cast<std::int64_t>(row) * kEvery * 1000) << "simulation time [us]";
    EXPECT_EQ(state.stamp, static_cast<std::int64_t>(row) * kEvery * 1000000) << "simulation time [ns]";
    ASSERT_EQ(state.blades, 4);
    for (int blade = 1; blade <= 4; ++blade)
      EXPECT_EQ(state.lag[static_cast<std::size_t>(blade - 1)], table_.number(row, "rotor.lag_" + std::to_string(blade) + " [rad]"));
    EXPECT_EQ(state.hub_torque[2], table_.number(row, "rotor.hub_moment_z [N m]"));
    EXPECT_EQ(state.command_source, "file");
  }
  EXPECT_EQ(log.readNextEvent(), nullptr);
}

}  // namespace
}  // namespace heerk_rotor

#endif
