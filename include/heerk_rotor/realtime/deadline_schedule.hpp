#pragma once
#include <cstdint>

namespace heerk_rotor {

/// When the batches of steps of a paced run begin and must be done, as pure arithmetic on nanoseconds of a monotonic clock:
///   release_k = start + k * period,  deadline_k = release_{k+1}.
/// Each is computed from k, never accumulated: rounding leaves at most 1 ns at any time. Who lags behind catches up by not
/// sleeping, without leaving out a step; when the lag exceeds a limit the start is shifted instead (a slip).
class DeadlineSchedule {
 public:
  static constexpr std::int64_t kMaxLag = 50000000;  // [ns] beyond it catching up would look like a jump forward

  /// period > 0 [ns]; not an integer in general.
  explicit DeadlineSchedule(double period, std::int64_t max_lag = kMaxLag) : period_(period), max_lag_(max_lag) {}

  /// The next batch is released now; the following ones count from here.
  void restart(std::int64_t now) noexcept {
    start_ = now;
    batch_ = 0;
  }

  /// If the next batch is overdue by more than the limit: shifts the start so that it is released now.
  /// Returns by how much, or 0 [ns].
  std::int64_t slip(std::int64_t now) noexcept {
    const std::int64_t lag = now - release();
    if (lag <= max_lag_) return 0;
    start_ += lag;
    return lag;
  }

  void advance() noexcept { ++batch_; }

  std::int64_t release() const noexcept { return at(batch_); }
  std::int64_t deadline() const noexcept { return at(batch_ + 1); }
  double period() const noexcept { return period_; }

 private:
  /// Exact to 1 ns for 104 days without restart (2^53 ns).
  std::int64_t at(std::uint64_t batch) const noexcept { return start_ + static_cast<std::int64_t>(static_cast<double>(batch) * period_ + 0.5); }

  double period_;          // [ns]
  std::int64_t max_lag_;   // [ns]
  std::int64_t start_ = 0; // [ns]
  std::uint64_t batch_ = 0;
};

}  // namespace heerk_rotor
