#include "heerk_rotor/solve/sparse_lu.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace heerk_rotor {
namespace {

constexpr double kDiagonalPreference = 0.1;  // keep the diagonal as pivot while it has this share of the largest entry
constexpr double kSingularRatio = 1e-13;     // smallest over largest pivot below which the matrix counts as singular

std::vector<Index> fillReducingOrder(const SparsityPattern& pattern) {
  Eigen::SparseMatrix<double> matrix(pattern.size, pattern.size);
  for (Index j = 0; j < pattern.size; ++j) {
    for (Index p = pattern.start[j]; p < pattern.start[j + 1]; ++p) matrix.insert(pattern.rows[p], j) = 1.0;
  }
  matrix.makeCompressed();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::COLAMDOrdering<int>()(matrix, permutation);
  std::vector<Index> order(static_cast<std::size_t>(pattern.size));
  for (Index j = 0; j < pattern.size; ++j) order[permutation.indices()[j]] = j;
  return order;
}

}  // namespace

SparseLu::SparseLu(const SparsityPattern& pattern) : pattern_(pattern) {
  const auto n = static_cast<std::size_t>(pattern.size), half = n * (n + 1) / 2;
  column_order_ = fillReducingOrder(pattern);
  pivot_row_.resize(n);
  pivoted_.resize(n);
  l_start_.resize(n + 1);
  u_start_.resize(n + 1);
  l_rows_.resize(half);
  l_values_.resize(half);
  u_steps_.resize(half);
  u_values_.resize(half);
  pivots_.resize(n);
  work_.assign(n, 0.0);
}

bool SparseLu::factorize(const std::vector<double>& values) noexcept {
  const Index n = pattern_.size;
  std::fill(pivoted_.begin(), pivoted_.end(), char{0});
  l_used_ = u_used_ = 0;
  double largest_pivot = 0.0, smallest_pivot = HUGE_VAL;

  for (Index k = 0; k < n; ++k) {
    l_start_[k] = l_used_;
    u_start_[k] = u_used_;
    const Index column = column_order_[k];
    for (Index p = pattern_.start[column]; p < pattern_.start[column + 1]; ++p) work_[pattern_.rows[p]] = values[p];

    // Eliminate with the finished columns in their order: work becomes the column of U and, below, of L times the pivot.
    for (Index j = 0; j < k; ++j) {
      const double factor = work_[pivot_row_[j]];
      if (factor == 0.0) continue;
      u_steps_[u_used_] = j;
      u_values_[u_used_++] = factor;
      for (Index p = l_start_[j]; p < l_start_[j + 1]; ++p) work_[l_rows_[p]] -= l_values_[p] * factor;
      work_[pivot_row_[j]] = 0.0;
    }

    // Largest remaining entry, but the diagonal as long as it is good enough: that keeps fill low.
    Index row = -1;
    double largest = 0.0;
    for (Index i = 0; i < n; ++i) {
      if (!pivoted_[i] && std::abs(work_[i]) > largest) {
        largest = std::abs(work_[i]);
        row = i;
      }
    }
    if (row < 0 || !std::isfinite(largest)) {
      std::fill(work_.begin(), work_.end(), 0.0);
      return false;
    }
    if (!pivoted_[column] && std::abs(work_[column]) >= kDiagonalPreference * largest) row = column;
    const double pivot = work_[row];
    pivot_row_[k] = row;
    pivoted_[row] = 1;
    pivots_[k] = pivot;
    largest_pivot = std::max(largest_pivot, std::abs(pivot));
    smallest_pivot = std::min(smallest_pivot, std::abs(pivot));

    work_[row] = 0.0;
    for (Index i = 0; i < n; ++i) {
      if (work_[i] == 0.0) continue;
      l_rows_[l_used_] = i;
      l_values_[l_used_++] = work_[i] / pivot;
      work_[i] = 0.0;
    }
    l_start_[k + 1] = l_used_;
    u_start_[k + 1] = u_used_;
  }
  return smallest_pivot > kSingularRatio * largest_pivot;
}

SparsityPattern SparseLu::factorPattern() const {
  const auto n = static_cast<std::size_t>(pattern_.size);
  std::vector<Index> step_of_row(n);
  for (std::size_t k = 0; k < n; ++k) step_of_row[static_cast<std::size_t>(pivot_row_[k])] = static_cast<Index>(k);
  SparsityPattern result;
  result.size = pattern_.size;
  result.start.push_back(0);
  for (std::size_t k = 0; k < n; ++k) {
    for (Index p = u_start_[k]; p < u_start_[k + 1]; ++p) result.rows.push_back(u_steps_[static_cast<std::size_t>(p)]);
    result.rows.push_back(static_cast<Index>(k));
    for (Index p = l_start_[k]; p < l_start_[k + 1]; ++p) result.rows.push_back(step_of_row[static_cast<std::size_t>(l_rows_[static_cast<std::size_t>(p)])]);
    std::sort(result.rows.begin() + result.start.back(), result.rows.end());
    result.start.push_back(result.nonzeros());
  }
  return result;
}

void SparseLu::solve(double* b) noexcept {
  const Index n = pattern_.size;
  // Forward: work_[k] = component of L^{-1} P b at step k; b is indexed by rows until then.
  for (Index k = 0; k < n; ++k) {
    const double value = b[pivot_row_[k]];
    work_[k] = value;
    if (value != 0.0) {
      for (Index p = l_start_[k]; p < l_start_[k + 1]; ++p) b[l_rows_[p]] -= l_values_[p] * value;
    }
  }
  // Backward, column by column of U.
  for (Index k = n - 1; k >= 0; --k) {
    const double value = work_[k] / pivots_[k];
    work_[k] = value;
    for (Index p = u_start_[k]; p < u_start_[k + 1]; ++p) work_[u_steps_[p]] -= u_values_[p] * value;
  }
  for (Index k = 0; k < n; ++k) {
    b[column_order_[k]] = work_[k];
    work_[k] = 0.0;
  }
}

}  // namespace heerk_rotor
