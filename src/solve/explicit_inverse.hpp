#pragma once
#include <algorithm>
#include <vector>

#include "heerk_rotor/core/types.hpp"
#include "heerk_rotor/solve/sparse_lu.hpp"

namespace heerk_rotor {

/// The inverse of a small matrix, tabulated whenever it is factorised: for the few unknowns of most loops a product in registers takes a fraction of
/// the time that following the indices of sparse factors takes (and less than a matrix product of run-time size), and simplified Newton forgives its rounding.
class ExplicitInverse {
 public:
  static constexpr Index kLargest = 32;

  explicit ExplicitInverse(Index size) : size_(size), pitch_((size + kLanes - 1) / kLanes * kLanes), columns_(Vector::Zero(size <= kLargest ? size * pitch_ : 0)) {}

  bool applies() const noexcept { return size_ <= kLargest; }

  void take(SparseLu& lu) noexcept {
    for (Index j = 0; j < size_; ++j) {
      double* const column = columns_.data() + j * pitch_;
      std::fill_n(column, pitch_, 0.0);
      column[j] = 1.0;
      lu.solve(column);
    }
  }

  /// b <- inverse b.
  void apply(double* b) const noexcept {
    alignas(64) double result[kLargest];
    for (Index row = 0; row < pitch_; row += 2 * kLanes) row + kLanes < pitch_ ? rows<2 * kLanes>(row, b, result) : rows<kLanes>(row, b, result);
    using Lanes = Eigen::Array<double, kLanes, 1>;
    Index i = 0;
    for (; i + kLanes <= size_; i += kLanes) Eigen::Map<Lanes>(b + i) = Eigen::Map<const Lanes>(result + i);
#pragma GCC unroll 1
    for (; i < size_; ++i) b[i] = result[i];
  }

 private:
  static constexpr Index kLanes = 4;

  /// Two sums, so that one need not wait for the other.
  template <int N>
  void rows(Index row, const double* b, double* result) const noexcept {
    using Lanes = Eigen::Array<double, N, 1>;
    using Load = Eigen::Map<const Lanes>;
    Lanes even = Lanes::Zero(), odd = Lanes::Zero();
    const double* column = columns_.data() + row;
    Index j = 0;
    for (; j + 2 <= size_; j += 2, column += 2 * pitch_) {
      even += Load(column) * b[j];
      odd += Load(column + pitch_) * b[j + 1];
    }
    if (j < size_) even += Load(column) * b[j];
    Eigen::Map<Lanes>{result + row} = even + odd;
  }

  Index size_, pitch_;
  Vector columns_;  // [column][pitch]
};

}  // namespace heerk_rotor
