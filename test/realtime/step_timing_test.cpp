#include "heerk_rotor/realtime/step_timing.hpp"

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

TEST(DurationHistogram, binsAreContiguousAndAnEighthOfAnOctaveWide) {
  for (int bin = 1; bin < DurationHistogram::kBins; ++bin) {
    const std::int64_t low = DurationHistogram::upperEdge(bin - 1) + 1, high = DurationHistogram::upperEdge(bin);
    ASSERT_LE(low, high);
    EXPECT_EQ(DurationHistogram::bin(low), bin);
    EXPECT_EQ(DurationHistogram::bin(high), bin);
    EXPECT_LE(static_cast<double>(high - low), 0.125 * static_cast<double>(low));
  }
  EXPECT_EQ(DurationHistogram::bin(-5), 0);
  EXPECT_EQ(DurationHistogram::bin(std::int64_t{1} << 60), DurationHistogram::kBins - 1);
}

TEST(DurationHistogram, percentilesAreWithinTheirBin) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.counts().percentile(0.5), 0);
  for (int i = 1; i <= 10000; ++i) histogram.add(i);
  const DurationHistogram::Counts counts = histogram.counts();
  EXPECT_EQ(counts.total(), 10000u);
  EXPECT_EQ(counts.maximum, 10000);
  EXPECT_EQ(counts.percentile(1.0), 10000);
  for (const double q : {0.01, 0.5, 0.9, 0.99}) {
    EXPECT_GE(counts.percentile(q), static_cast<std::int64_t>(10000 * q));
    EXPECT_LE(static_cast<double>(counts.percentile(q)), 10000 * q * 1.125 + 1);
  }
}

TEST(DurationHistogram, sinceGivesTheWindow) {
  DurationHistogram histogram;
  for (int i = 0; i < 100; ++i) histogram.add(1000);
  const DurationHistogram::Counts before = histogram.counts();
  for (int i = 0; i < 10; ++i) histogram.add(64);
  const DurationHistogram::Counts window = histogram.counts().since(before);
  EXPECT_EQ(window.total(), 10u);
  EXPECT_LE(window.percentile(1.0), 71);
}

TEST(StepTiming, aStepInTimeIsNoOverrunEvenIfItBeganLate) {
  StepTiming timing;
  timing.record(1, 0, 40, 100, 100);
  EXPECT_EQ(timing.report().overruns, 0u);
  EXPECT_EQ(timing.report().steps, 1u);
  EXPECT_EQ(timing.report().lateness.maximum, 40);
  EXPECT_EQ(timing.report().step_time.maximum, 60);
}

TEST(StepTiming, tellsALongStepFromALateWakeUp) {
  StepTiming timing;
  timing.record(1, 0, 0, 101, 100);  // computed longer than its period
  EXPECT_EQ(timing.report().long_steps, 1u);
  EXPECT_EQ(timing.report().late_wake_ups, 0u);
  timing.record(1, 200, 210, 220, 300);  // in time
  timing.record(1, 300, 390, 401, 400);  // short, but begun late
  EXPECT_EQ(timing.report().long_steps, 1u);
  EXPECT_EQ(timing.report().late_wake_ups, 1u);
  EXPECT_EQ(timing.report().overruns, 2u);
}

TEST(StepTiming, backlogCarriesTheCauseThatMadeIt) {
  StepTiming timing;
  timing.record(1, 0, 0, 350, 100);      // long step: the next two are late because of it
  timing.record(1, 100, 350, 360, 200);
  timing.record(1, 200, 360, 370, 300);
  timing.record(1, 300, 370, 380, 400);  // caught up
  EXPECT_EQ(timing.report().long_steps, 3u);
  EXPECT_EQ(timing.report().late_wake_ups, 0u);
  timing.record(1, 400, 590, 600, 500);  // late wake-up, one follower
  timing.record(1, 500, 600, 610, 600);
  EXPECT_EQ(timing.report().long_steps, 3u);
  EXPECT_EQ(timing.report().late_wake_ups, 2u);
}

TEST(StepTiming, aBatchCountsAllItsSteps) {
  StepTiming timing;
  timing.record(4, 0, 0, 500, 400);
  EXPECT_EQ(timing.report().steps, 4u);
  EXPECT_EQ(timing.report().overruns, 4u);
}

TEST(StepTiming, addsUpSlips) {
  StepTiming timing;
  timing.recordSlip(60);
  timing.recordSlip(5);
  EXPECT_EQ(timing.report().slips, 2u);
  EXPECT_EQ(timing.report().slipped, 65);
}

}  // namespace
}  // namespace heerk_rotor
