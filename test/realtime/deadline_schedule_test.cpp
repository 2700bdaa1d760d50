#include "heerk_rotor/realtime/deadline_schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace heerk_rotor {
namespace {

constexpr std::int64_t kMillisecond = 1000000;

TEST(DeadlineSchedule, doesNotDriftWithAPeriodThatIsNoInteger) {
  // One degree of azimuth at 41 rad/s; ten hours of steps.
  const double period = 1e9 * (M_PI / 180.0) / 41.0;
  DeadlineSchedule schedule(period);
  constexpr std::int64_t kStart = 123456789;
  schedule.restart(kStart);
  constexpr std::uint64_t kSteps = 84500000;
  for (std::uint64_t k = 0; k < kSteps; ++k) schedule.advance();
  const long double exact = kStart + static_cast<long double>(kSteps) * period;
  EXPECT_LE(std::abs(static_cast<long double>(schedule.release()) - exact), 1.0L);
  // Adding up the rounded period would be wrong by this much, so the test can see the difference.
  EXPECT_GT(std::abs(static_cast<double>(kSteps) * (std::round(period) - period)), 1e6);
}

TEST(DeadlineSchedule, aDeadlineIsTheNextRelease) {
  DeadlineSchedule schedule(425697.5);
  schedule.restart(1000);
  for (int k = 0; k < 1000; ++k) {
    const std::int64_t deadline = schedule.deadline();
    schedule.advance();
    EXPECT_EQ(schedule.release(), deadline);
  }
}

TEST(DeadlineSchedule, lagUpToTheLimitKeepsTheStartAndBeyondShiftsIt) {
  DeadlineSchedule schedule(1.0 * kMillisecond);
  schedule.restart(0);
  for (int k = 0; k < 10; ++k) schedule.advance();  // release at 10 ms
  EXPECT_EQ(schedule.slip(60 * kMillisecond), 0);   // 50 ms late: still to be caught up
  EXPECT_EQ(schedule.release(), 10 * kMillisecond);
  EXPECT_EQ(schedule.slip(60 * kMillisecond + 1), 50 * kMillisecond + 1);
  EXPECT_EQ(schedule.release(), 60 * kMillisecond + 1);
  schedule.advance();
  EXPECT_EQ(schedule.release(), 61 * kMillisecond + 1);  // the period is unchanged
}

TEST(DeadlineSchedule, restartBeginsAnew) {
  DeadlineSchedule schedule(2.0 * kMillisecond);
  schedule.restart(0);
  schedule.advance();
  schedule.restart(77);
  EXPECT_EQ(schedule.release(), 77);
  EXPECT_EQ(schedule.deadline(), 77 + 2 * kMillisecond);
}

}  // namespace
}  // namespace heerk_rotor
