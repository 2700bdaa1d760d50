// Complete runs of the node: event logs, lock step, refused starts, failing simulations, exit status.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <std_srvs/Empty.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <lcm/lcm-cpp.hpp>

#include "heerk_rotor/RotorState.h"
#include "heerk_rotor/SwashplateCommand.h"
#include "heerk_rotor/rotor_state_t.hpp"
#include "ros/node/child_process.hpp"
#include "ros/node/node_process.hpp"
#include "ros/node/offline_run.hpp"

namespace heerk_rotor {
namespace {

std::vector<rotor_state_t> readLog(const std::string& file) {
  std::vector<rotor_state_t> messages;
  lcm::LogFile log(file, "r");
  EXPECT_TRUE(log.good()) << file;
  while (const lcm::LogEvent* event = log.good() ? log.readNextEvent() : nullptr) {
    messages.emplace_back();
    EXPECT_EQ(messages.back().decode(event->data, 0, event->datalen), event->datalen);
  }
  return messages;
}

void expectCompleteLog(const std::string& file, double duration) {
  const std::vector<rotor_state_t> log = readLog(file);
  OfflineRun offline(shippedConfig("lag_rotor_controlled.yaml"));
  ASSERT_EQ(log.size(), static_cast<std::size_t>(std::llround(duration / offline.stepSize())) + 1);  // both ends
  for (std::size_t k = 0; k < log.size(); ++k) {
    ASSERT_EQ(log[k].step, static_cast<std::int64_t>(k));
    ASSERT_EQ(log[k].dropped, 0);
    const RotorReading& reading = offline.at(k);
    expectSamePhysics(log[k], reading);
    EXPECT_EQ(log[k].hub_force[2], reading.hub_force[2]);
    EXPECT_EQ(log[k].hub_torque[2], reading.hub_moment[2]);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(LcmLog, ofARunInRealTimeHasEveryStepAndEqualsTheOfflineRun) {
  NodeProcess node;
  node.set("duration", 3.0).set("lcm_log", node.file("run.lcm"));
  node.start();
  EXPECT_EQ(node.waitForEnd(), 0) << node.output();
  expectCompleteLog(node.file("run.lcm"), 3.0);
}

TEST(LcmLog, ofARunInRealTimeOnABusyMachineIsJustAsComplete) {
  std::vector<std::unique_ptr<ChildProcess>> busy;  // one per processor: the node has none for itself
  for (unsigned k = 0; k < std::max(1u, std::thread::hardware_concurrency()); ++k)
    busy.push_back(std::make_unique<ChildProcess>([] {
      for (volatile std::uint64_t n = 0;;) n = n + 1;
    }));
  NodeProcess node;
  node.set("duration", 8.0).set("lcm_log", node.file("run.lcm"));
  node.start();
  EXPECT_EQ(node.waitForEnd(60.0), 0) << node.output();
  for (const auto& process : busy) EXPECT_TRUE(process->running());
  busy.clear();
  expectCompleteLog(node.file("run.lcm"), 8.0);
}

TEST(LcmLog, ofARunAsFastAsPossibleHasEveryStepToo) {
  NodeProcess node;
  const auto begin = std::chrono::steady_clock::now();
  node.set("duration", 60.0).set("real_time_factor", 0.0).set("lcm_log", node.file("run.lcm"));
  node.start();
  EXPECT_EQ(node.waitForEnd(), 0) << node.output();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));  // it is faster than real time
  expectCompleteLog(node.file("run.lcm"), 60.0);
}

TEST(LcmLog, thatCannotBeWrittenIsRefusedAtTheStart) {
  NodeProcess node;
  node.set("lcm_log", std::string("/nonexistent_folder/run.lcm"));
  node.start();
  EXPECT_EQ(node.waitForEnd(), 2);
  EXPECT_TRUE(node.says("/nonexistent_folder/run.lcm")) << node.output();
}

TEST(LcmLog, onAFullDiskIsAnErrorAndANonzeroExit) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  NodeProcess node;
  node.set("duration", 1.0).set("lcm_log", std::string("/dev/full"));
  node.start();
  EXPECT_EQ(node.waitForEnd(), 4) << node.output();
  EXPECT_TRUE(node.says("LCM log /dev/full: writing failed")) << node.output();
}

TEST(Interrupted, theNodeSaysHowTheRunWentAndItsLogIsComplete) {
  Collector<RotorState> states("rotor/state");
  NodeProcess node;
  node.set("lcm_log", node.file("run.lcm"));
  node.start();
  ASSERT_TRUE(states.waitForSize(200)) << node.output();
  EXPECT_EQ(node.interrupt(), 0) << node.output();
  const std::vector<rotor_state_t> log = readLog(node.file("run.lcm"));
  for (std::size_t k = 0; k < log.size(); ++k) ASSERT_EQ(log[k].step, static_cast<std::int64_t>(k));
  EXPECT_GE(log.size(), states.last().step + 1);
  EXPECT_TRUE(node.says("ended after " + std::to_string(log.size()) + " steps")) << log.size() << "\n" << node.output();
}

TEST(LockStep, advancesNStepsPerCommandAndWaitsForTheNext) {
  constexpr int kBatch = 10, kEvery = 4;  // a batch must not end on a multiple only: the controller waits for its end
  Collector<RotorState> states("rotor/state");
  ros::NodeHandle handle;
  ros::Publisher publisher = handle.advertise<SwashplateCommand>("rotor/swashplate_command", 1);
  NodeProcess node;
  node.set("lock_step", kBatch).set("publish_every", kEvery).set("timeout_policy", std::string("trim")).set("command_timeout", 0.001);
  node.start();
  ASSERT_TRUE(eventually([&] { return publisher.getNumSubscribers() == 1; })) << node.output();
  ASSERT_TRUE(eventually([&] { return node.says("running"); }));

  constexpr std::uint64_t kCommands = 50;
  for (std::uint64_t k = 1; k <= kCommands; ++k) {
    SwashplateCommand command;
    command.collective = 0.1 + 0.001 * static_cast<double>(k);
    publisher.publish(command);
    // The controller's turn comes with the instant that its command has led to.
    const bool answered = states.waitForLast([k](const RotorState& s) { return s.step == kBatch * k; }, k == 1 ? 3.0 : 15.0);
    // The very first answer may come before this subscription is complete: ROS gives no sign of that.
    ASSERT_TRUE(answered || k == 1) << k << "\n" << node.output();
  }
  EXPECT_EQ(states.last().step, kBatch * kCommands);
  // Commands are in effect from the step after they came, timeouts play no part, and it equals the offline run.
  OfflineRun offline(shippedConfig("lag_rotor_controlled.yaml"));
  std::uint64_t previous = 0;
  for (const RotorState& state : states.messages()) {
    if (state.step == 0) continue;
    EXPECT_TRUE(state.step % kEvery == 0 || state.step % kBatch == 0) << state.step;
    EXPECT_EQ(state.command_source, "ros");
    const std::uint64_t command = (state.step - 1) / kBatch + 1;
    for (std::uint64_t k = previous + 1; k <= command; ++k) {
      offline.at(kBatch * (k - 1));
      offline.command(0.1 + 0.001 * static_cast<double>(k), 0.0, 0.0);
    }
    previous = command;
    expectSamePhysics(state, offline.at(state.step));
  }
}

TEST(Parameters, thatAreWrongAreAllListedAndTheNodeEndsWithTwo) {
  NodeProcess node;
  node.set("publish_every", -1).set("real_time_factor", std::string("fast")).set("timeout_policy", std::string("hodl")).set("publsh_clock", true);
  node.start();
  EXPECT_EQ(node.waitForEnd(), 2);
  EXPECT_TRUE(node.says("~publish_every = -1: expected an integer in [0, ")) << node.output();
  EXPECT_TRUE(node.says("~real_time_factor = fast: expected a number >= 0")) << node.output();
  EXPECT_TRUE(node.says("~timeout_policy = hodl: expected hold or trim")) << node.output();
}

TEST(Parameters, ofAnUnknownNameAreAWarningWithTheNearestName) {
  NodeProcess node;
  node.set("publsh_clock", true).set("duration", 0.05);
  node.start();
  EXPECT_EQ(node.waitForEnd(), 0);
  EXPECT_TRUE(node.says("~publsh_clock is not a parameter of this node (did you mean 'publish_clock'?)")) << node.output();
}

TEST(Configurations, thatAreWrongEndTheNodeWithTwo) {
  NodeProcess node;
  node.set("set", std::vector<std::string>{"subsystems.rotor.blade_mass=-1", "subsystems.airloads.chord=wide"});
  node.start();
  EXPECT_EQ(node.waitForEnd(), 2);
  EXPECT_TRUE(node.says("subsystems.rotor.blade_mass")) << node.output();
  EXPECT_TRUE(node.says("subsystems.airloads.chord")) << node.output();
}

struct Diverging : ::testing::Test {
  Collector<RotorState> states{"rotor/state"};
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics{"/diagnostics"};
  NodeProcess node;
  void SetUp() override {
    // The classical method with a mast far too stiff for the step.
    node.set("publish_every", 1).set("set", std::vector<std::string>{"simulation.integrator=HERK4", "subsystems.mast.stiffness=1e11"});
  }
  static std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
  }
};

TEST_F(Diverging, stopsWithOneErrorPublishesNothingNonFiniteAndCanBeReset) {
  node.start();
  ASSERT_TRUE(eventually([&] { return node.says("the simulation stopped at step"); })) << node.output();
  const auto inError = [&] {
    for (const diagnostic_msgs::DiagnosticStatus& status : diagnostics.last().status)
      if (status.name == "rotor: Simulation" && status.level == diagnostic_msgs::DiagnosticStatus::ERROR && status.message.find("step") != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(eventually(inError));
  EXPECT_EQ(count(node.output(), "the simulation stopped at step"), 1u) << node.output();
  EXPECT_TRUE(eventually([&] { return std::filesystem::exists(node.file("failure.csv")); })) << node.output();
  std::ifstream csv(node.file("failure.csv"));
  std::string header, row;
  std::getline(csv, header);
  EXPECT_EQ(header.find("step [-],time [s],azimuth [rad],"), 0u) << header;
  EXPECT_TRUE(std::getline(csv, row));
  EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));

  // The services are alive, and each failure is reported once, whatever is mended when.
  constexpr std::uint32_t kResets = 8;
  for (std::uint32_t k = 1; k <= kResets; ++k) {
    std_srvs::Empty empty;
    ASSERT_TRUE(ros::service::call("/rotor/reset", empty));
    ASSERT_TRUE(eventually([&] { return count(node.output(), "the simulation stopped at step") == k + 1; })) << k << "\n" << node.output();
  }
  EXPECT_TRUE(states.waitForLast([](const RotorState& s) { return s.epoch == kResets; }));
  EXPECT_EQ(count(node.output(), "the simulation stopped at step"), kResets + 1) << node.output();
  for (const RotorState& s : states.messages()) {
    for (std::size_t k = 0; k < s.lag.size(); ++k) ASSERT_TRUE(std::isfinite(s.lag[k]) && std::isfinite(s.lag_rate[k]) && std::isfinite(s.pitch[k]));
    ASSERT_TRUE(std::isfinite(s.hub.force.x + s.hub.force.y + s.hub.force.z + s.hub.torque.z + s.azimuth + s.thrust_coefficient));
  }
  EXPECT_EQ(node.interrupt(), 3);
}

TEST_F(Diverging, withADurationTheNodeEndsWithThree) {
  node.set("duration", 100.0);
  node.start();
  EXPECT_EQ(node.waitForEnd(), 3) << node.output();
}

}  // namespace
}  // namespace heerk_rotor

int main(int argc, char** argv) { return heerk_rotor::runRosTests(argc, argv, "run_end_rostest"); }
