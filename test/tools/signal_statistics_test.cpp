#include "heerk_rotor/tools/signal_statistics.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

/// Shows a signal's values at t = step * h to the statistics.
SignalSummary summarise(double h, std::uint64_t last_step, double window, std::uint64_t every, double (*value)(double)) {
  Signal signal;
  signal.kind = Signal::Kind::kOutput;
  signal.index = 0;
  SignalStatistics statistics({signal}, 0, last_step, h, window, every);
  Vector x(0), w(0), y(1);
  const SolverCounters counters;
  for (std::uint64_t step = 0; step <= last_step; ++step) {
    if (!statistics.wants(step)) continue;
    const double t = static_cast<double>(step) * h;
    y[0] = value(t);
    statistics.observe({step, 0, t, x, w, y, counters, 0, 0});
  }
  return statistics.summary(0);
}

/// 3 + 2 sin(2 pi t), and 100 at the start: a transient that the last revolution must not see.
double periodicAfterTransient(double t) { return t < 0.5 ? 100.0 : 3.0 + 2.0 * std::sin(2.0 * M_PI * t); }

TEST(SignalStatistics, meanAndHalfPeakToPeakAreThoseOfTheLastRevolution) {
  const SignalSummary s = summarise(1.0 / 360.0, 3 * 360, 1.0, 1, periodicAfterTransient);
  EXPECT_NEAR(s.mean, 3.0, 1e-12) << "a whole number of steps per period integrates a sine to round-off";
  EXPECT_NEAR(s.half_peak_to_peak, 2.0, 1e-12) << "steps 90 and 270 are the peaks";
  EXPECT_NEAR(s.final, 3.0, 1e-12);
  EXPECT_EQ(s.max, 100.0) << "of the whole run";
  EXPECT_NEAR(s.min, 1.0, 1e-12);
}

TEST(SignalStatistics, aRevolutionThatIsNoMultipleOfTheStepBeginsWithinAStep) {
  // y = t over the last 1.25 s with h = 0.5 s: from 0.75 to 2, mean 1.375, half peak-to-peak 0.625, exact for straight lines.
  const SignalSummary s = summarise(0.5, 4, 1.25, 1, [](double t) { return t; });
  EXPECT_DOUBLE_EQ(s.mean, 1.375);
  EXPECT_DOUBLE_EQ(s.half_peak_to_peak, 0.625);
}

TEST(SignalStatistics, aRunShorterThanARevolutionIsTakenWhole) {
  const SignalSummary s = summarise(0.5, 2, 10.0, 1, [](double t) { return t; });
  EXPECT_DOUBLE_EQ(s.mean, 0.5);
  EXPECT_DOUBLE_EQ(s.half_peak_to_peak, 0.5);
}

TEST(SignalStatistics, aRunWithoutStepsIsItsInitialInstant) {
  const SignalSummary s = summarise(0.5, 0, 1.0, 1, [](double) { return 7.0; });
  for (const double value : {s.final, s.mean, s.min, s.max}) EXPECT_EQ(value, 7.0);
  EXPECT_EQ(s.half_peak_to_peak, 0.0);
}

TEST(SignalStatistics, everyNthInstantAndTheLastOneAreTaken) {
  // Steps 0, 3, 6, 7 of y = t with h = 1 s: straight lines between them lose nothing.
  const SignalSummary s = summarise(1.0, 7, 2.0, 3, [](double t) { return t; });
  EXPECT_DOUBLE_EQ(s.mean, 6.0);
  EXPECT_EQ(s.final, 7.0);
}

}  // namespace
}  // namespace heerk_rotor
