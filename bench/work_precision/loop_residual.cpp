#include "loop_residual.hpp"

#include <cmath>

#include "integration.hpp"

namespace heerk_rotor::work_precision {

LoopResidual::LoopResidual(const Problem& problem, const Problem::Overrides& overrides)
    : system_(problem.build(overrides)), start_(problem.startOf(system_)), command_(problem.commandOf(system_)),
      plan_(planEvaluation(system_, 0.0, start_, command_)), x_(start_), y_(Vector::Zero(system_.outputSize())),
      u_(Vector::Zero(system_.inputSize())), g_(y_), is_unknown_(static_cast<std::size_t>(y_.size()), 0) {
  SolverOptions options;
  options.tolerance = 1e-13;
  AlgebraicSolver solver(system_, options, 0.0, start_, command_);
  solver.solve(0.0, start_, command_);
  std::vector<double> nominal, values;
  for (const LoopPlan& loop : plan_.pruned)
    for (const Index entry : loop.unknowns) {
      is_unknown_[static_cast<std::size_t>(entry)] = 1;
      values.push_back(solver.y()[entry]);
      for (const CoupledSystem::Output& output : system_.outputs())
        if (entry >= output.begin && entry < output.begin + output.size) nominal.push_back(output.nominal);
    }
  nominal_ = Eigen::Map<const Vector>(nominal.data(), static_cast<Index>(nominal.size()));
  start_unknowns_ = Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
  for (std::size_t i = 0; i < system_.inputs().size(); ++i) system_.gather(static_cast<Index>(i), y_, command_, u_);
}

void LoopResidual::gather(const std::vector<Index>& inputs) noexcept {
  for (const Index input : inputs) system_.gather(input, y_, command_, u_);
}

/// The entries that are unknowns keep their value in y; what the port says about them is in g.
void LoopResidual::evaluatePort(Index port, double t) noexcept {
  const CoupledSystem::Output& output = system_.outputs()[static_cast<std::size_t>(port)];
  system_.evalOutput(port, t, x_, u_, g_.data() + output.begin);
  for (Index e = output.begin; e < output.begin + output.size; ++e)
    if (!is_unknown_[static_cast<std::size_t>(e)]) y_[e] = g_[e];
}

void LoopResidual::evaluateInOrder(const LoopPlan& plan, const std::vector<Index>& ports, double t) noexcept {
  for (const Index port : ports) {
    gather(plan.inner_inputs);
    evaluatePort(port, t);
  }
}

bool LoopResidual::evaluate(double t, const double* x, const double* unknowns, double* f, double* gap) noexcept {
  if ((++evaluations & 0xff) == 0 && cpuSeconds() > cpu_deadline) return false;
  x_ = In(x, x_.size());
  if (!std::isfinite(x_.sum())) return false;
  Index k = 0;
  for (const LoopPlan& loop : plan_.pruned)
    for (const Index entry : loop.unknowns) y_[entry] = unknowns[k++];
  for (const EvaluationPlan::Item& item : plan_.stage) {
    gather(item.inputs);
    if (item.output >= 0) {
      evaluatePort(item.output, t);
      continue;
    }
    const LoopPlan& loop = plan_.pruned[static_cast<std::size_t>(item.loop)];
    evaluateInOrder(loop, loop.before, t);
    gather(loop.core_inputs);
    for (const Index port : loop.core) evaluatePort(port, t);
    evaluateInOrder(loop, loop.after, t);
  }
  gather(plan_.last_inputs);
  system_.evalRemainder(t, x_, u_, true, f);
  k = 0;
  for (const LoopPlan& loop : plan_.pruned)
    for (const Index entry : loop.unknowns) {
      gap[k] = g_[entry] - y_[entry];
      ++k;
    }
  return true;
}

}  // namespace heerk_rotor::work_precision
