#pragma once
#include <vector>

#include "heerk_rotor/core/types.hpp"

namespace heerk_rotor {

/// Broyden's update of an inverse Jacobian that outlives a solve: H = I + sum a_k b_k', each pair made from a step s and the change y of the
/// residual along it, a = (s - H y) / (s' H y), b' = s' H (Broyden 1965; Kelley, Iterative Methods for Linear and Nonlinear Equations, SIAM 1995,
/// chapter 7). A nonlinearity of low rank, as an oil film on a shaft, is learned in as many pairs. When the memory is full the oldest pair goes.
class SecantMemory {
 public:
  explicit SecantMemory(Index unknowns) : a_(Matrix::Zero(unknowns, kPairs)), b_(Matrix::Zero(unknowns, kPairs)) {}

  void clear() noexcept { count_ = next_ = 0; }

  /// residual -> H residual, in place.
  void improve(Vector& residual) const noexcept;

  /// Learns from the step `s` = H r that was applied and `left` = H r_new of the residual r_new after it: y = r - r_new, so that s - H y = left.
  void learn(const Vector& s, const Vector& left) noexcept;

  /// All numbers it holds, for a checkpoint.
  std::vector<double> values() const;
  /// Throws std::invalid_argument when their number is wrong.
  void restore(const std::vector<double>& values);

 private:
  static constexpr Index kPairs = 4;
  Matrix a_, b_;  // (unknowns x kPairs)
  Index count_ = 0, next_ = 0;
};

}  // namespace heerk_rotor
