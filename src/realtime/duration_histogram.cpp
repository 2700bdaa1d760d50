#include "heerk_rotor/realtime/duration_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace heerk_rotor {

int DurationHistogram::bin(std::int64_t nanoseconds) noexcept {
  if (nanoseconds < 8) return static_cast<int>(std::max<std::int64_t>(nanoseconds, 0));
  // The highest bit gives the octave, the three bits below it one of its eight bins.
  const int octave = 63 - __builtin_clzll(static_cast<unsigned long long>(nanoseconds));
  const int eighth = static_cast<int>(nanoseconds >> (octave - 3)) & 7;
  return std::min(8 * (octave - 2) + eighth, kBins - 1);
}

std::int64_t DurationHistogram::upperEdge(int bin) noexcept {
  if (bin < 8) return bin;
  const int octave = bin / 8 + 2;
  return (static_cast<std::int64_t>(8 + bin % 8 + 1) << (octave - 3)) - 1;
}

void DurationHistogram::add(std::int64_t nanoseconds) noexcept {
  std::atomic<std::uint64_t>& count = bins_[static_cast<std::size_t>(bin(nanoseconds))];
  count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);  // one writer: no need to lock the bus
  if (nanoseconds > maximum_.load(std::memory_order_relaxed)) maximum_.store(nanoseconds, std::memory_order_relaxed);
}

DurationHistogram::Counts DurationHistogram::counts() const noexcept {
  Counts counts;
  for (std::size_t i = 0; i < bins_.size(); ++i) counts.bins[i] = bins_[i].load(std::memory_order_relaxed);
  counts.maximum = maximum_.load(std::memory_order_relaxed);
  return counts;
}

std::uint64_t DurationHistogram::Counts::total() const {
  std::uint64_t sum = 0;
  for (const std::uint64_t count : bins) sum += count;
  return sum;
}

std::int64_t DurationHistogram::Counts::percentile(double q) const {
  const std::uint64_t all = total();
  if (all == 0) return 0;
  const auto wanted = static_cast<std::uint64_t>(std::ceil(std::min(std::max(q, 0.0), 1.0) * static_cast<double>(all)));
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    sum += bins[i];
    if (sum > 0 && sum >= wanted) return std::min(upperEdge(static_cast<int>(i)), maximum);
  }
  return maximum;
}

DurationHistogram::Counts DurationHistogram::Counts::since(const Counts& earlier) const {
  Counts difference;
  for (std::size_t i = 0; i < bins.size(); ++i) difference.bins[i] = bins[i] - earlier.bins[i];
  difference.maximum = maximum;
  return difference;
}

}  // namespace heerk_rotor
