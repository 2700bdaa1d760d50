#include "heerk_rotor/ros/rotor_task.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/realtime/instant_feed.hpp"
#include "heerk_rotor/ros/failure_report.hpp"
#include "heerk_rotor/ros/rotor_geometry.hpp"

namespace heerk_rotor {
namespace {

using Result = StepTask::Result;

struct Task : ::testing::Test {
  Configuration configuration = Configuration::load(HEERK_SOURCE_DIR "/config/lag_rotor_controlled.yaml", {"subsystems.swashplate.trim_collective=0.17"});
  std::unique_ptr<Simulation> simulation = buildSimulation(configuration);
  CommandView commands{simulation->system()};
  CommandLimits limits = readCommandLimits(configuration, simulation->system(), commands);
  int arrived = 0;
  CommandInput input{limits, false, [this] { ++arrived; }};
  RotorRing ring{4096};
  RotorInstant instant;

  static RotorTask::Options options() { return {}; }
  /// Into `instant`.
  bool readNewest(RotorFeed& feed) {
    RotorPicture picture;
    if (!feed.newest().read(picture)) return false;
    instant = picture.instant;
    return true;
  }
  std::vector<RotorInstant> drain() {
    std::vector<RotorInstant> all;
    while (ring.pop(instant)) all.push_back(instant);
    return all;
  }
};

TEST_F(Task, handsEveryNthStepToItsReaders) {
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, input, options());
  RotorRing third(4096);
  feed.addRing(ring, 1);
  feed.addRing(third, 3);
  for (int k = 0; k < 30; ++k) ASSERT_EQ(task.step(), Result::kOk);
  const auto all = drain();
  ASSERT_EQ(all.size(), 30u);
  for (std::size_t k = 0; k < 30; ++k) EXPECT_EQ(all[k].reading.step, k);
  ASSERT_EQ(third.size(), 10u);
  for (std::uint64_t k = 0; k < 10; ++k) {
    ASSERT_TRUE(third.pop(instant));
    EXPECT_EQ(instant.reading.step, 3 * k);
  }
  ASSERT_TRUE(readNewest(feed));
  EXPECT_EQ(instant.reading.step, 29u);
}

TEST_F(Task, aCommandIsInEffectFromTheNextStepAndNamesItsSource) {
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, input, options());
  feed.addRing(ring, 1);
  task.step();
  EXPECT_TRUE(input.accept(std::vector<double>{0.12, 0.01, -0.02}, CommandSource::kRosArray));
  EXPECT_EQ(arrived, 1);
  task.step();
  const auto all = drain();
  EXPECT_EQ(all[0].source, CommandSource::kNone);
  EXPECT_EQ(all[0].reading.collective, 0.17);
  EXPECT_EQ(all[1].source, CommandSource::kRosArray);
  EXPECT_EQ(all[1].reading.collective, 0.12);
  EXPECT_EQ(all[1].reading.lateral_cyclic, 0.01);
  EXPECT_EQ(all[1].reading.longitudinal_cyclic, -0.02);
  EXPECT_EQ(simulation->system().defaultCommand()[commands.collective()], 0.17);
}

TEST_F(Task, refusedCommandsChangeNothingAndAreCounted) {
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, input, options());
  EXPECT_FALSE(input.accept(std::vector<double>{0.1, 0.0}, CommandSource::kRosArray));
  EXPECT_FALSE(input.accept(std::array<double, 3>{NAN, 0.0, 0.0}, CommandSource::kLcm));
  EXPECT_TRUE(input.accept(std::array<double, 3>{9.0, 0.0, 0.0}, CommandSource::kLcm));
  EXPECT_EQ(input.refused(), 2u);
  EXPECT_EQ(input.clamped(), 1u);
  EXPECT_EQ(input.accepted(), 1u);
  EXPECT_EQ(arrived, 1);
  EXPECT_GE(input.age(), 0.0);
}

TEST_F(Task, holdKeepsAnOldCommandAndTrimGoesBack) {
  for (const TimeoutPolicy policy : {TimeoutPolicy::kHold, TimeoutPolicy::kTrim}) {
    auto fresh = buildSimulation(configuration);
    RotorTask::Options o = options();
    o.command_timeout = 1e-9;  // everything is too old at once
    o.timeout_policy = policy;
    RotorFeed feed(fresh->system(), 20);
    RotorTask task(*fresh, feed, commands, input, o);
    input.accept(std::array<double, 3>{0.1, 0.0, 0.0}, CommandSource::kRos);
    task.step();
    ASSERT_TRUE(readNewest(feed));
    EXPECT_EQ(instant.source, policy == TimeoutPolicy::kHold ? CommandSource::kRos : CommandSource::kTimeout);
    EXPECT_EQ(instant.reading.collective, policy == TimeoutPolicy::kHold ? 0.1 : 0.17);
  }
}

TEST_F(Task, showsTheSameInstantOnlyOnce) {
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, input, options());
  feed.addRing(ring, 1);
  task.step();
  task.showPresent();
  task.showPresent();
  task.step();
  simulation->reset();
  task.showPresent();
  const auto all = drain();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].reading.step, 0u);
  EXPECT_EQ(all[1].reading.step, 1u);
  EXPECT_EQ(all[2].reading.step, 2u);
  EXPECT_EQ(all[2].reading.epoch, 1u);
}

TEST_F(Task, finishesWithTheLastInstantShown) {
  RotorTask::Options o = options();
  o.last_step = 5;
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, input, o);
  feed.addRing(ring, 1);
  for (int k = 0; k < 4; ++k) ASSERT_EQ(task.step(), Result::kOk);
  EXPECT_EQ(task.step(), Result::kFinished);
  EXPECT_EQ(drain().back().reading.step, 5u);
}

TEST_F(Task, inLockStepEachCommandIsWorthItsSteps) {
  CommandInput queue(limits, true, [] {});
  RotorTask::Options o = options();
  o.lock_step = 3;
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, queue, o);
  feed.addRing(ring, 1);
  EXPECT_FALSE(task.ready());
  queue.accept(std::array<double, 3>{0.11, 0.0, 0.0}, CommandSource::kRos);
  queue.accept(std::array<double, 3>{0.12, 0.0, 0.0}, CommandSource::kRos);
  int steps = 0;
  while (task.ready()) {
    task.step();
    ASSERT_LE(++steps, 6);
  }
  EXPECT_EQ(steps, 6);
  const auto all = drain();
  ASSERT_EQ(all.size(), 7u);  // steps 0..6: each batch ends with the instant it has led to
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_EQ(all[k].reading.step, k);
    EXPECT_EQ(all[k].reading.collective, k <= 3 ? 0.11 : 0.12);
  }
}

TEST_F(Task, aLockStepBatchEndsWithAnInstantForEveryReaderWhateverItsShare) {
  CommandInput queue(limits, true, [] {});
  RotorTask::Options o = options();
  o.lock_step = 10;
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, queue, o);
  RotorRing sparse(4096);
  feed.addRing(ring, 4);  // 10 is no multiple of 4
  feed.addRing(sparse, 1000);
  for (int batch = 1; batch <= 3; ++batch) {
    queue.accept(std::array<double, 3>{0.1 + 0.01 * batch, 0.0, 0.0}, CommandSource::kRos);
    while (task.ready()) ASSERT_EQ(task.step(), Result::kOk);
    const auto all = drain();
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(all.back().reading.step, 10u * static_cast<unsigned>(batch));
    EXPECT_EQ(all.back().reading.collective, 0.1 + 0.01 * batch);
  }
  // The multiples and the ends of the batches, each once.
  std::vector<std::uint64_t> steps;
  while (sparse.pop(instant)) steps.push_back(instant.reading.step);
  EXPECT_EQ(steps, (std::vector<std::uint64_t>{0, 10, 20, 30}));
}

TEST_F(Task, aSparseReaderGetsAnInstantThatOnlyOthersHaveSeenOnceItIsAskedFor) {
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, input, options());
  RotorRing sparse(8);
  feed.addRing(ring, 1);
  feed.addRing(sparse, 1000);
  ASSERT_EQ(task.step(), Result::kOk);
  simulation->observe(simulation->system().defaultCommand());  // step 1, as a step that then fails in a later stage does
  EXPECT_EQ(ring.size(), 2u);
  EXPECT_EQ(sparse.size(), 1u);
  task.showPresent();
  task.showPresent();
  EXPECT_EQ(ring.size(), 2u);
  ASSERT_EQ(sparse.size(), 2u);
  ASSERT_TRUE(sparse.pop(instant));
  ASSERT_TRUE(sparse.pop(instant));
  EXPECT_EQ(instant.reading.step, 1u);
}

TEST_F(Task, theSpeedCommandIsLatchedHeldAndOutlivesASwashplateTimeout) {
  HeldInput speed(simulation->system(), "speed command", commands.speed(), {"rad/s"});
  const Index entry = commands.speed().at(0);
  ASSERT_TRUE(speed.present());
  RotorTask::Options o = options();
  o.command_timeout = 1e-9;
  o.timeout_policy = TimeoutPolicy::kTrim;
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, input, o);
  task.addInput(speed);
  double in_effect = 0.0;
  struct Watch : Observer {
    Index entry;
    double& value;
    Watch(Index e, double& v) : entry(e), value(v) {}
    void observe(const Sample& sample) noexcept override { value = sample.w[entry]; }
  } watch(entry, in_effect);
  simulation->addObserver(watch);
  const double standard = simulation->system().defaultCommand()[entry];
  task.step();
  EXPECT_EQ(in_effect, standard);
  EXPECT_TRUE(speed.accept({44.0}));
  input.accept(std::array<double, 3>{0.1, 0.0, 0.0}, CommandSource::kRos);  // too old at once
  task.step();
  EXPECT_EQ(task.source(), CommandSource::kTimeout);
  EXPECT_EQ(in_effect, 44.0);
  EXPECT_FALSE(speed.accept({NAN}));
  EXPECT_FALSE(speed.accept({HUGE_VAL}));
  task.step();
  EXPECT_EQ(in_effect, 44.0);
  EXPECT_TRUE(speed.accept({1000.0}));
  task.step();
  EXPECT_EQ(in_effect, 49.2);  // the drive's max_speed
  EXPECT_TRUE(speed.accept({-1.0}));
  task.step();
  EXPECT_EQ(in_effect, 20.5);
  speed.accept({43.0});  // not taken before the reset: stale
  simulation->reset();
  task.startOver();
  task.step();
  EXPECT_EQ(in_effect, standard);
}

TEST_F(Task, startingOverAndResuming) {
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, input, options());
  input.accept(std::array<double, 3>{0.1, 0.0, 0.0}, CommandSource::kRos);
  task.step();
  task.startOver();
  task.step();
  ASSERT_TRUE(readNewest(feed));
  EXPECT_EQ(instant.reading.collective, 0.17);
  EXPECT_EQ(instant.source, CommandSource::kNone);
  Vector w = simulation->system().defaultCommand();
  w[commands.collective()] = 0.08;
  task.resume(w);
  task.step();
  ASSERT_TRUE(readNewest(feed));
  EXPECT_EQ(instant.reading.collective, 0.08);
  EXPECT_EQ(instant.source, CommandSource::kSnapshot);
  EXPECT_STREQ(name(instant.source), "snapshot");
  input.accept(std::array<double, 3>{0.1, 0.0, 0.0}, CommandSource::kRos);
  task.step();
  ASSERT_TRUE(readNewest(feed));
  EXPECT_EQ(instant.source, CommandSource::kRos);
}

TEST_F(Task, theHistoryBeginsAnewWithAResetAndALoadedState) {
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, input, options());
  for (int k = 0; k < 50; ++k) task.step();
  const auto checkpoint = simulation->checkpoint();
  simulation->reset();
  task.startOver();
  EXPECT_TRUE(feed.history().empty());
  for (int k = 0; k < 3; ++k) task.step();
  ASSERT_EQ(feed.history().size(), 3u);
  EXPECT_EQ(feed.history().front().reading.epoch, 1u);
  simulation->restore(checkpoint, true);
  task.resume(checkpoint.w);
  EXPECT_TRUE(feed.history().empty());
  task.step();
  ASSERT_EQ(feed.history().size(), 1u);
  EXPECT_EQ(feed.history().front().reading.epoch, 2u);
}

TEST_F(Task, theHistoryHoldsTheLastInstantsAndItsFileHasOneRowEach) {
  RotorFeed feed(simulation->system(), 20);
  RotorTask task(*simulation, feed, commands, input, options());
  for (int k = 0; k < 50; ++k) task.step();
  const auto history = feed.history();
  ASSERT_EQ(history.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(history[i].reading.step, 30 + i);

  const auto file = (std::filesystem::temp_directory_path() / ("heerk_rotor_history_" + std::to_string(getpid()) + ".csv")).string();
  writeFailureHistory(file, history);
  std::ifstream stream(file);
  std::string header, row;
  std::getline(stream, header);
  EXPECT_EQ(header.find("step [-],time [s],azimuth [rad],rotor_speed [rad/s],"), 0u);
  EXPECT_NE(header.find("lag_4 [rad]"), std::string::npos);
  int rows = 0;
  while (std::getline(stream, row)) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));
    EXPECT_EQ(row.find(std::to_string(30 + rows) + ","), 0u);
    ++rows;
  }
  EXPECT_EQ(rows, 20);
  std::filesystem::remove(file);
  EXPECT_THROW(writeFailureHistory("/nonexistent_folder/h.csv", history), std::runtime_error);
}

TEST_F(Task, limitsAndGeometryComeFromTheConfiguration) {
  const Configuration narrow = Configuration::load(HEERK_SOURCE_DIR "/config/lag_rotor_controlled.yaml",
                                                   {"subsystems.swashplate.collective_max=0.2", "subsystems.swashplate.cyclic_limit=0.1", "subsystems.airloads.radius=4.5"});
  const CommandLimits l = readCommandLimits(narrow, simulation->system(), commands);
  EXPECT_EQ(l.collective_max, 0.2);
  EXPECT_EQ(l.cyclic_limit, 0.1);
  EXPECT_EQ(l.collective_min, -0.0524);
  const RotorGeometry geometry = readRotorGeometry(narrow);
  EXPECT_EQ(geometry.radius, 4.5);
  EXPECT_EQ(geometry.hinge_offset, 0.2);
  EXPECT_EQ(geometry.chord, 0.32);
}

}  // namespace
}  // namespace heerk_rotor
