// Services: pause, step, unpause, reset, snapshots.
#include <std_srvs/Empty.h>

#include <filesystem>

#include "heerk_rotor/LoadSnapshot.h"
#include "heerk_rotor/RotorState.h"
#include "heerk_rotor/SaveSnapshot.h"
#include "heerk_rotor/Step.h"
#include "heerk_rotor/Trim.h"
#include "ros/node/node_process.hpp"

namespace heerk_rotor {
namespace {

struct Services : ::testing::Test {
  Collector<RotorState> states{"rotor/state"};
  NodeProcess node;

  void SetUp() override {
    // A lively start, so that a reset shows.
    node.set("publish_every", 1).set("set", std::vector<std::string>{"subsystems.rotor.initial.lag_1=0.02", "subsystems.rotor.initial.lag_2=-0.037"});
    node.start();
    ASSERT_TRUE(states.waitForSize(200)) << node.output();
  }
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
  template <class Service>
  static typename Service::Response file(const std::string& name, const std::string& path) {
    Service service;
    service.request.path = path;
    EXPECT_TRUE(ros::service::call("/rotor/" + name, service));
    return service.response;
  }
  bool reached(std::uint64_t step) {
    return states.waitForLast([step](const RotorState& s) { return s.step >= step; });
  }
};

TEST_F(Services, pausedItAdvancesOnlyByStepAndShowsTheInstantReached) {
  EXPECT_FALSE(step(5).success);  // it runs
  ASSERT_TRUE(call("pause"));
  const Step::Response first = step(1);
  ASSERT_TRUE(first.success) << first.message;
  const Step::Response second = step(250);
  ASSERT_TRUE(second.success) << second.message;
  EXPECT_EQ(second.step, first.step + 250);
  EXPECT_TRUE(reached(second.step));
  EXPECT_EQ(states.last().step, second.step);
  EXPECT_EQ(states.last().sim_time, second.sim_time);
  EXPECT_FALSE(step(0).success);
  EXPECT_EQ(states.last().step, second.step);

  ASSERT_TRUE(call("unpause"));
  EXPECT_TRUE(reached(second.step + 500));
  // Nothing came twice and nothing is missing, whatever was paused and shown.
  const std::vector<RotorState> all = states.messages();
  for (std::size_t i = 1; i < all.size(); ++i) ASSERT_EQ(all[i].step, all[i - 1].step + 1);
}

TEST_F(Services, resetGoesBackToTheInitialStateWhileStepsGoOn) {
  ASSERT_TRUE(call("pause"));
  const std::uint64_t paused = step(1).step;
  ASSERT_TRUE(reached(paused));
  ASSERT_TRUE(call("reset"));
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.epoch == 1; }));
  const RotorState state = states.last();
  EXPECT_EQ(state.step, paused);  // the same instant, another epoch
  EXPECT_EQ(state.lag[0], 0.02);
  EXPECT_EQ(state.lag[1], -0.037);
  ASSERT_TRUE(call("unpause"));
  ASSERT_TRUE(call("reset"));
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.epoch == 2; }));
  const std::vector<RotorState> all = states.messages();
  for (std::size_t i = 1; i < all.size(); ++i) {
    // Paused, the next epoch begins with the instant that was shown last; running, with the one after it.
    if (all[i].epoch != 1 || all[i - 1].epoch != 0) {
      ASSERT_EQ(all[i].step, all[i - 1].step + 1) << i;
    }
    ASSERT_GE(all[i].sim_time, all[i - 1].sim_time);
  }
}

TEST_F(Services, aLoadedSnapshotContinuesBitByBitInANewEpoch) {
  constexpr std::uint32_t kSteps = 300;
  const std::string path = node.file("state.snapshot");
  ASSERT_TRUE(call("pause"));
  const std::uint64_t saved = step(1).step;
  const SaveSnapshot::Response save = file<SaveSnapshot>("save_snapshot", path);
  ASSERT_TRUE(save.success) << save.message;
  EXPECT_NE(save.message.find("step " + std::to_string(saved)), std::string::npos) << save.message;
  ASSERT_TRUE(reached(saved));
  states.clear();
  ASSERT_TRUE(step(kSteps).success);
  ASSERT_TRUE(states.waitForSize(kSteps));
  const std::vector<RotorState> first = states.messages();  // steps saved+1 .. saved+kSteps
  states.clear();

  const LoadSnapshot::Response load = file<LoadSnapshot>("load_snapshot", path);
  ASSERT_TRUE(load.success) << load.message;
  EXPECT_EQ(load.message, "");
  ASSERT_TRUE(step(kSteps).success);
  ASSERT_TRUE(states.waitForSize(kSteps + 1));
  const std::vector<RotorState> second = states.messages();  // the loaded instant, then the steps again
  ASSERT_EQ(first.size(), kSteps);
  ASSERT_EQ(second.size(), kSteps + 1);
  EXPECT_EQ(second[0].step, first.back().step);
  for (std::size_t i = 0; i < kSteps; ++i) {
    const RotorState &a = first[i], &b = second[i + 1];
    EXPECT_EQ(b.epoch, a.epoch + 1);
    EXPECT_EQ(b.command_source, "snapshot");
    EXPECT_EQ(b.step, a.step + kSteps);
    ASSERT_EQ(b.azimuth, a.azimuth);
    ASSERT_EQ(b.lag, a.lag);
    ASSERT_EQ(b.lag_rate, a.lag_rate);
    ASSERT_EQ(b.pitch, a.pitch);
    ASSERT_EQ(b.hub, a.hub);
    ASSERT_EQ(b.fuselage_pose, a.fuselage_pose);
  }
}

TEST_F(Services, whatCannotBeSavedOrLoadedIsExplained) {
  EXPECT_NE(file<SaveSnapshot>("save_snapshot", "relative").message.find("expected an absolute path"), std::string::npos);
  EXPECT_NE(file<SaveSnapshot>("save_snapshot", "/nonexistent_folder/s").message.find("/nonexistent_folder/s"), std::string::npos);
  const LoadSnapshot::Response missing = file<LoadSnapshot>("load_snapshot", "/nonexistent_folder/s");
  EXPECT_FALSE(missing.success);
  EXPECT_NE(missing.message.find("/nonexistent_folder/s"), std::string::npos);
  const std::uint64_t now = states.last().step;
  EXPECT_TRUE(reached(now + 100));  // unimpressed
  EXPECT_EQ(states.last().epoch, 0u);
}

TEST_F(Services, unpauseInterruptsALongStepRequest) {
  ASSERT_TRUE(call("pause"));
  Step::Response response;
  std::thread stepper([&] { response = step(1000000); });  // seven minutes
  const std::uint64_t now = states.last().step;
  EXPECT_TRUE(reached(now + 50));
  ASSERT_TRUE(call("unpause"));
  stepper.join();
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("interrupted"), std::string::npos) << response.message;
}

TEST(TrimService, continuesFromTheEquilibriumWithTheThrustAskedFor) {
  Collector<RotorState> states{"rotor/state"};
  NodeProcess node;
  node.set("publish_every", 1).set("set", std::vector<std::string>{"trim.controls=[swashplate.collective]", "trim.targets.rotor.hub_force_z=20000", "trim.hold=[drive.angle]"});
  node.start();
  ASSERT_TRUE(states.waitForSize(200)) << node.output();
  ASSERT_TRUE(ros::service::waitForService("/rotor/trim", 10000));
  const std::uint64_t before = states.last().step;

  Trim wrong;
  wrong.request.targets = {1.0, 2.0};
  ASSERT_TRUE(ros::service::call("/rotor/trim", wrong));
  EXPECT_FALSE(wrong.response.success);
  EXPECT_NE(wrong.response.message.find("targets has 2 values, expected 1"), std::string::npos) << wrong.response.message;

  Trim trim;
  trim.request.targets = {22000.0};  // instead of the configuration's
  ASSERT_TRUE(ros::service::call("/rotor/trim", trim));
  ASSERT_TRUE(trim.response.success) << trim.response.message;
  ASSERT_EQ(trim.response.controls, std::vector<std::string>{"swashplate.collective"});
  ASSERT_TRUE(states.waitForLast([](const RotorState& s) { return s.epoch == 1; }));
  ASSERT_TRUE(states.waitForLast([before](const RotorState& s) { return s.step > before + 100 && s.epoch == 1; }));
  const RotorState state = states.last();
  EXPECT_EQ(state.command_source, "snapshot");
  EXPECT_EQ(state.collective, trim.response.values[0]);
  // Uniform hover: the thrust of the periodic motion is constant, and it is there at once.
  EXPECT_NEAR(state.hub.force.z, 22000.0, 0.01);
}

}  // namespace
}  // namespace heerk_rotor

int main(int argc, char** argv) { return heerk_rotor::runRosTests(argc, argv, "services_rostest"); }
