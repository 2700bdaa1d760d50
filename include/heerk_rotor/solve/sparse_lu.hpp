#pragma once
#include <vector>

#include "heerk_rotor/core/types.hpp"

namespace heerk_rotor {

/// A square matrix's nonzeros by column: rows[start[j] .. start[j+1]) of column j, ascending.
struct SparsityPattern {
  Index size = 0;
  std::vector<Index> start;
  std::vector<Index> rows;
  Index nonzeros() const { return static_cast<Index>(rows.size()); }
};

/// Sparse LU with fill-reducing column order and threshold partial pivoting (left-looking, after Gilbert & Peierls).
/// All memory is taken at construction, so that factorising and solving may happen on the step path.
class SparseLu {
 public:
  explicit SparseLu(const SparsityPattern& pattern);

  /// Factorises the matrix with these values (in the order of pattern.rows). False: singular to working precision.
  bool factorize(const std::vector<double>& values) noexcept;

  /// b <- A^{-1} b.
  void solve(double* b) noexcept;

  /// Nonzeros of L (without unit diagonal) and U after the last factorisation.
  Index factorNonzeros() const { return l_used_ + u_used_; }

  /// Nonzeros of L + U after the last factorisation, rows and columns in the order of elimination.
  SparsityPattern factorPattern() const;

 private:
  SparsityPattern pattern_;
  std::vector<Index> column_order_;   // (n) column that is eliminated at step k
  std::vector<Index> pivot_row_;      // (n) row chosen at step k
  std::vector<char> pivoted_;         // (n) by row
  std::vector<Index> l_start_, u_start_, l_rows_, u_steps_;
  std::vector<double> l_values_, u_values_, pivots_, work_;
  Index l_used_ = 0, u_used_ = 0;
};

}  // namespace heerk_rotor
