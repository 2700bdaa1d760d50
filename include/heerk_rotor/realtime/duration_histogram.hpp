#pragma once
#include <array>
#include <atomic>
#include <cstdint>

namespace heerk_rotor {

/// Counts durations in fixed bins that grow with the duration: eight per octave, so that a percentile is within 12.5 %,
/// from 1 ns to 2^40 ns = 18 minutes. One thread adds, any thread may look; neither waits.
class DurationHistogram {
 public:
  static constexpr int kBins = 8 * 38 + 8;

  /// A copy of the bins that no longer changes.
  struct Counts {
    std::array<std::uint64_t, kBins> bins{};
    std::int64_t maximum = 0;  // since the start, exact [ns]

    std::uint64_t total() const;
    /// The duration that a fraction q of all does not exceed: upper edge of its bin, at most the maximum; 0 when empty [ns].
    std::int64_t percentile(double q) const;
    /// What came after `earlier`; the maximum stays the one since the start.
    Counts since(const Counts& earlier) const;
  };

  /// Writer side; negative durations count as 0.
  void add(std::int64_t nanoseconds) noexcept;

  Counts counts() const noexcept;

  static int bin(std::int64_t nanoseconds) noexcept;
  /// Largest duration that belongs to the bin [ns].
  static std::int64_t upperEdge(int bin) noexcept;

 private:
  std::array<std::atomic<std::uint64_t>, kBins> bins_{};
  std::atomic<std::int64_t> maximum_{0};
};

}  // namespace heerk_rotor
