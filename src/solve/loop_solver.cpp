#include "loop_solver.hpp"

#include <algorithm>
#include <cmath>

namespace heerk_rotor {
namespace {

constexpr double kLostContraction = 0.3;   // ratio of two corrections above which the Jacobian is refreshed
constexpr double kDifference = 1.5e-8;     // relative step of forward differences, sqrt of the machine precision
constexpr double kRoundOff = 64 * 2.2e-16; // a residual below this share of the value cannot be lowered any more

}  // namespace

LoopSolver::LoopSolver(PortValues& values, const SolverOptions& options, SolverCounters& counters, const LoopPlan& pruned, const LoopPlan& full)
    : values_(values), options_(options), counters_(counters), pruned_(pruned), full_(full), use_full_(!options.prune), is_unknown_(static_cast<std::size_t>(values.y.size()), 0) {
  Index largest = 0;
  for (Loop* loop : {&pruned_, &full_})
    for (const Index port : loop->plan.outputs) {
      const CoupledSystem::Output& output = values_.system.outputs()[port];
      largest = std::max(largest, output.size * values_.system.subsystems()[output.subsystem].u_size);
      for (std::size_t k = 0; k < loop->nominal.size(); ++k)
        if (loop->plan.unknowns[k] >= output.begin && loop->plan.unknowns[k] < output.begin + output.size) loop->inverse_nominal[k] = 1.0 / (loop->nominal[k] = output.nominal);
    }
  for (Loop* loop : {&pruned_, &full_}) loop->jacobian.setZero(largest);
  markUnknowns();
}

/// y of a port from g, sparing the entries that are being iterated.
void LoopSolver::adopt(Index port) noexcept {
  const CoupledSystem::Output& output = values_.system.outputs()[port];
  for (Index e = output.begin; e < output.begin + output.size; ++e)
    if (!is_unknown_[e]) values_.y[e] = values_.g[e];
}

/// Residual g - y of the unknowns into loop.step, all else that the loop reads being known.
void LoopSolver::residual(Loop& loop, double t, const Vector& x, const Vector& w) noexcept {
  ++counters_.residual_evaluations;
  for (const Index input : loop.plan.core_inputs) values_.gather(input, w);
  for (const Index port : loop.plan.core) values_.evaluate(port, t, x);
  for (std::size_t k = 0; k < loop.plan.unknowns.size(); ++k) {
    const Index e = loop.plan.unknowns[k];
    loop.step[k] = values_.g[e] - values_.y[e];
  }
}

bool LoopSolver::residualIsRoundOff(const Loop& loop) const noexcept {
  for (std::size_t k = 0; k < loop.plan.unknowns.size(); ++k) {
    const Index e = loop.plan.unknowns[k];
    if (!(std::abs(values_.g[e] - values_.y[e]) <= kRoundOff * std::max(loop.nominal[k], std::abs(values_.y[e])))) return false;
  }
  return true;
}

/// matrix = I - dg/dy at the present y: forward differences colour by colour, then the rows models know themselves.
bool LoopSolver::refresh(Loop& loop, double t, const Vector& x, const Vector& w) noexcept {
  ++counters_.jacobians;
  const LoopPlan& p = loop.plan;
  const auto n = p.unknowns.size();
  residual(loop, t, x, w);
  for (std::size_t k = 0; k < n; ++k) {
    loop.reference[k] = values_.g[p.unknowns[k]];
    loop.kept[k] = values_.y[p.unknowns[k]];
  }
  for (Index colour = 0; colour < p.colours; ++colour) {
    for (std::size_t j = 0; j < n; ++j) {
      if (p.colour[j] != colour) continue;
      const Index e = p.unknowns[j];
      values_.y[e] = loop.kept[j] + kDifference * std::max(std::abs(loop.kept[j]), loop.nominal[j]);
    }
    residual(loop, t, x, w);
    for (std::size_t j = 0; j < n; ++j) {
      if (p.colour[j] != colour) continue;
      const double width = values_.y[p.unknowns[j]] - loop.kept[j];
      for (Index q = p.gradient.start[j]; q < p.gradient.start[j + 1]; ++q) {
        const Index i = p.gradient.rows[q];
        const double slope = (values_.g[p.unknowns[i]] - loop.reference[i]) / width;
        loop.matrix[q] = (i == static_cast<Index>(j) ? 1.0 : 0.0) - slope * loop.nominal[j] / loop.nominal[i];
      }
      values_.y[p.unknowns[j]] = loop.kept[j];
    }
  }
  residual(loop, t, x, w);  // u and g belong to y again
  applyModelJacobians(loop, t, x);
  ++counters_.factorizations;
  loop.factorized = loop.lu.factorize(loop.matrix);
  return loop.factorized;
}

/// Replaces differenced rows by exact ones where a model knows d(port)/d(u): an unknown y_j reaches the inputs it feeds.
void LoopSolver::applyModelJacobians(Loop& loop, double t, const Vector& x) noexcept {
  const LoopPlan& p = loop.plan;
  for (const Index port : p.core) {
    const CoupledSystem::Output& output = values_.system.outputs()[port];
    const CoupledSystem::Subsystem& owner = values_.system.subsystems()[output.subsystem];
    if (values_.in_stage && owner.narrow) continue;  // knows itself in x only
    Eigen::Map<Matrix> jacobian(loop.jacobian.data(), output.size, owner.u_size);
    jacobian.setZero();
    if (!owner.model->outputJacobian(output.port, t, In(x.data() + (values_.in_stage ? owner.z_begin : owner.x_begin), owner.x_size), In(values_.u.data() + owner.u_begin, owner.u_size), jacobian)) continue;
    for (std::size_t j = 0; j < p.unknowns.size(); ++j) {
      for (Index q = p.gradient.start[j]; q < p.gradient.start[j + 1]; ++q) {
        const Index i = p.gradient.rows[q], row = p.unknowns[i] - output.begin;
        if (row < 0 || row >= output.size) continue;
        double slope = 0.0;
        for (const Index number : output.feedthrough) {
          const CoupledSystem::Input& input = values_.system.inputs()[number];
          for (const Index source : input.sources) {
            const Index offset = p.unknowns[j] - values_.system.outputs()[source].begin;
            if (offset >= 0 && offset < input.size) slope += jacobian(row, input.begin - owner.u_begin + offset);
          }
        }
        loop.matrix[q] = (i == static_cast<Index>(j) ? 1.0 : 0.0) - slope * loop.nominal[j] / loop.nominal[i];
      }
    }
  }
}

/// loop.step (a residual) becomes the Newton correction. Its maximum over max(nominal, |y|), infinite when not finite,
/// estimates the error of the unknowns; `worst` is the entry that has it.
double LoopSolver::correction(Loop& loop, Index& worst) noexcept {
  const std::size_t n = loop.step.size();
  for (std::size_t k = 0; k < n; ++k) loop.step[k] *= loop.inverse_nominal[k];
  loop.lu.solve(loop.step.data());
  loop.broyden.improve(loop.step.data());
  double norm = -1.0;
  for (std::size_t k = 0; k < n; ++k) {
    const Index e = loop.plan.unknowns[k];
    double scaled = std::abs(loop.step[k]);
    if (const double size = std::abs(values_.y[e]) * loop.inverse_nominal[k]; size > 1.0) scaled /= size;
    if (!std::isfinite(scaled)) scaled = HUGE_VAL;
    if (scaled > norm) {
      norm = scaled;
      worst = e;
    }
    loop.step[k] *= loop.nominal[k];
  }
  return norm;
}

/// Simplified Newton; the LU is kept as long as the corrections shrink. The tolerance is on the correction, not on the
/// residual: a loop like that of the mast hides an error 700 times larger than its residual.
SolveReport LoopSolver::iterate(Loop& loop, double t, const Vector& x, const Vector& w) noexcept {
  SolveReport report;
  double previous = HUGE_VAL;
  bool fresh = false;
  loop.broyden.clear();
  for (;; ++report.iterations) {
    residual(loop, t, x, w);
    if (!loop.factorized && !refresh(loop, t, x, w)) break;
    report.error = correction(loop, report.entry);
    if (report.error <= options_.tolerance) return report;
    if (!(report.error <= kLostContraction * previous)) {
      if (residualIsRoundOff(loop)) return report;  // corrections only stir round-off
      if (report.iterations > 0 && !fresh) {
        if (!refresh(loop, t, x, w)) break;
        loop.broyden.clear();
        report.error = correction(loop, report.entry);
        fresh = true;
      } else {
        fresh = false;
      }
    }
    if (report.iterations >= options_.max_iterations || !std::isfinite(report.error)) break;
    previous = report.error;
    loop.broyden.remember(loop.step.data(), loop.inverse_nominal.data());
    for (std::size_t k = 0; k < loop.plan.unknowns.size(); ++k) values_.y[loop.plan.unknowns[k]] += loop.step[k];
    ++counters_.newton_iterations;
  }
  if (report.entry < 0) report.entry = loop.plan.unknowns.front();
  const bool finite = std::isfinite(report.error) && std::all_of(loop.matrix.begin(), loop.matrix.end(), [](double v) { return std::isfinite(v); });
  report.status = !finite ? SolveStatus::kNonFinite : loop.factorized ? SolveStatus::kStalled : SolveStatus::kSingular;
  return report;
}

/// After everything is known: does each port of the component still agree with what was used?
bool LoopSolver::consistent(const Loop& loop, double t, const Vector& x, const Vector& w, Index& worst) noexcept {
  // Entries outside the iteration follow the residual's accuracy; a dependency that was overlooked shows far above it.
  const double tolerance = 100.0 * std::max(options_.tolerance, kRoundOff);
  for (const Index input : loop.plan.inner_inputs) values_.gather(input, w);
  for (const Index port : loop.plan.outputs) {
    values_.evaluate(port, t, x);
    const CoupledSystem::Output& output = values_.system.outputs()[port];
    for (Index e = output.begin; e < output.begin + output.size; ++e)
      if (!(std::abs(values_.g[e] - values_.y[e]) <= tolerance * std::max(output.nominal, std::abs(values_.y[e])))) {
        worst = e;
        return false;
      }
  }
  return true;
}

void LoopSolver::evaluateInOrder(const LoopPlan& p, const std::vector<Index>& ports, double t, const Vector& x, const Vector& w) noexcept {
  for (const Index port : ports) {
    for (const Index input : p.inner_inputs) values_.gather(input, w);
    values_.evaluate(port, t, x);
    adopt(port);
  }
}

void LoopSolver::markUnknowns() noexcept {
  for (const Index e : full_.plan.unknowns) is_unknown_[e] = 0;
  for (const Index e : current().plan.unknowns) is_unknown_[e] = 1;
}

SolveReport LoopSolver::solve(double t, const Vector& x, const Vector& w) noexcept {
  Loop& loop = current();
  evaluateInOrder(loop.plan, loop.plan.before, t, x, w);
  SolveReport report;
  if (!loop.plan.unknowns.empty()) report = iterate(loop, t, x, w);
  for (const Index port : loop.plan.core) adopt(port);
  evaluateInOrder(loop.plan, loop.plan.after, t, x, w);
  const bool good = report.status == SolveStatus::kConverged && consistent(loop, t, x, w, report.entry);
  if (good || use_full_) return report;

  // Either a pruned zero became nonzero, or the pruned pattern hides what convergence needs: solve the whole loop.
  if (report.status == SolveStatus::kConverged) ++counters_.pruning_failures;
  use_full_ = true;
  markUnknowns();
  return solve(t, x, w);
}

LoopInfo LoopSolver::info() const {
  const Loop& loop = current();
  return {loop.plan.outputs, static_cast<Index>(full_.plan.unknowns.size()), loop.plan.unknowns, loop.plan.gradient.nonzeros(), loop.lu.factorNonzeros(), loop.plan.gradient,
          loop.plan.unknowns.empty() ? SparsityPattern() : loop.lu.factorPattern()};
}

void LoopSolver::appendTo(std::vector<double>& cache) const {
  cache.push_back(use_full_);
  for (const Loop* loop : {&pruned_, &full_}) {
    cache.push_back(loop->factorized);
    cache.insert(cache.end(), loop->matrix.begin(), loop->matrix.end());
  }
}

void LoopSolver::restore(std::vector<double>::const_iterator& value) {
  use_full_ = *value++ != 0.0;
  for (Loop* loop : {&pruned_, &full_}) {
    const bool factorized = *value++ != 0.0;
    std::copy_n(value, loop->matrix.size(), loop->matrix.begin());
    value += static_cast<std::ptrdiff_t>(loop->matrix.size());
    loop->factorized = factorized && loop->lu.factorize(loop->matrix);
  }
  markUnknowns();
}

}  // namespace heerk_rotor
