#include "heerk_rotor/ros/rotor_task.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/ros/failure_report.hpp"
#include "heerk_rotor/ros/rotor_geometry.hpp"

// Every heap call of this program passes here; counted while a test wants it.
namespace {
thread_local bool counting = false;
thread_local long heap_calls = 0;
}  // namespace
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t size) {
  heap_calls += counting;
  return __libc_malloc(size);
}

namespace heerk_rotor {
namespace {

using Result = StepTask::Result;

struct Task : ::testing::Test {
  Configuration configuration = Configuration::load(HEERK_SOURCE_DIR "/config/lag_rotor_controlled.yaml", {"subsystems.swashplate.trim_collective=0.17"});
  std::unique_ptr<Simulation> simulation = buildSimulation(configuration);
  RotorView view{simulation->system()};
  CommandLimits limits = readCommandLimits(configuration, simulation->system(), view);
  int arrived = 0;
  CommandInput input{limits, false, [this] { ++arrived; }};
  RotorRing ring{4096};
  RotorInstant instant;

  static RotorTask::Options options() { return {}; }
  std::vector<RotorInstant> drain() {
    std::vector<RotorInstant> all;
    while (ring.pop(instant)) all.push_back(instant);
    return all;
  }
};

TEST_F(Task, handsEveryNthStepToItsReaders) {
  RotorTask task(*simulation, view, input, options());
  RotorRing third(4096);
  task.addRing(ring, 1);
  task.addRing(third, 3);
  for (int k = 0; k < 30; ++k) ASSERT_EQ(task.step(), Result::kOk);
  const auto all = drain();
  ASSERT_EQ(all.size(), 30u);
  for (std::size_t k = 0; k < 30; ++k) EXPECT_EQ(all[k].reading.step, k);
  ASSERT_EQ(third.size(), 10u);
  for (std::uint64_t k = 0; k < 10; ++k) {
    ASSERT_TRUE(third.pop(instant));
    EXPECT_EQ(instant.reading.step, 3 * k);
  }
  ASSERT_TRUE(task.newest().read(instant));
  EXPECT_EQ(instant.reading.step, 29u);
}

TEST_F(Task, stepsWithoutHeapCallsIncludingCommandsAndRings) {
  RotorTask::Options o = options();
  o.history = 361;
  o.timeout_policy = TimeoutPolicy::kTrim;
  RotorTask task(*simulation, view, input, o);
  task.addRing(ring, 1);
  for (int k = 0; k < 100; ++k) task.step();
  input.accept(std::array<double, 3>{0.15, 0.01, -0.01}, CommandSource::kRos);
  counting = true;
  void* volatile probe = std::malloc(1);
  const long seen = heap_calls;
  heap_calls = 0;
  for (int k = 0; k < 1000; ++k) task.step();
  counting = false;
  std::free(probe);
  EXPECT_EQ(seen, 1);  // the counter works
  EXPECT_EQ(heap_calls, 0);
  EXPECT_EQ(drain().back().source, CommandSource::kRos);
}

TEST_F(Task, aCommandIsInEffectFromTheNextStepAndNamesItsSource) {
  RotorTask task(*simulation, view, input, options());
  task.addRing(ring, 1);
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
  EXPECT_EQ(simulation->system().defaultCommand()[view.collectiveCommand()], 0.17);
}

TEST_F(Task, refusedCommandsChangeNothingAndAreCounted) {
  RotorTask task(*simulation, view, input, options());
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
    RotorTask task(*fresh, view, input, o);
    input.accept(std::array<double, 3>{0.1, 0.0, 0.0}, CommandSource::kRos);
    task.step();
    ASSERT_TRUE(task.newest().read(instant));
    EXPECT_EQ(instant.source, policy == TimeoutPolicy::kHold ? CommandSource::kRos : CommandSource::kTimeout);
    EXPECT_EQ(instant.reading.collective, policy == TimeoutPolicy::kHold ? 0.1 : 0.17);
  }
}

TEST_F(Task, showsTheSameInstantOnlyOnce) {
  RotorTask task(*simulation, view, input, options());
  task.addRing(ring, 1);
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
  RotorTask task(*simulation, view, input, o);
  task.addRing(ring, 1);
  for (int k = 0; k < 4; ++k) ASSERT_EQ(task.step(), Result::kOk);
  EXPECT_EQ(task.step(), Result::kFinished);
  EXPECT_EQ(drain().back().reading.step, 5u);
}

TEST_F(Task, inLockStepEachCommandIsWorthItsSteps) {
  CommandInput queue(limits, true, [] {});
  RotorTask::Options o = options();
  o.lock_step = 3;
  RotorTask task(*simulation, view, queue, o);
  task.addRing(ring, 1);
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

TEST_F(Task, forgettingAndResumingACommand) {
  RotorTask task(*simulation, view, input, options());
  input.accept(std::array<double, 3>{0.1, 0.0, 0.0}, CommandSource::kRos);
  task.step();
  task.forgetCommand();
  task.step();
  ASSERT_TRUE(task.newest().read(instant));
  EXPECT_EQ(instant.reading.collective, 0.17);
  EXPECT_EQ(instant.source, CommandSource::kNone);
  Vector w = simulation->system().defaultCommand();
  w[view.collectiveCommand()] = 0.08;
  task.resumeCommand(w);
  task.step();
  ASSERT_TRUE(task.newest().read(instant));
  EXPECT_EQ(instant.reading.collective, 0.08);
}

TEST_F(Task, theHistoryHoldsTheLastInstantsAndItsFileHasOneRowEach) {
  RotorTask::Options o = options();
  o.history = 20;
  RotorTask task(*simulation, view, input, o);
  for (int k = 0; k < 50; ++k) task.step();
  const auto history = task.history();
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
  const CommandLimits l = readCommandLimits(narrow, simulation->system(), view);
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
