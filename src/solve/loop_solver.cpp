#include "loop_solver.hpp"

#include <algorithm>
#include <cmath>

namespace heerk_rotor {
namespace {

constexpr double kLostContraction = 0.3;   // ratio of two corrections above which the Jacobian is refreshed
constexpr double kWorthLearning = 1e-9;    // correction; what smaller ones change is mostly rounding
constexpr double kDifference = 1.5e-8;     // relative step of forward differences, sqrt of the machine precision
constexpr double kRoundOff = 64 * 2.2e-16; // a residual below this share of the value cannot be lowered any more
constexpr double kSafety = 4.0;            // on the error that a correction is expected to leave
constexpr int kLongestTrust = 7;           // solves without a check

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
  for (Loop* loop : {&pruned_, &full_}) {
    loop->jacobian.setZero(largest);
    loop->core_groups = groupBySubsystem(values_.system, loop->plan.core);
  }
  markUnknowns();
}

/// y of a port from g, sparing the entries that are being iterated.
void LoopSolver::adopt(Index port) noexcept {
  const CoupledSystem::Output& output = values_.system.outputs()[port];
  for (Index e = output.begin; e < output.begin + output.size; ++e)
    if (!is_unknown_[e]) values_.y[e] = values_.g[e];
}

/// Residual g - y of the unknowns into loop.step (in units of the nominal magnitudes), all else that the loop reads being known.
void LoopSolver::residual(Loop& loop, double t, const Vector& x, const Vector& w) noexcept {
  ++counters_.residual_evaluations;
  for (const Index input : loop.plan.core_inputs) values_.gather(input, w);
  for (const PortGroup& group : loop.core_groups) values_.evaluate(loop.plan.core.data() + group.begin, group.size, t, x);
  for (std::size_t k = 0; k < loop.plan.unknowns.size(); ++k) {
    const Index e = loop.plan.unknowns[k];
    loop.step[k] = (values_.g[e] - values_.y[e]) * loop.inverse_nominal[k];
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
  return factorize(loop);
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

bool LoopSolver::factorize(Loop& loop) noexcept {
  loop.secants.clear();
  loop.contraction_seen_at = 0.0;
  loop.factorized = loop.lu.factorize(loop.matrix);
  if (loop.factorized && loop.inverse.applies()) loop.inverse.take(loop.lu);
  return loop.factorized;
}

void LoopSolver::solveLinear(Loop& loop) noexcept {
  if (loop.inverse.applies()) loop.inverse.apply(loop.step.data());
  else loop.lu.solve(loop.step.data());
}

/// loop.step (a residual) becomes the Newton correction. The result, which estimates the error of the unknowns, is its maximum over max(nominal, |y|),
/// infinite when not finite; `worst` is the entry that has it. `learn`: from what loop.taken has left, should that be too much.
double LoopSolver::correction(Loop& loop, bool learn, Index& worst) noexcept {
  solveLinear(loop);
  loop.raw = loop.step;
  loop.secants.improve(loop.step.data());
  double norm = relativeSize(loop, worst);
  if (learn && norm > options_.tolerance) {
    loop.secants.learn(loop.taken.data(), loop.raw.data(), loop.step.data());
    norm = relativeSize(loop, worst);
  }
  return norm;
}

double LoopSolver::relativeSize(const Loop& loop, Index& worst) const noexcept {
  double norm = -1.0;
  for (std::size_t k = 0; k < loop.step.size(); ++k) {
    const Index e = loop.plan.unknowns[k];
    double scaled = std::abs(loop.step[k]);
    if (const double size = std::abs(values_.y[e]) * loop.inverse_nominal[k]; size > 1.0) scaled /= size;
    if (!std::isfinite(scaled)) scaled = HUGE_VAL;
    if (scaled > norm) {
      norm = scaled;
      worst = e;
    }
  }
  return norm;
}

/// The error that a first correction of this size is expected to leave: the share that the last checked one left, which grows in proportion to the
/// correction where the loop is not linear.
double LoopSolver::errorAfter(const Loop& loop, double correction) const noexcept {
  return kSafety * loop.contraction * correction * std::max(1.0, correction / loop.contraction_seen_at);
}

/// Small corrections tell less than large ones, because rounding is a part of what they leave and may hide all the rest: they count when the share has
/// clearly grown. A share that is small once, where the kept Jacobian happens to be right, is believed by halves only.
void LoopSolver::observeContraction(Loop& loop, double first, double second) const noexcept {
  constexpr double kAlike = 0.3, kMemory = 0.5;
  const double share = std::max(second, kRoundOff) / first;
  const bool small = first <= kWorthLearning || first < kAlike * loop.contraction_seen_at;
  if (small && !(second > kRoundOff && share > kSafety * loop.contraction)) return;
  loop.contraction = loop.contraction_seen_at > 0.0 ? std::max(share, kMemory * loop.contraction) : share;
  loop.contraction_seen_at = first;
}

void LoopSolver::apply(Loop& loop) noexcept {
  for (std::size_t k = 0; k < loop.plan.unknowns.size(); ++k) values_.y[loop.plan.unknowns[k]] += loop.step[k] * loop.nominal[k];
  ++counters_.newton_iterations;
}

/// Simplified Newton; the LU is kept as long as the corrections shrink, improved by secants. The tolerance is on the correction, not on the
/// residual: a loop like that of the mast hides an error 700 times larger than its residual.
SolveReport LoopSolver::iterate(Loop& loop, double t, const Vector& x, const Vector& w, bool trust) noexcept {
  SolveReport report;
  loop.trusted = false;
  double previous = HUGE_VAL;
  bool fresh = false;
  for (;; ++report.iterations) {
    residual(loop, t, x, w);
    if (!loop.factorized && !refresh(loop, t, x, w)) break;
    report.error = correction(loop, report.iterations > 0 && !fresh && previous > kWorthLearning, report.entry);
    if (report.iterations == 1 && !fresh) observeContraction(loop, previous, report.error);
    if (report.error <= options_.tolerance) return report;
    if (trust && report.iterations == 0) {
      if (const double expected = errorAfter(loop, report.error); expected <= options_.tolerance) {
        apply(loop);
        report.error = expected;
        loop.trusted = true;
        return report;
      }
    }
    if (!(report.error <= kLostContraction * previous)) {
      if (residualIsRoundOff(loop)) return report;  // corrections only stir round-off
      if (report.iterations > 0 && !fresh) {
        if (!refresh(loop, t, x, w)) break;
        report.error = correction(loop, false, report.entry);
        fresh = true;
      } else {
        fresh = false;
      }
    } else {
      fresh = false;
    }
    if (report.iterations >= options_.max_iterations || !std::isfinite(report.error)) break;
    previous = report.error;
    loop.taken = loop.step;
    apply(loop);
  }
  if (report.entry < 0) report.entry = loop.plan.unknowns.front();
  const bool finite = std::isfinite(report.error) && std::all_of(loop.matrix.begin(), loop.matrix.end(), [](double v) { return std::isfinite(v); });
  report.status = !finite ? SolveStatus::kNonFinite : loop.factorized ? SolveStatus::kStalled : SolveStatus::kSingular;
  return report;
}

/// From where the unknowns are likely to be; should that lead nowhere, from where they were.
SolveReport LoopSolver::iterateFromPrediction(Loop& loop, double t, const Vector& x, const Vector& w, bool trust) noexcept {
  const std::vector<Index>& unknowns = loop.plan.unknowns;
  for (std::size_t k = 0; k < unknowns.size(); ++k) loop.before[k] = values_.y[unknowns[k]];
  const bool predicted = loop.start.predict(t, loop.predicted.data());
  if (predicted) for (std::size_t k = 0; k < unknowns.size(); ++k) values_.y[unknowns[k]] = loop.predicted[k];
  SolveReport report = iterate(loop, t, x, w, trust);
  if (report.status != SolveStatus::kConverged && predicted) {
    loop.start.forget();
    loop.factorized = false;
    for (std::size_t k = 0; k < unknowns.size(); ++k) values_.y[unknowns[k]] = loop.before[k];
    report = iterate(loop, t, x, w, false);
  }
  if (report.status != SolveStatus::kConverged) return report;
  for (std::size_t k = 0; k < unknowns.size(); ++k) loop.predicted[k] = values_.y[unknowns[k]];
  loop.start.remember(t, loop.predicted.data());
  return report;
}

/// After everything is known: do these ports of the component still agree with what was used?
bool LoopSolver::consistent(const std::vector<Index>& ports, double t, const Vector& x, const Vector& w, Index& worst) noexcept {
  // Entries outside the iteration follow the residual's accuracy; a dependency that was overlooked shows far above it.
  const double tolerance = 100.0 * std::max(options_.tolerance, kRoundOff);
  for (const Index input : current().plan.inner_inputs) values_.gather(input, w);
  for (const Index port : ports) {
    values_.evaluate(&port, 1, t, x);
    const CoupledSystem::Output& output = values_.system.outputs()[port];
    for (Index e = output.begin; e < output.begin + output.size; ++e)
      if (!(std::abs(values_.g[e] - values_.y[e]) <= tolerance * std::max(output.nominal, std::abs(values_.y[e])))) {
        worst = e;
        return false;
      }
  }
  return true;
}

void LoopSolver::evaluateInOrder(const std::vector<Index>& ports, const std::vector<std::vector<Index>>& inputs, double t, const Vector& x, const Vector& w) noexcept {
  for (std::size_t k = 0; k < ports.size(); ++k) {
    for (const Index input : inputs[k]) values_.gather(input, w);
    values_.evaluate(&ports[k], 1, t, x);
    adopt(ports[k]);
  }
}

void LoopSolver::markUnknowns() noexcept {
  for (const Index e : full_.plan.unknowns) is_unknown_[e] = 0;
  for (const Index e : current().plan.unknowns) is_unknown_[e] = 1;
}

SolveReport LoopSolver::solve(double t, const Vector& x, const Vector& w, bool trust) noexcept {
  Loop& loop = current();
  loop.trusted = false;
  evaluateInOrder(loop.plan.before, loop.plan.before_inputs, t, x, w);
  SolveReport report = loop.plan.unknowns.empty() ? SolveReport() : iterateFromPrediction(loop, t, x, w, trust && loop.unchecked < kLongestTrust);
  // A trusted correction leaves what has been evaluated before it behind: entries that are not iterated keep the values with which the loop was solved.
  if (!loop.trusted) for (const Index port : loop.plan.core) adopt(port);
  evaluateInOrder(loop.plan.after, loop.plan.after_inputs, t, x, w);
  loop.unchecked = loop.trusted ? loop.unchecked + 1 : 0;
  const bool good = report.status == SolveStatus::kConverged && consistent(loop.trusted ? loop.plan.always_checked : loop.plan.outputs, t, x, w, report.entry);
  if (good || use_full_) return report;

  // Either a pruned zero became nonzero, or the pruned pattern hides what convergence needs: solve the whole loop.
  if (report.status == SolveStatus::kConverged) ++counters_.pruning_failures;
  use_full_ = true;
  markUnknowns();
  return solve(t, x, w, false);
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
    const std::vector<double> secants = loop->secants.values();
    cache.insert(cache.end(), secants.begin(), secants.end());
    loop->start.appendTo(cache);
    cache.insert(cache.end(), {loop->contraction, loop->contraction_seen_at, static_cast<double>(loop->unchecked)});
  }
}

void LoopSolver::restore(std::vector<double>::const_iterator& value) {
  use_full_ = *value++ != 0.0;
  for (Loop* loop : {&pruned_, &full_}) {
    const bool factorized = *value++ != 0.0;
    std::copy_n(value, loop->matrix.size(), loop->matrix.begin());
    value += static_cast<std::ptrdiff_t>(loop->matrix.size());
    loop->factorized = factorized && factorize(*loop);
    const auto secants = value;
    value += static_cast<std::ptrdiff_t>(loop->secants.values().size());
    loop->secants.restore({secants, value});
    loop->start.restore(value);
    loop->contraction = *value++;
    loop->contraction_seen_at = *value++;
    loop->unchecked = static_cast<int>(*value++);
  }
  markUnknowns();
}

}  // namespace heerk_rotor
