// The complete step path - loop, command input, simulation, rings, timing - never touches the heap.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/realtime/instant_feed.hpp"
#include "heerk_rotor/realtime/real_time_loop.hpp"
#include "heerk_rotor/ros/rotor_geometry.hpp"
#include "heerk_rotor/ros/rotor_task.hpp"
#include "models/allocation_counter.hpp"

namespace heerk_rotor {
namespace {

/// Sleeping is free: a paced run that takes no longer than its computations.
struct EagerClock : Clock {
  MonotonicClock real;
  std::int64_t slept = 0;
  std::int64_t now() noexcept override { return real.now() + slept; }
  void sleepUntil(std::int64_t until) noexcept override {
    if (const std::int64_t wait = until - now(); wait > 0) slept += wait;
  }
};

TEST(StepPath, makesNoHeapCallInAHundredThousandPacedStepsWithCommandsArriving) {
  if (!test::heapIsCounted()) GTEST_SKIP() << "the heap cannot be counted here";
  constexpr std::uint64_t kSteps = 100000;
  const Configuration configuration = Configuration::load(HEERK_SOURCE_DIR "/config/lag_rotor_controlled.yaml");
  const std::unique_ptr<Simulation> simulation = buildSimulation(configuration);
  const CommandView commands(simulation->system());
  RotorFeed feed(simulation->system(), 361);
  RealTimeLoop* waking = nullptr;
  CommandInput input(readCommandLimits(configuration, simulation->system(), commands), false, [&] { waking->wake(); });
  HeldInput speed(simulation->system(), "speed command", commands.speed(), {"rad/s"});
  ASSERT_TRUE(speed.present());
  RotorTask::Options options;
  options.timeout_policy = TimeoutPolicy::kTrim;
  options.command_timeout = 0.005;  // time-outs happen as well
  options.last_step = kSteps;
  RotorTask task(*simulation, feed, commands, input, options);
  task.addInput(speed);
  RotorRing every(1024), fourth(1024), log(1024);
  EagerClock clock;
  RealTimeLoop loop(task, clock, {simulation->stepSize(), 1.0, 1, 0});
  waking = &loop;
  feed.addRing(every, 1);
  feed.addRing(fourth, 4);
  feed.addLosslessRing(log, loop.stopRequested());

  // All that surrounds the step thread in the node; their own heap calls do not count.
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> logged{0}, requests{0};
  std::thread reader([&] {
    RotorInstant instant;
    RotorPicture picture;
    while (!done || log.size() > 0) {
      if (log.popWaiting(instant, std::chrono::milliseconds(5))) ++logged;
      while (every.pop(instant)) {
      }
      while (fourth.pop(instant)) {
      }
      feed.newest().read(picture);
    }
  });
  std::thread controller([&] {
    for (int k = 0; !done; ++k) {
      input.accept(std::array<double, 3>{0.17 + 0.01 * std::sin(0.1 * k), 0.001, -0.001}, k % 2 == 0 ? CommandSource::kRos : CommandSource::kLcm);
      speed.accept({41.0 + 0.5 * std::sin(0.05 * k)});
      if (logged > 0 && !loop.ended() && loop.call([] {})) ++requests;  // as the diagnostics do
      std::this_thread::sleep_for(std::chrono::milliseconds(k % 10 == 0 ? 20 : 1));  // the pause lets a command time out
    }
  });

  std::uint64_t calls = 0, seen = 0;
  {
    test::HeapCalls heap;
    void* volatile probe = std::malloc(1);
    seen = heap.count();
    loop.run();
    calls = heap.count() - seen;
    std::free(probe);
  }
  done = true;
  reader.join();
  controller.join();
  EXPECT_EQ(seen, 1u);  // the counter works
  EXPECT_EQ(calls, 0u);
  EXPECT_EQ(loop.mode(), RealTimeLoop::Mode::kFinished) << task.failureText();
  EXPECT_EQ(loop.timing().report().steps, kSteps);
  EXPECT_EQ(loop.timing().report().lateness.total(), kSteps);
  EXPECT_EQ(logged, kSteps + 1);  // and the end
  EXPECT_GT(input.accepted(), 20u);
  EXPECT_GT(requests, 20u);
}

TEST(StepPath, makesNoHeapCallWithElasticBladesAndDisturbances) {
  if (!test::heapIsCounted()) GTEST_SKIP() << "the heap cannot be counted here";
  const Configuration configuration = Configuration::load(HEERK_SOURCE_DIR "/config/bo105.yaml");
  const std::unique_ptr<Simulation> simulation = buildSimulation(configuration);
  const CommandView commands(simulation->system());
  RotorFeed feed(simulation->system(), 361);
  CommandInput input(readCommandLimits(configuration, simulation->system(), commands), false, [] {});
  HeldInput wind(simulation->system(), "wind", commands.wind(), {"m/s"});
  HeldInput wrench(simulation->system(), "external wrench", commands.externalWrench(), {"N", "N", "N", "N m"});
  ASSERT_TRUE(wind.present() && wrench.present());
  RotorTask task(*simulation, feed, commands, input, {});
  task.addInput(wind);
  task.addInput(wrench);
  struct Watch : Observer {
    Vector w;
    void observe(const Sample& sample) noexcept override { w = sample.w; }
  } watch;
  simulation->addObserver(watch);
  ASSERT_EQ(task.step(), StepTask::Result::kOk);  // the watch takes its memory
  wind.accept({-5.0, 1.0, 0.5});
  wrench.accept({0.0, 100.0, 2000.0, 50.0, -60.0, 70.0});
  std::uint64_t calls = 0;
  {
    test::HeapCalls heap;
    for (int k = 0; k < 720; ++k) task.step();
    calls = heap.count();
  }
  EXPECT_EQ(calls, 0u);
  const std::vector<Index>& w = commands.wind();
  EXPECT_EQ(watch.w[w[0]], -5.0);
  EXPECT_EQ(watch.w[w[1]], 1.0);
  EXPECT_EQ(watch.w[w[2]], 0.5);
  const std::vector<Index>& f = commands.externalWrench();
  EXPECT_EQ(watch.w[f[2]], 2000.0);
  EXPECT_EQ(watch.w[f[5]], 70.0);

  RotorPicture picture;
  ASSERT_TRUE(feed.newest().read(picture));
  ASSERT_EQ(picture.shape.blades, 4);
  ASSERT_EQ(picture.shape.sections, 10);
  double lift = 0.0;
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 10; ++i) lift += static_cast<double>(picture.shape.section[k][i].load);
  // Two revolutions after the start all of the thrust is air load but for what still accelerates blades and fuselage.
  EXPECT_NEAR(lift, picture.instant.reading.hub_force[2], 0.3 * lift);
  const BladeShapes::Section& tip = picture.shape.section[0][9];
  EXPECT_NEAR(tip.position[0], 4.91 - 0.5 * 0.383, 0.02);  // the middle of the outermost of ten segments from 1.08 m on
  EXPECT_GT(tip.position[2], 0.05);                        // coned
  EXPECT_GT(tip.chordwise[1], 0.98);                       // the leading edge forward

  const RotorGeometry geometry = readRotorGeometry(configuration);
  ASSERT_EQ(geometry.sections.size(), 10u);
  EXPECT_NEAR(geometry.sections[3].width, 0.383, 1e-12);
  EXPECT_EQ(geometry.sections[3].chord, 0.27);
  EXPECT_EQ(geometry.radius, 4.91);
  EXPECT_NEAR(geometry.root_cutout, 1.08, 1e-12);
  EXPECT_FALSE(geometry.clockwise);
  EXPECT_TRUE(readRotorGeometry(Configuration::load(HEERK_SOURCE_DIR "/config/bo105.yaml", {"subsystems.fuselage.rotation=cw"})).clockwise);
}

}  // namespace
}  // namespace heerk_rotor
