#pragma once
#include "heerk_rotor/solve/evaluation_plan.hpp"
#include "problem.hpp"

namespace heerk_rotor::work_precision {

/// The coupled system as an index-1 DAE for a library that solves such systems: f(t, x, y) and g(t, x, y) - y, where y are those output entries
/// that our own solver would iterate (the unknowns of the pruned loops); every other output is evaluated on the way, in order.
class LoopResidual {
 public:
  LoopResidual(const Problem& problem, const Problem::Overrides& overrides = {});

  Index states() const { return start_.size(); }
  Index unknowns() const { return static_cast<Index>(nominal_.size()); }
  const Vector& start() const { return start_; }
  const Vector& startUnknowns() const { return start_unknowns_; }  // consistent with start()
  const Vector& nominal() const { return nominal_; }               // magnitude of each unknown
  CoupledSystem& system() { return system_; }

  /// f (states), gap = g - y (unknowns). False: not finite, or time is up.
  bool evaluate(double t, const double* x, const double* unknowns, double* f, double* gap) noexcept;
  long evaluations = 0;

 private:
  void evaluatePort(Index port, double t) noexcept;
  void evaluateInOrder(const LoopPlan& plan, const std::vector<Index>& ports, double t) noexcept;
  void gather(const std::vector<Index>& inputs) noexcept;

  CoupledSystem system_;
  Vector start_, command_;
  EvaluationPlan plan_;
  Vector x_, y_, u_, g_;
  std::vector<char> is_unknown_;  // (outputs)
  Vector nominal_, start_unknowns_;
};

}  // namespace heerk_rotor::work_precision
