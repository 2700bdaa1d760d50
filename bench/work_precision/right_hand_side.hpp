#pragma once
#include <memory>

#include "problem.hpp"

namespace heerk_rotor::work_precision {

/// f(t, x) of a problem as libraries want it: an ordinary differential equation with the algebraic part solved inside, by the code that our own
/// methods use. Functions return false where the algebraic part has no solution or x is not finite.
class RightHandSide {
 public:
  RightHandSide(const Problem& problem, const Problem::Overrides& overrides = {});

  bool complete(double t, const double* x, double* f) noexcept { return evaluate(t, x, true, f); }
  bool remainder(double t, const double* x, double* f) noexcept { return evaluate(t, x, false, f); }  // f - S x

  /// Forgets what earlier solutions left in the algebraic solver, so that every run is the same.
  void restart() noexcept;

  Index size() const { return start_.size(); }
  const Vector& start() const { return start_; }
  CoupledSystem& system() { return system_; }
  long evaluations = 0;

 private:
  bool evaluate(double t, const double* x, bool complete, double* f) noexcept;

  CoupledSystem system_;
  Vector start_, command_, x_;
  std::unique_ptr<AlgebraicSolver> solver_;
  std::vector<double> cache_;
};

}  // namespace heerk_rotor::work_precision
