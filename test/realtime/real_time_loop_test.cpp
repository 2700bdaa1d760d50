#include "heerk_rotor/realtime/real_time_loop.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <vector>

namespace heerk_rotor {
namespace {

using Result = StepTask::Result;
constexpr std::int64_t kMillisecond = 1000000;

/// Time passes only when the task computes or the loop sleeps.
struct FakeClock : Clock {
  std::int64_t time = 5000 * kMillisecond;
  std::vector<std::int64_t> oversleep;  // added to the first sleeps, one each [ns]
  std::size_t sleeps = 0;
  std::int64_t now() noexcept override { return time; }
  void sleepUntil(std::int64_t until) noexcept override {
    if (until > time) time = until;
    if (sleeps < oversleep.size()) time += oversleep[sleeps];
    ++sleeps;
  }
};

/// Takes the given time for each step and ends after `last`.
struct FakeTask : StepTask {
  FakeClock& clock;
  std::uint64_t last;
  std::function<std::int64_t(std::uint64_t)> duration = [](std::uint64_t) { return kMillisecond / 10; };
  std::vector<std::int64_t> begins = {};
  FakeTask(FakeClock& c, std::uint64_t n) : clock(c), last(n) {}
  Result step() noexcept override {
    begins.push_back(clock.time);
    clock.time += duration(begins.size() - 1);
    return begins.size() == last ? Result::kFinished : Result::kOk;
  }
};

RealTimeLoopOptions milliseconds(double factor = 1.0, int steps_per_wake = 1) {
  RealTimeLoopOptions options;
  options.step = 1e-3;
  options.real_time_factor = factor;
  options.steps_per_wake = steps_per_wake;
  return options;
}

TEST(RealTimeLoop, beginsEachStepAtItsReleaseWithoutDrift) {
  FakeClock clock;
  FakeTask task(clock, 5000);
  clock.oversleep.assign(5000, 3000);  // the operating system is always 3 us late: that must not add up
  RealTimeLoop loop(task, clock, milliseconds());
  loop.run();
  ASSERT_EQ(task.begins.size(), 5000u);
  for (std::size_t k = 1; k < task.begins.size(); ++k)
    ASSERT_EQ(task.begins[k], task.begins[0] + static_cast<std::int64_t>(k) * kMillisecond + 3000);
  EXPECT_EQ(loop.timing().report().overruns, 0u);
  EXPECT_EQ(loop.mode(), RealTimeLoop::Mode::kFinished);
}

TEST(RealTimeLoop, theRealTimeFactorScalesThePeriod) {
  for (const double factor : {0.25, 2.0}) {
    FakeClock clock;
    FakeTask task(clock, 101);
    RealTimeLoop loop(task, clock, milliseconds(factor));
    loop.run();
    EXPECT_EQ(task.begins[100] - task.begins[0], static_cast<std::int64_t>(100 * kMillisecond / factor));
  }
}

TEST(RealTimeLoop, sleepsOncePerWakeUp) {
  FakeClock clock;
  FakeTask task(clock, 400);
  RealTimeLoop loop(task, clock, milliseconds(1.0, 4));
  loop.run();
  EXPECT_EQ(clock.sleeps, 99u);  // the first of 100 batches starts at once
  EXPECT_EQ(task.begins[4] - task.begins[0], 4 * kMillisecond);
  EXPECT_EQ(loop.timing().report().steps, 400u);
}

TEST(RealTimeLoop, catchesUpAfterAStallWithoutLeavingOutAStep) {
  FakeClock clock;
  FakeTask task(clock, 100);
  clock.oversleep.assign(11, 0);
  clock.oversleep[10] = 7 * kMillisecond;  // the host stalls during one sleep: step 11 begins 7 ms late
  RealTimeLoop loop(task, clock, milliseconds());
  loop.run();
  const TimingReport report = loop.timing().report();
  ASSERT_EQ(report.steps, 100u);
  // Steps 11 and on begin one after the other, 0.1 ms each, until the schedule is met again: 7 ms / 0.9 ms = 7.8 -> step 19.
  EXPECT_EQ(task.begins[11], task.begins[0] + 18 * kMillisecond);
  EXPECT_EQ(task.begins[12], task.begins[11] + kMillisecond / 10);
  EXPECT_EQ(task.begins[19], task.begins[0] + 19 * kMillisecond);
  EXPECT_EQ(task.begins[99], task.begins[0] + 99 * kMillisecond);
  // Overruns: steps k with finish 18.1 + 0.1 (k - 11) > k + 1, that is k = 11..17; all for one reason.
  EXPECT_EQ(report.late_wake_ups, 7u);
  EXPECT_EQ(report.long_steps, 0u);
  EXPECT_EQ(report.slips, 0u);
}

TEST(RealTimeLoop, slipsWhenTheLagExceedsFiftyMilliseconds) {
  FakeClock clock;
  FakeTask task(clock, 100);
  task.duration = [](std::uint64_t k) { return k == 10 ? 80 * kMillisecond : kMillisecond / 10; };
  RealTimeLoop loop(task, clock, milliseconds());
  loop.run();
  const TimingReport report = loop.timing().report();
  EXPECT_EQ(report.slips, 1u);
  EXPECT_EQ(report.slipped, 79 * kMillisecond);  // released at 11 ms, noticed at 90 ms
  EXPECT_EQ(report.steps, 100u);
  EXPECT_EQ(report.long_steps, 1u);
  EXPECT_EQ(report.overruns, 1u);
  EXPECT_EQ(task.begins[99], task.begins[0] + (99 + 79) * kMillisecond);
}

TEST(RealTimeLoop, overloadIsCountedAsLongSteps) {
  FakeClock clock;
  FakeTask task(clock, 200);
  task.duration = [](std::uint64_t) { return 2 * kMillisecond; };  // twice what is there
  RealTimeLoop loop(task, clock, milliseconds());
  loop.run();
  const TimingReport report = loop.timing().report();
  EXPECT_EQ(report.long_steps, 200u);
  EXPECT_EQ(report.late_wake_ups, 0u);
  EXPECT_GE(report.slips, 3u);  // 200 ms of lag, 50 ms at a time
}

TEST(RealTimeLoop, asFastAsPossibleNeverSleepsAndHasNoOverruns) {
  FakeClock clock;
  FakeTask task(clock, 1000);
  RealTimeLoop loop(task, clock, milliseconds(0.0));
  loop.run();
  EXPECT_EQ(clock.sleeps, 0u);
  EXPECT_EQ(loop.timing().report().overruns, 0u);
  EXPECT_EQ(task.begins[999] - task.begins[0], 999 * (kMillisecond / 10));
}

TEST(RealTimeLoop, refusesOptionsThatMakeNoSense) {
  FakeClock clock;
  FakeTask task(clock, 1);
  EXPECT_THROW(RealTimeLoop(task, clock, milliseconds(-1.0)), std::invalid_argument);
  EXPECT_THROW(RealTimeLoop(task, clock, milliseconds(1.0, 0)), std::invalid_argument);
  RealTimeLoopOptions options;
  options.step = 0.0;
  EXPECT_THROW(RealTimeLoop(task, clock, options), std::invalid_argument);
}

/// On the real clock and thread: counts, and fails or waits when told to. Touched through call() only.
struct CountingTask : StepTask {
  std::uint64_t count = 0, fail_at = 0, allowed = RealTimeLoop::kUnlimited;
  Result step() noexcept override {
    if (fail_at != 0 && count == fail_at) return Result::kFailed;
    ++count;
    if (allowed != RealTimeLoop::kUnlimited) --allowed;
    return Result::kOk;
  }
  bool ready() noexcept override { return allowed > 0; }
};

struct LiveLoop : ::testing::Test {
  CountingTask task;
  MonotonicClock clock;
  RealTimeLoop loop{task, clock, milliseconds(0.0)};
  std::uint64_t count() {
    std::uint64_t n = 0;
    EXPECT_TRUE(loop.call([&] { n = task.count; }));
    return n;
  }
  /// Awaits a condition that the loop brings about.
  template <class Condition>
  bool eventually(Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!condition() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    return condition();
  }
};

TEST_F(LiveLoop, startedPausedItMakesExactlyTheStepsAskedFor) {
  loop.start(true);
  EXPECT_EQ(count(), 0u);
  EXPECT_TRUE(loop.step(7));
  EXPECT_EQ(count(), 7u);
  EXPECT_TRUE(loop.step(1));
  EXPECT_EQ(count(), 8u);
  EXPECT_EQ(loop.mode(), RealTimeLoop::Mode::kPaused);
  EXPECT_FALSE(loop.step(0));
}

TEST_F(LiveLoop, pausesAndGoesOn) {
  loop.start();
  EXPECT_TRUE(eventually([&] { return count() > 100; }));
  EXPECT_FALSE(loop.step(3));  // it runs: refused
  EXPECT_TRUE(loop.pause());
  const std::uint64_t paused = count();
  EXPECT_TRUE(loop.step(5));
  EXPECT_EQ(count(), paused + 5);  // nothing else has stepped meanwhile
  EXPECT_TRUE(loop.unpause());
  EXPECT_TRUE(eventually([&] { return count() > paused + 1000; }));
}

TEST_F(LiveLoop, aFailedStepStopsItButCallsGoOn) {
  task.fail_at = 50;
  loop.start();
  EXPECT_TRUE(eventually([&] { return loop.mode() == RealTimeLoop::Mode::kFailed; }));
  EXPECT_EQ(count(), 50u);
  EXPECT_FALSE(loop.step(1));
  EXPECT_TRUE(loop.recover([&] { task.count = 0, task.fail_at = 0; }));
  EXPECT_TRUE(eventually([&] { return count() > 100; }));
}

TEST_F(LiveLoop, aStepRequestThatFailsSaysSoAndRecoveryStaysPaused) {
  task.fail_at = 3;
  loop.start(true);
  EXPECT_FALSE(loop.step(10));
  EXPECT_EQ(loop.mode(), RealTimeLoop::Mode::kFailed);
  EXPECT_TRUE(loop.recover([&] { task.fail_at = 0; }));
  EXPECT_EQ(loop.mode(), RealTimeLoop::Mode::kPaused);
  EXPECT_EQ(count(), 3u);
}

TEST_F(LiveLoop, nobodySeesAMendedTaskInAFailedLoop) {
  task.fail_at = 1;
  loop.start();
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> looks{0};
  std::uint64_t contradictions = 0;  // changed on the loop's thread only
  std::thread onlooker([&] {
    while (!done)
      loop.call([&] {
        ++looks;
        if (loop.mode() == RealTimeLoop::Mode::kFailed && task.count != task.fail_at) ++contradictions;
      });
  });
  const bool looking = eventually([&] { return looks > 0; });  // on a busy machine the onlooker may begin late
  for (int k = 0; k < 300; ++k) {
    ASSERT_TRUE(eventually([&] { return loop.mode() == RealTimeLoop::Mode::kFailed; }));
    ASSERT_TRUE(loop.recover([&] { task.fail_at = task.count + 3; }));
  }
  done = true;
  onlooker.join();
  EXPECT_TRUE(looking);
  EXPECT_EQ(contradictions, 0u);
}

TEST_F(LiveLoop, aMendingThatThrowsLeavesItFailed) {
  task.fail_at = 5;
  loop.start();
  EXPECT_TRUE(eventually([&] { return loop.mode() == RealTimeLoop::Mode::kFailed; }));
  EXPECT_THROW(loop.recover([] { throw std::runtime_error("does not fit"); }), std::runtime_error);
  EXPECT_EQ(loop.mode(), RealTimeLoop::Mode::kFailed);
  loop.stop();
  EXPECT_FALSE(loop.recover([] {}));
}

TEST_F(LiveLoop, waitsForATaskThatIsNotReady) {
  task.allowed = 4;
  loop.start();
  EXPECT_TRUE(eventually([&] { return count() == 4; }));
  EXPECT_TRUE(loop.call([&] { task.allowed = 6; }));
  EXPECT_TRUE(eventually([&] { return count() == 10; }));
  EXPECT_TRUE(loop.call([] {}));
  EXPECT_EQ(count(), 10u);
}

TEST_F(LiveLoop, passesOnWhatACallThrows) {
  loop.start();
  EXPECT_THROW(loop.call([] { throw std::runtime_error("from the action"); }), std::runtime_error);
  EXPECT_TRUE(eventually([&] { return count() > 10; }));
}

TEST_F(LiveLoop, callsFromSeveralThreadsAllRun) {
  loop.start();
  std::uint64_t sum = 0;  // changed on the loop's thread only
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 500; ++i) loop.call([&] { ++sum; });
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(sum, 2000u);
}

TEST_F(LiveLoop, refusesCallsAfterTheEnd) {
  loop.start();
  loop.stop();
  bool ran = false;
  EXPECT_FALSE(loop.call([&] { ran = true; }));
  EXPECT_FALSE(ran);
  EXPECT_FALSE(loop.step(1));
}

TEST_F(LiveLoop, stopEndsAStepRequestThatWaits) {
  task.allowed = 2;
  loop.start(true);
  std::thread stepper([&] { EXPECT_FALSE(loop.step(5)); });
  EXPECT_TRUE(eventually([&] { return count() == 2; }));
  loop.stop();
  stepper.join();
}

TEST(RealTimeThread, reportsWhatWasRefused) {
  RealTimeRights rights;
  std::thread([&] { rights = prepareRealTimeThread(1000); }).join();  // no system grants a priority above 99
  EXPECT_FALSE(rights.fifo);
  EXPECT_NE(rights.complaint.find("SCHED_FIFO priority 1000 refused"), std::string::npos) << rights.complaint;
  EXPECT_NE(rights.text(1000).find("normal priority"), std::string::npos);
}

/// A real second of half-millisecond steps: nobody can promise that the host does not stall, but every overrun must be
/// accounted for and the schedule may differ from real time by nothing but slips.
TEST(RealTimeLoop, keepsRealTimeOnTheRealClock) {
  struct Task : StepTask {
    std::uint64_t count = 0;
    Result step() noexcept override { return ++count == 2001 ? Result::kFinished : Result::kOk; }
  } task;
  MonotonicClock clock;
  RealTimeLoopOptions options;
  options.step = 5e-4;
  RealTimeLoop loop(task, clock, options);
  const std::int64_t begin = clock.now();
  loop.run();
  const std::int64_t elapsed = clock.now() - begin;
  const TimingReport report = loop.timing().report();
  EXPECT_EQ(report.steps, 2001u);
  EXPECT_EQ(report.overruns, report.late_wake_ups + report.long_steps);
  EXPECT_GE(elapsed, 1000 * kMillisecond + report.slipped);
  // The last step may be late by itself; nothing before it may have added up. 1 ms for entering and leaving run().
  EXPECT_LE(elapsed, 1000 * kMillisecond + report.slipped + report.lateness.maximum + report.step_time.maximum + kMillisecond);
  EXPECT_EQ(report.lateness.total(), 2001u);
}

}  // namespace
}  // namespace heerk_rotor
