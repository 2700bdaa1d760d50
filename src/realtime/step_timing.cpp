#include "heerk_rotor/realtime/step_timing.hpp"

namespace heerk_rotor {

void StepTiming::record(std::uint64_t steps, std::int64_t release, std::int64_t begin, std::int64_t finish, std::int64_t deadline) noexcept {
  recordUnpaced(steps, begin, finish);
  lateness_.add(begin - release);
  if (finish <= deadline) {
    backlog_ = Cause::kNone;
    return;
  }
  if (finish - begin > deadline - release) {
    backlog_ = Cause::kLongStep;
  } else if (backlog_ == Cause::kNone) {
    backlog_ = Cause::kLateWakeUp;
  }
  increase(backlog_ == Cause::kLongStep ? long_steps_ : late_wake_ups_, steps);
}

void StepTiming::recordUnpaced(std::uint64_t steps, std::int64_t begin, std::int64_t finish) noexcept {
  increase(steps_, steps);
  step_time_.add(finish - begin);
}

void StepTiming::recordSlip(std::int64_t nanoseconds) noexcept {
  increase(slips_, 1);
  increase(slipped_, static_cast<std::uint64_t>(nanoseconds));
}

std::uint64_t StepTiming::overruns() const noexcept {
  return late_wake_ups_.load(std::memory_order_relaxed) + long_steps_.load(std::memory_order_relaxed);
}

TimingReport StepTiming::report() const noexcept {
  TimingReport report;
  report.steps = steps_.load(std::memory_order_relaxed);
  report.late_wake_ups = late_wake_ups_.load(std::memory_order_relaxed);
  report.long_steps = long_steps_.load(std::memory_order_relaxed);
  report.overruns = report.late_wake_ups + report.long_steps;
  report.slips = slips_.load(std::memory_order_relaxed);
  report.slipped = static_cast<std::int64_t>(slipped_.load(std::memory_order_relaxed));
  report.lateness = lateness_.counts();
  report.step_time = step_time_.counts();
  return report;
}

}  // namespace heerk_rotor
