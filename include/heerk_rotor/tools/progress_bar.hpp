#pragma once
#include <chrono>
#include <cstdint>
#include <cstdio>

namespace heerk_rotor {

/// One line on a terminal that shows how far a run is, redrawn about ten times per second.
class ProgressBar {
 public:
  /// Writes to `stream` only if it is a terminal and `enabled` is set.
  ProgressBar(std::uint64_t steps, double step_size, bool enabled, std::FILE* stream = stderr);
  ~ProgressBar() { finish(); }

  /// After `done` steps. Costs a comparison unless the line is due.
  void update(std::uint64_t done) noexcept {
    if (done >= next_) redraw(done);
  }

  /// Removes the line, so that what follows starts on a clean one.
  void finish() noexcept;

 private:
  void redraw(std::uint64_t done) noexcept;

  std::FILE* stream_;  // nullptr: silent
  std::uint64_t steps_;
  double step_size_;   // [s]
  std::uint64_t next_; // number of steps at which to look at the clock again
  std::chrono::steady_clock::time_point start_;
  bool drawn_ = false;
};

}  // namespace heerk_rotor
