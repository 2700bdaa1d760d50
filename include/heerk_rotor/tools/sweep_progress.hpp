#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>

namespace heerk_rotor {

/// How far a sweep is: on a terminal one line with a bar, redrawn when update() is called; elsewhere one line per 10 % of the runs.
class SweepProgress {
 public:
  static constexpr std::uint64_t kPartsOfRun = 100;

  /// Writes nothing unless `enabled`.
  SweepProgress(std::uint64_t runs, bool enabled, std::FILE* stream = stderr);
  ~SweepProgress() { finish(); }

  /// A worker has finished that many of the kPartsOfRun parts of a run.
  void addParts(std::uint64_t parts) noexcept { parts_.fetch_add(parts, std::memory_order_relaxed); }

  /// `done` runs are finished. For one thread only.
  void update(std::uint64_t done) noexcept;

  /// Removes the bar.
  void finish() noexcept;

 private:
  std::FILE* stream_;  // nullptr: silent
  bool terminal_;
  std::uint64_t runs_;
  std::uint64_t tenths_ = 0;  // reported so far
  std::chrono::steady_clock::time_point start_;
  bool drawn_ = false;
  alignas(64) std::atomic<std::uint64_t> parts_{0};  // on a cache line of its own: the workers write it
};

}  // namespace heerk_rotor
