// The node with the dual-disc rotor: topics, services, LCM log, as complete and as exact as with a rotor, at 1e-5 s per step.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <std_msgs/Float64.h>
#include <std_srvs/Empty.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <map>

#include "heerk_rotor/RotorState.h"
#include "heerk_rotor/SaveSnapshot.h"
#include "heerk_rotor/ShaftState.h"
#include "heerk_rotor/Step.h"
#include "ros/node/node_process.hpp"
#include "ros/node/offline_run.hpp"

#ifdef HEERK_WITH_LCM
#include <lcm/lcm-cpp.hpp>

#include "heerk_rotor/shaft_batch_t.hpp"
#include "heerk_rotor/shaft_state_t.hpp"
#endif

namespace heerk_rotor {
namespace {

struct Shaft : ::testing::Test {
  Collector<ShaftState> states{"shaft/state"};
  NodeProcess node;
  std::string config = shippedConfig("dual_disc.yaml");
  Shaft() { node.set("config", config); }

  static bool call(const std::string& name) {
    std_srvs::Empty empty;
    return ros::service::waitForService("/rotor/" + name, 10000) && ros::service::call("/rotor/" + name, empty);
  }
  static Step::Response step(std::uint32_t n) {
    Step service;
    service.request.n = n;
    EXPECT_TRUE(ros::service::call("/rotor/step", service));
    return service.response;
  }
};

TEST_F(Shaft, everyPublishedStepArrivesOnceInOrderAndEqualsTheOfflineRun) {
  Collector<RotorState> none("rotor/state");
  node.start();
  ASSERT_TRUE(states.waitForSize(1000)) << node.output();
  node.interrupt();
  EXPECT_TRUE(node.says("40 steps per wake-up, one in 100 to ROS, one in 40 to LCM")) << node.output();
  const std::vector<ShaftState> all = states.messages();
  OfflineShaft offline(config);
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(all[i].step, all[0].step + 100 * i);
    EXPECT_EQ(all[i].epoch, 0u);
    EXPECT_EQ(all[i].dropped, 0u);
    EXPECT_EQ(all[i].header.frame_id, "shaft_link");
    EXPECT_NEAR((all[i].header.stamp - all[0].header.stamp).toSec(), all[i].sim_time - all[0].sim_time, 2e-9);
    expectSameShaft(all[i], offline.at(all[i].step));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(all.back().eccentricity_ratio, 0.0);
  EXPECT_FALSE(none.connected());
}

TEST_F(Shaft, showsOrbitsAndItsFrameAndReportsItsHealth) {
  Collector<visualization_msgs::MarkerArray> markers("shaft/orbit");
  Collector<tf2_msgs::TFMessage> transforms("/tf_static");
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  node.start();
  ASSERT_TRUE(markers.waitForSize(30)) << node.output();
  EXPECT_LT(markers.rate(), 40.0);
  ASSERT_TRUE(transforms.waitForSize(1));
  EXPECT_EQ(transforms.last().transforms.at(0).header.frame_id, "odom");
  EXPECT_EQ(transforms.last().transforms.at(0).child_frame_id, "shaft_link");
  std::size_t points = 0;
  bool text = false;
  for (const visualization_msgs::Marker& marker : markers.last().markers) {
    EXPECT_EQ(marker.header.frame_id, "shaft_link");
    if (marker.ns == "orbits" && marker.id == 2) points = marker.points.size();
    text = text || marker.text.find("displacements x 500") != std::string::npos;
  }
  EXPECT_NEAR(static_cast<double>(points), 3.0 * 120.0, 2.0);  // of the last three turns, although 30 pictures per second show a third of the turns
  EXPECT_TRUE(text);
  ASSERT_TRUE(diagnostics.waitForLast([](const diagnostic_msgs::DiagnosticArray& array) { return array.status.size() >= 5; }));
  std::map<std::string, std::string> values;
  for (const diagnostic_msgs::DiagnosticStatus& status : diagnostics.last().status)
    for (const diagnostic_msgs::KeyValue& value : status.values) values[value.key] = value.value;
  EXPECT_EQ(values["ROS dropped"], "0");
  EXPECT_EQ(values["step size [s]"], "1e-05");
  EXPECT_EQ(std::stoll(values["overruns"]), std::stoll(values["overruns: late wake-up"]) + std::stoll(values["overruns: long step"]));
}

TEST_F(Shaft, warnsWhileTheJournalIsBeyondItsFilm) {
  // A film of nearly no viscosity cannot hold an unbalance ten times as large. Beyond its limit it is too stiff for the shipped step.
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  node.set("set", std::vector<std::string>{"subsystems.film.viscosity=2e-7", "subsystems.shaft.discs.unbalance=[2.6e-3, 2.23e-3]", "simulation.step=5e-6"});
  node.start();
  EXPECT_TRUE(diagnostics.waitForLast([](const diagnostic_msgs::DiagnosticArray& array) {
    for (const diagnostic_msgs::DiagnosticStatus& status : array.status)
      if (status.level == diagnostic_msgs::DiagnosticStatus::WARN && status.message.find("film.film_clamped: the model's limit was reached at ") != std::string::npos) return true;
    return false;
  })) << node.output();
  node.interrupt();
  EXPECT_TRUE(node.says("largest eccentricity ratio ")) << node.output();
}

TEST_F(Shaft, pausesStepsResetsAndSavesLikeARotor) {
  node.start();
  ASSERT_TRUE(states.waitForSize(100)) << node.output();
  ASSERT_TRUE(call("pause"));
  const Step::Response reached = step(1234);  // ends between two published steps
  ASSERT_TRUE(reached.success) << reached.message;
  ASSERT_TRUE(states.waitForLast([&](const ShaftState& s) { return s.step == reached.step; }));
  SaveSnapshot save;
  save.request.path = node.file("shaft.snapshot");
  ASSERT_TRUE(ros::service::call("/rotor/save_snapshot", save));
  EXPECT_TRUE(save.response.success) << save.response.message;
  ASSERT_TRUE(call("reset"));
  ASSERT_TRUE(states.waitForLast([&](const ShaftState& s) { return s.epoch == 1; }));
  EXPECT_EQ(states.last().step, reached.step);
  OfflineShaft offline(config);
  const ShaftReading first = offline.at(0);
  EXPECT_EQ(states.last().disc_x[0], first.disc_x[0]);
  EXPECT_EQ(states.last().azimuth, first.azimuth);
  ASSERT_TRUE(call("unpause"));
  ASSERT_TRUE(states.waitForLast([&](const ShaftState& s) { return s.step > reached.step + 10000; }));
}

TEST_F(Shaft, followsASpeedCommandWhereTheConfigurationHasADrive) {
  ros::NodeHandle handle;
  ros::Publisher command = handle.advertise<std_msgs::Float64>("rotor/speed_command", 1, true);
  node.set("set", std::vector<std::string>{"subsystems.drive.type=drive"});
  std_msgs::Float64 speed;
  speed.data = 530.0;
  command.publish(speed);
  node.start();
  EXPECT_TRUE(states.waitForLast([](const ShaftState& s) { return s.rotor_speed > 523.7; })) << node.output();
}

#ifdef HEERK_WITH_LCM

/// The log holds all steps; what simulate would write must be in it bit by bit.
TEST_F(Shaft, theLogHoldsEveryStepAndTheLiveChannelEveryFortieth) {
  const std::string url = "udpm://239.255.76.67:" + std::to_string(21000 + getpid() % 20000) + "?ttl=0";
  const std::string file = node.file("run.lcm");
  std::vector<std::int64_t> live;
  lcm::LCM listener(url + "&recv_buf_size=4194304");
  ASSERT_TRUE(listener.good());
  listener.subscribeFunction("SHAFT_STATE", +[](const lcm::ReceiveBuffer*, const std::string&, const shaft_state_t* m, std::vector<std::int64_t>* steps) { steps->push_back(m->step); }, &live)
      ->setQueueCapacity(10000);
  node.set("lcm_url", url).set("lcm_log", file).set("duration", 1.0);
  node.start();
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while ((live.empty() || live.back() < 100000) && std::chrono::steady_clock::now() < end) listener.handleTimeout(20);
  ASSERT_EQ(node.waitForEnd(), 0) << node.output();
  ASSERT_FALSE(live.empty());
  EXPECT_EQ(live.front(), 0);
  std::size_t regular = 0;
  for (std::size_t i = 1; i < live.size(); ++i) regular += live[i] == live[i - 1] + 40;
  EXPECT_GE(regular, 2450u);  // UDP may lose some

  OfflineShaft offline(config);
  lcm::LogFile log(file, "r");
  std::int64_t next = 0;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    ASSERT_EQ(event->channel, "SHAFT_STATE_BATCH");
    shaft_batch_t b;
    ASSERT_EQ(b.decode(event->data, 0, event->datalen), event->datalen);
    ASSERT_EQ(b.step, next);
    ASSERT_EQ(b.stride, 1);
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.steps); ++i, ++next) {
      const ShaftReading& r = offline.at(static_cast<std::uint64_t>(next));
      ASSERT_EQ(b.sim_time[i], r.sim_time);
      ASSERT_EQ(b.azimuth[i], r.azimuth);
      ASSERT_EQ(b.disc_x[1][i], r.disc_x[1]);
      ASSERT_EQ(b.disc_y[0][i], r.disc_y[0]);
      ASSERT_EQ(b.journal_y[i], r.journal_y);
      ASSERT_EQ(b.film_force_x[i], r.film_force_x);
      ASSERT_EQ(b.bearing_force_y[i], r.bearing_force_y);
      ASSERT_EQ(b.eccentricity_ratio[i], r.eccentricity_ratio);
    }
  }
  EXPECT_EQ(next, 100001);  // steps 0..100000
}

#endif

}  // namespace
}  // namespace heerk_rotor

int main(int argc, char** argv) { return heerk_rotor::runRosTests(argc, argv, "shaft_rostest"); }
