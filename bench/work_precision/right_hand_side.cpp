#include "right_hand_side.hpp"

#include <cmath>

#include "integration.hpp"

namespace heerk_rotor::work_precision {

RightHandSide::RightHandSide(const Problem& problem, const Problem::Overrides& overrides)
    : system_(problem.build(overrides)), start_(problem.startOf(system_)), command_(problem.commandOf(system_)), x_(start_) {
  SolverOptions options;
  options.tolerance = problem.newton_tolerance;
  solver_ = std::make_unique<AlgebraicSolver>(system_, options, 0.0, start_, command_);
  cache_ = solver_->cache();
}

void RightHandSide::restart() noexcept {
  solver_->restoreCache(cache_);
  evaluations = 0;
}

bool RightHandSide::evaluate(double t, const double* x, bool complete, double* f) noexcept {
  if ((++evaluations & 0xff) == 0 && cpuSeconds() > cpu_deadline) return false;
  x_ = In(x, x_.size());
  return std::isfinite(x_.sum()) && solver_->evalRemainderWithin(t, x_, command_, complete, f).status == SolveStatus::kConverged;
}

}  // namespace heerk_rotor::work_precision
