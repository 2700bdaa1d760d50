#pragma once
#include <vector>

#include <Eigen/LU>

#include "heerk_rotor/core/coupled_system.hpp"

namespace heerk_rotor::work_precision {

/// S x and (I - gamma S)^-1 b for the block-diagonal S of a coupled system, each block by its structure: 2x2 pairs in closed form, second-order
/// systems by a factor of half the size. What a user would hand to a library who knows the structure. Shares no code with our own methods.
class StiffSolver {
 public:
  explicit StiffSolver(const CoupledSystem& system);

  Index size() const { return size_; }
  void multiply(const double* x, double* Sx) const noexcept;
  /// Factors anew only when gamma differs from last time.
  void setGamma(double gamma);
  void solve(const double* b, double* z) noexcept;

 private:
  using Array = Eigen::ArrayXd;
  /// Pairs (i, m + i) of a block that begins at `begin`: [[a, b], [c, d]] each, and their (I - gamma S)^-1.
  struct Pairs {
    Index begin;
    Array a, b, c, d, inverse_a, inverse_b, inverse_c, inverse_d;
  };
  struct SecondOrder {
    Index begin;
    Matrix K, C;
    Eigen::PartialPivLU<Matrix> lu;  // of I + gamma C + gamma^2 K
    Vector rate;
  };
  struct Dense {
    Index begin;
    Matrix S;
    Eigen::PartialPivLU<Matrix> lu;
  };
  void add(const StiffPart& part, Index begin);

  Index size_;
  double gamma_ = 0.0;
  std::vector<Pairs> pairs_;
  std::vector<SecondOrder> second_order_;
  std::vector<Dense> dense_;
};

}  // namespace heerk_rotor::work_precision
