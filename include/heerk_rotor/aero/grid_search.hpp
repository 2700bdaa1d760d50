#pragma once
#include <cstdint>
#include <vector>

#include "heerk_rotor/aero/lanes.hpp"

namespace heerk_rotor {

/// A set of intervals and the way to find in constant time the one that holds a value: uniform buckets tell where to begin, a
/// fixed number of comparisons (one on common grids) does the rest.
class GridSearch {
 public:
  template <int N>
  struct Places {
    std::int32_t cell[N];
    Lanes<N> fraction;  // 0 at the lower end of the cell, 1 at the upper
  };

  GridSearch() = default;
  /// grid: strictly increasing, at least two values.
  explicit GridSearch(const std::vector<double>& grid);
  /// Values outside the grid are moved to its ends.
  template <int N>
  Places<N> find(const Lanes<N>& x) const noexcept;
  double width(std::int32_t cell) const noexcept { return cells_[cell].width; }

 private:
  std::int32_t bucket(double x) const noexcept;

  struct Cell {
    double lower, upper, inverse_width, width;  // upper of the last cell is infinite
  };
  double front_ = 0.0, back_ = 1.0, bucket_scale_ = 0.0, last_bucket_ = 0.0;
  int comparisons_ = 0;
  std::vector<std::int32_t> first_cell_;  // (buckets)
  std::vector<Cell> cells_;
};

inline std::int32_t GridSearch::bucket(double x) const noexcept {
  double b = (x - front_) * bucket_scale_;
  b = b > 0.0 ? b : 0.0;  // NaN goes to bucket 0 as well; it stays in the fraction
  b = b < last_bucket_ ? b : last_bucket_;
  return static_cast<std::int32_t>(b);
}

// One loop per operation: those without memory access become vector instructions, the others overlap.
template <int N>
GridSearch::Places<N> GridSearch::find(const Lanes<N>& x) const noexcept {
  const double front = front_, back = back_;
  const std::int32_t* const first_cell = first_cell_.data();
  const Cell* const cells = cells_.data();
  Lanes<N> inside;
  Places<N> result;
  std::int32_t buckets[N];
  for (int k = 0; k < N; ++k) {
    double value = x[k];
    value = value < front ? front : value;
    value = value > back ? back : value;
    inside[k] = value;
    buckets[k] = bucket(value);
  }
  for (int k = 0; k < N; ++k) result.cell[k] = first_cell[buckets[k]];
  for (int c = 0; c < comparisons_; ++c)
    for (int k = 0; k < N; ++k) result.cell[k] += inside[k] >= cells[result.cell[k]].upper;
  for (int k = 0; k < N; ++k) {
    const Cell& cell = cells[result.cell[k]];
    result.fraction[k] = (inside[k] - cell.lower) * cell.inverse_width;
  }
  return result;
}

}  // namespace heerk_rotor
