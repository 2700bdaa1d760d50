// The shipped shaft through task and feed: what leaves the step thread equals the simulation, without touching the heap.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/realtime/instant_feed.hpp"
#include "heerk_rotor/ros/failure_report.hpp"
#include "heerk_rotor/ros/rotor_task.hpp"
#include "models/allocation_counter.hpp"

namespace heerk_rotor {
namespace {

struct ShaftStepPath : ::testing::Test {
  explicit ShaftStepPath(std::vector<std::string> set = {}) : configuration(Configuration::load(HEERK_SOURCE_DIR "/config/dual_disc.yaml", set)) {}
  Configuration configuration;
  std::unique_ptr<Simulation> simulation = buildSimulation(configuration);
  CommandView commands{simulation->system()};
  CommandInput input{CommandLimits(), false, [] {}};
  ShaftFeed feed{simulation->system(), 30};
  RotorTask task{*simulation, feed, commands, input, {}};
};

TEST_F(ShaftStepPath, theReadingIsWhatTheSignalsSay) {
  ShaftRing ring(16);
  feed.addRing(ring, 100);
  struct Watch : Observer {
    Vector y;
    void observe(const Sample& sample) noexcept override {
      if (sample.step == 300) y = sample.y;
    }
  } watch;
  simulation->addObserver(watch);
  for (int k = 0; k < 301; ++k) ASSERT_EQ(task.step(), StepTask::Result::kOk);
  ASSERT_EQ(ring.size(), 4u);
  ShaftInstant instant;
  for (std::uint64_t k = 0; ring.pop(instant); ++k) EXPECT_EQ(instant.reading.step, 100 * k);
  const ShaftReading& r = instant.reading;
  const auto y = [&](const std::string& name) { return watch.y[simulation->system().signal(name).index]; };
  EXPECT_EQ(r.sim_time, 300 * 1e-5);
  ASSERT_EQ(r.discs, 2);
  EXPECT_EQ(r.disc_x[0], y("shaft.disc_1_x"));
  EXPECT_EQ(r.disc_y[1], y("shaft.disc_2_y"));
  EXPECT_EQ(r.journal_x, y("shaft.journal_x"));
  EXPECT_EQ(r.journal_y, y("shaft.journal_y"));
  EXPECT_EQ(r.film_force_x, y("film.film_force_x"));
  EXPECT_EQ(r.film_force_y, y("film.film_force_y"));
  EXPECT_EQ(r.eccentricity_ratio, y("film.eccentricity_ratio"));
  EXPECT_EQ(r.bearing_force_x, y("shaft.bearing_1_x"));
  EXPECT_EQ(r.bearing_force_y, y("shaft.bearing_1_y"));
  EXPECT_NE(r.disc_x[0], 0.0);
  EXPECT_NE(r.film_force_x, 0.0);
  EXPECT_NEAR(r.rotor_speed, 5000.0 * M_PI / 30.0, 1e-9);
  EXPECT_NEAR(r.azimuth, r.rotor_speed * r.sim_time, 1e-9);
  ShaftPicture picture;
  ASSERT_TRUE(feed.newest().read(picture));
  EXPECT_EQ(picture.shape.nodes, 9);
}

TEST_F(ShaftStepPath, makesNoHeapCall) {
  if (!test::heapIsCounted()) GTEST_SKIP() << "the heap cannot be counted here";
  ShaftRing ring(1024);
  feed.addRing(ring, 1);
  ASSERT_EQ(task.step(), StepTask::Result::kOk);
  std::uint64_t calls = 0, seen = 0;
  {
    test::HeapCalls heap;
    void* volatile probe = std::malloc(1);
    seen = heap.count();
    for (int k = 0; k < 20000; ++k) task.step();
    calls = heap.count() - seen;
    std::free(probe);
  }
  EXPECT_EQ(seen, 1u);  // the counter works
  EXPECT_EQ(calls, 0u);
  EXPECT_EQ(simulation->stepCount(), 20001u);
  EXPECT_EQ(ring.dropped(), 20001u - ring.capacity());
}

TEST_F(ShaftStepPath, theHistoryOfAFailureHasOneRowPerStep) {
  for (int k = 0; k < 50; ++k) task.step();
  const auto history = feed.history();
  ASSERT_EQ(history.size(), 30u);
  const auto file = (std::filesystem::temp_directory_path() / ("heerk_shaft_history_" + std::to_string(getpid()) + ".csv")).string();
  writeFailureHistory(file, history);
  std::ifstream stream(file);
  std::string header, row;
  std::getline(stream, header);
  EXPECT_EQ(header.find("step [-],time [s],azimuth [rad],rotor_speed [rad/s],journal_x [m],"), 0u) << header;
  EXPECT_NE(header.find(",disc_2_y [m],newton_iterations [-]"), std::string::npos) << header;
  int rows = 0;
  for (; std::getline(stream, row); ++rows) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));
    EXPECT_EQ(row.find(std::to_string(20 + rows) + ","), 0u);
  }
  EXPECT_EQ(rows, 30);
  std::filesystem::remove(file);
}

/// With `drive` in the place of `speed_ramp` the shaft follows a command.
struct DrivenShaft : ShaftStepPath {
  DrivenShaft() : ShaftStepPath({"subsystems.drive.type=drive"}) {}
};

TEST_F(DrivenShaft, followsTheSpeedCommand) {
  HeldInput speed(simulation->system(), "speed command", commands.speed(), {"rad/s"});
  ASSERT_TRUE(speed.present());
  task.addInput(speed);
  ASSERT_TRUE(speed.accept({540.0}));
  for (int k = 0; k < 5000; ++k) ASSERT_EQ(task.step(), StepTask::Result::kOk);
  ShaftPicture picture;
  ASSERT_TRUE(feed.newest().read(picture));
  EXPECT_GT(picture.instant.reading.rotor_speed, 5000.0 * M_PI / 30.0 + 1e-4);
}

}  // namespace
}  // namespace heerk_rotor
