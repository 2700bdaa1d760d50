#pragma once
#include <atomic>
#include <cstdint>

#include "heerk_rotor/realtime/duration_histogram.hpp"

namespace heerk_rotor {

/// What a paced run has achieved so far. An overrun is a step that was finished after its deadline; its cause is
///  - long step: the computation itself took longer than its period;
///  - late wake-up: the computation fitted, but began too late because the operating system woke the thread late.
/// Steps that are still late because of an earlier overrun carry the cause of that one.
struct TimingReport {
  std::uint64_t steps = 0;               // since the start
  std::uint64_t overruns = 0;            // = late_wake_ups + long_steps
  std::uint64_t late_wake_ups = 0;
  std::uint64_t long_steps = 0;
  std::uint64_t slips = 0;               // lag beyond the limit: the schedule was shifted
  std::int64_t slipped = 0;              // by that much altogether [ns]
  DurationHistogram::Counts lateness;    // begin of a batch after its release [ns]
  DurationHistogram::Counts step_time;   // computation of a batch [ns]
};

/// Collects a TimingReport: the step thread records, any thread reads; neither waits.
class StepTiming {
 public:
  /// A batch of `steps` steps, released at `release`, computed from `begin` to `finish`, due at `deadline` [ns].
  void record(std::uint64_t steps, std::int64_t release, std::int64_t begin, std::int64_t finish, std::int64_t deadline) noexcept;

  /// A batch of a run without pace, which cannot be late.
  void recordUnpaced(std::uint64_t steps, std::int64_t begin, std::int64_t finish) noexcept;

  void recordSlip(std::int64_t nanoseconds) noexcept;

  /// The schedule begins anew (pause, slip): what follows is not late because of what was before.
  void forgetBacklog() noexcept { backlog_ = Cause::kNone; }

  TimingReport report() const noexcept;
  std::uint64_t overruns() const noexcept;

 private:
  enum class Cause { kNone, kLateWakeUp, kLongStep };
  using Counter = std::atomic<std::uint64_t>;
  static void increase(Counter& counter, std::uint64_t by) noexcept {
    counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);  // one writer
  }

  Counter steps_{0}, late_wake_ups_{0}, long_steps_{0}, slips_{0}, slipped_{0};
  DurationHistogram lateness_, step_time_;
  Cause backlog_ = Cause::kNone;  // why the previous batch was late
};

}  // namespace heerk_rotor
