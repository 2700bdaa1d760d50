#pragma once
#include <vector>

#include "heerk_rotor/core/types.hpp"

namespace heerk_rotor {

/// Broyden's update of an inverse Jacobian that outlives a solve: H = I + sum a_k b_k', each pair made from a step s and the change y of the
/// residual along it, a = (s - H y) / (s' H y), b' = s' H (Broyden 1965; Kelley, Iterative Methods for Linear and Nonlinear Equations, SIAM 1995,
/// chapter 7). What changes slowly from solve to solve - a nonlinearity of low rank as an oil film on a shaft, a loop of inertia that turns with the
/// rotor - is learned in as many pairs. Pairs build on each other, so that none can go alone: a full memory begins anew. Memory is taken at construction.
class SecantMemory {
 public:
  explicit SecantMemory(Index unknowns);

  void clear() noexcept { count_ = 0; }

  /// residual -> H residual, in place.
  void improve(double* residual) const noexcept;

  /// Learns from the step `s` = H r that was applied and `left` = H r_new of the residual r_new after it (y = r - r_new, so that s - H y = left), and
  /// turns `left` into what the new H makes of r_new. A full memory is cleared instead.
  void learn(const double* s, const double* r_new, double* left) noexcept;

  /// All numbers it holds, for a checkpoint.
  std::vector<double> values() const;
  /// Throws std::invalid_argument when their number is wrong.
  void restore(const std::vector<double>& values);

 private:
  static constexpr Index kPairs = 4;
  double* a(Index k) noexcept { return a_.data() + k * size_; }
  double* b(Index k) noexcept { return b_.data() + k * size_; }
  const double* a(Index k) const noexcept { return a_.data() + k * size_; }
  const double* b(Index k) const noexcept { return b_.data() + k * size_; }

  Index size_;
  Vector a_, b_;                     // [pair][unknown]
  Index count_ = 0;
};

}  // namespace heerk_rotor
