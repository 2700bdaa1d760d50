#include "heerk_rotor/solve/algebraic_solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "broyden_memory.hpp"
#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/solve/evaluation_plan.hpp"
#include "heerk_rotor/solve/sparse_lu.hpp"

namespace heerk_rotor {
namespace {

constexpr double kLostContraction = 0.3;   // ratio of two corrections above which the Jacobian is refreshed
constexpr double kDifference = 1.5e-8;     // relative step of forward differences, sqrt of the machine precision
constexpr double kRoundOff = 64 * 2.2e-16; // a residual below this share of the value cannot be lowered any more

/// What most ports carry: a few numbers, written one by one just before. Copied likewise, because a vector load would have to wait until all of them
/// have left the store buffer, and a call of the library costs more than the copy.
inline void copyShort(const double* from, Index size, double* to) noexcept {
  if (size > 16) {
    std::memcpy(to, from, static_cast<std::size_t>(size) * sizeof(double));
    return;
  }
#pragma GCC unroll 1
  for (Index i = 0; i < size; ++i) {
    to[i] = from[i];
    asm volatile("" ::: "memory");  // keeps the loop a loop
  }
}

/// A plan with the numbers that solving it needs.
struct Loop {
  explicit Loop(const LoopPlan& p) : plan(p), lu(p.gradient), matrix(p.gradient.rows.size(), 0.0), nominal(p.unknowns.size(), 1.0), inverse_nominal(nominal),
        step(p.unknowns.size(), 0.0), reference(p.unknowns.size(), 0.0), kept(p.unknowns.size(), 0.0), broyden(p.unknowns.size()) {}
  LoopPlan plan;
  SparseLu lu;
  std::vector<double> matrix;            // I - dg/dy in units of the nominal magnitudes, in the order of plan.gradient.rows
  std::vector<double> nominal, inverse_nominal;  // magnitude of each unknown; makes pivots of different quantities comparable
  bool factorized = false;
  std::vector<double> step, reference, kept;
  BroydenMemory broyden;                 // of the present solve
  Vector jacobian;                       // scratch for a model's own Jacobian
};

}  // namespace

struct AlgebraicSolver::Implementation {
  Implementation(CoupledSystem& s, const SolverOptions& o) : system(s), options(o) {}

  CoupledSystem& system;
  SolverOptions options;
  EvaluationPlan plan;
  /// plan.stage and plan.last_inputs as a list of what is to be done, with all addresses looked up. An input is taken over before anything reads it in
  /// this solve, so nobody asks whether it changed.
  struct Action {
    enum class Kind { kCopy, kFetch, kEvaluate, kSolveLoop };
    Kind kind;
    const double* from;                      // kCopy: the one output that feeds an input
    double* to;                              // kCopy, kEvaluate
    Index size;
    Index number;                            // kFetch: input; kEvaluate: port of its owner; kSolveLoop: loop
    const CoupledSystem::Subsystem* owner;   // kEvaluate
    std::uint64_t* evaluations;              // of the owner
  };
  std::vector<Action> actions, observed_actions;
  std::vector<Loop> pruned, full;
  std::vector<char> use_full;            // per loop: pruning has failed once
  std::vector<char> is_unknown;          // per y entry, for the plan in use
  std::vector<LoopInfo> infos;
  SolverCounters counters;
  std::vector<std::uint64_t> evaluations;

  Vector y, u, g;                        // g: latest evaluation of ports in loops

  // Change stamps: a port is up to date when it has been evaluated in this solve and none of its inputs changed since.
  std::uint64_t clock = 1, stage_stamp = 1;
  std::vector<std::uint64_t> input_stamp, output_stamp;

  // Where the state comes from: x, or a stage's z.
  bool in_stage = false;

  void value(Index port, double t, const Vector& x, double* result) noexcept {
    if (in_stage) system.evalStageOutput(port, t, x, u, result);
    else system.evalOutput(port, t, x, u, result);
  }

  void gather(Index input, const Vector& w) noexcept {
    if (system.gather(input, y, w, u)) input_stamp[input] = ++clock;
  }

  /// Brings g (of a port) up to date with x and u; returns without evaluating when nothing changed.
  void evaluate(Index port, double t, const Vector& x) noexcept {
    const CoupledSystem::Output& output = system.outputs()[port];
    std::uint64_t newest = stage_stamp;
    for (const Index input : output.feedthrough) newest = std::max(newest, input_stamp[input]);
    if (output_stamp[port] >= newest) return;
    value(port, t, x, g.data() + output.begin);
    output_stamp[port] = ++clock;
    ++evaluations[output.subsystem];
  }

  Action evaluation(Index port) {
    const CoupledSystem::Output& output = system.outputs()[port];
    const CoupledSystem::Subsystem* owner = &system.subsystems()[output.subsystem];
    return {Action::Kind::kEvaluate, nullptr, y.data() + output.begin, output.size, output.port, owner, &evaluations[output.subsystem]};
  }

  Action take(Index number) {
    const CoupledSystem::Input& input = system.inputs()[number];
    if (input.source_begin.size() != 1) return {Action::Kind::kFetch, nullptr, nullptr, 0, number, nullptr, nullptr};
    return {Action::Kind::kCopy, y.data() + input.source_begin[0], u.data() + input.begin, input.size, 0, nullptr, nullptr};
  }

  std::vector<Action> actionsOf(const std::vector<EvaluationPlan::Item>& items, const std::vector<Index>& last_inputs) {
    std::vector<Action> list;
    for (const EvaluationPlan::Item& item : items) {
      for (const Index input : item.inputs) list.push_back(take(input));
      if (item.output >= 0) list.push_back(evaluation(item.output));
      else list.push_back({Action::Kind::kSolveLoop, nullptr, nullptr, 0, item.loop, nullptr, nullptr});
    }
    for (const Index input : last_inputs) list.push_back(take(input));
    return list;
  }

  /// A port outside the loops: once per solve, straight into y.
  void evaluateOnce(const Action& action, double t, const Vector& x) noexcept {
    const CoupledSystem::Subsystem& s = *action.owner;
    const In us(u.data() + s.u_begin, s.u_size);
    const Out result(action.to, action.size);
    ++*action.evaluations;
    if (!in_stage) return s.model->evalOutput(action.number, t, In(x.data() + s.x_begin, s.x_size), us, result);
    const In zs(x.data() + s.z_begin, s.z_size);
    if (s.narrow) s.model->evalNarrowOutput(action.number, t, zs, us, result);
    else s.model->evalOutput(action.number, t, zs, us, result);
  }

  void takeOver(const Action& action, const Vector& w) noexcept {
    if (action.kind == Action::Kind::kFetch) return system.fetch(action.number, y, w, u);
    copyShort(action.from, action.size, action.to);
  }

  /// y of a port from g, sparing the entries that are being iterated.
  void adopt(Index port) noexcept {
    const CoupledSystem::Output& output = system.outputs()[port];
    for (Index e = output.begin; e < output.begin + output.size; ++e)
      if (!is_unknown[e]) y[e] = g[e];
  }

  /// Residual g - y of the unknowns into loop.step, all else that the loop reads being known.
  void residual(Loop& loop, double t, const Vector& x, const Vector& w) noexcept {
    ++counters.residual_evaluations;
    for (const Index input : loop.plan.core_inputs) gather(input, w);
    for (const Index port : loop.plan.core) evaluate(port, t, x);
    for (std::size_t k = 0; k < loop.plan.unknowns.size(); ++k) {
      const Index e = loop.plan.unknowns[k];
      loop.step[k] = g[e] - y[e];
    }
  }

  bool residualIsRoundOff(const Loop& loop) const noexcept {
    for (std::size_t k = 0; k < loop.plan.unknowns.size(); ++k) {
      const Index e = loop.plan.unknowns[k];
      if (!(std::abs(g[e] - y[e]) <= kRoundOff * std::max(loop.nominal[k], std::abs(y[e])))) return false;
    }
    return true;
  }

  /// matrix = I - dg/dy at the present y: forward differences colour by colour, then the rows models know themselves.
  bool refresh(Loop& loop, double t, const Vector& x, const Vector& w) noexcept {
    ++counters.jacobians;
    const LoopPlan& p = loop.plan;
    const auto n = p.unknowns.size();
    residual(loop, t, x, w);
    for (std::size_t k = 0; k < n; ++k) {
      loop.reference[k] = g[p.unknowns[k]];
      loop.kept[k] = y[p.unknowns[k]];
    }
    for (Index colour = 0; colour < p.colours; ++colour) {
      for (std::size_t j = 0; j < n; ++j) {
        if (p.colour[j] != colour) continue;
        const Index e = p.unknowns[j];
        y[e] = loop.kept[j] + kDifference * std::max(std::abs(loop.kept[j]), loop.nominal[j]);
      }
      residual(loop, t, x, w);
      for (std::size_t j = 0; j < n; ++j) {
        if (p.colour[j] != colour) continue;
        const double width = y[p.unknowns[j]] - loop.kept[j];
        for (Index q = p.gradient.start[j]; q < p.gradient.start[j + 1]; ++q) {
          const Index i = p.gradient.rows[q];
          const double slope = (g[p.unknowns[i]] - loop.reference[i]) / width;
          loop.matrix[q] = (i == static_cast<Index>(j) ? 1.0 : 0.0) - slope * loop.nominal[j] / loop.nominal[i];
        }
        y[p.unknowns[j]] = loop.kept[j];
      }
    }
    residual(loop, t, x, w);  // u and g belong to y again
    applyModelJacobians(loop, t, x);
    ++counters.factorizations;
    loop.factorized = loop.lu.factorize(loop.matrix);
    return loop.factorized;
  }

  /// Replaces differenced rows by exact ones where a model knows d(port)/d(u): an unknown y_j reaches the inputs it feeds.
  void applyModelJacobians(Loop& loop, double t, const Vector& x) noexcept {
    const LoopPlan& p = loop.plan;
    for (const Index port : p.core) {
      const CoupledSystem::Output& output = system.outputs()[port];
      const CoupledSystem::Subsystem& owner = system.subsystems()[output.subsystem];
      if (in_stage && owner.narrow) continue;  // knows itself in x only
      Eigen::Map<Matrix> jacobian(loop.jacobian.data(), output.size, owner.u_size);
      jacobian.setZero();
      if (!owner.model->outputJacobian(output.port, t, In(x.data() + (in_stage ? owner.z_begin : owner.x_begin), owner.x_size), In(u.data() + owner.u_begin, owner.u_size), jacobian)) continue;
      for (std::size_t j = 0; j < p.unknowns.size(); ++j) {
        for (Index q = p.gradient.start[j]; q < p.gradient.start[j + 1]; ++q) {
          const Index i = p.gradient.rows[q], row = p.unknowns[i] - output.begin;
          if (row < 0 || row >= output.size) continue;
          double slope = 0.0;
          for (const Index number : output.feedthrough) {
            const CoupledSystem::Input& input = system.inputs()[number];
            for (const Index source : input.sources) {
              const Index offset = p.unknowns[j] - system.outputs()[source].begin;
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
  double correction(Loop& loop, Index& worst) noexcept {
    const std::size_t n = loop.step.size();
    for (std::size_t k = 0; k < n; ++k) loop.step[k] *= loop.inverse_nominal[k];
    loop.lu.solve(loop.step.data());
    loop.broyden.improve(loop.step.data());
    double norm = -1.0;
    for (std::size_t k = 0; k < n; ++k) {
      const Index e = loop.plan.unknowns[k];
      double scaled = std::abs(loop.step[k]);
      if (const double size = std::abs(y[e]) * loop.inverse_nominal[k]; size > 1.0) scaled /= size;
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
  SolveReport iterate(Loop& loop, double t, const Vector& x, const Vector& w) noexcept {
    SolveReport report;
    double previous = HUGE_VAL;
    bool fresh = false;
    loop.broyden.clear();
    for (;; ++report.iterations) {
      residual(loop, t, x, w);
      if (!loop.factorized && !refresh(loop, t, x, w)) break;
      report.error = correction(loop, report.entry);
      if (report.error <= options.tolerance) return report;
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
      if (report.iterations >= options.max_iterations || !std::isfinite(report.error)) break;
      previous = report.error;
      loop.broyden.remember(loop.step.data(), loop.inverse_nominal.data());
      for (std::size_t k = 0; k < loop.plan.unknowns.size(); ++k) y[loop.plan.unknowns[k]] += loop.step[k];
      ++counters.newton_iterations;
    }
    if (report.entry < 0) report.entry = loop.plan.unknowns.front();
    const bool finite = std::isfinite(report.error) && std::all_of(loop.matrix.begin(), loop.matrix.end(), [](double v) { return std::isfinite(v); });
    report.status = !finite ? SolveStatus::kNonFinite : loop.factorized ? SolveStatus::kStalled : SolveStatus::kSingular;
    return report;
  }

  /// After everything is known: does each port of the component still agree with what was used?
  bool consistent(const Loop& loop, double t, const Vector& x, const Vector& w, Index& worst) noexcept {
    // Entries outside the iteration follow the residual's accuracy; a dependency that was overlooked shows far above it.
    const double tolerance = 100.0 * std::max(options.tolerance, kRoundOff);
    for (const Index input : loop.plan.inner_inputs) gather(input, w);
    for (const Index port : loop.plan.outputs) {
      evaluate(port, t, x);
      const CoupledSystem::Output& output = system.outputs()[port];
      for (Index e = output.begin; e < output.begin + output.size; ++e)
        if (!(std::abs(g[e] - y[e]) <= tolerance * std::max(output.nominal, std::abs(y[e])))) {
          worst = e;
          return false;
        }
    }
    return true;
  }

  void evaluateInOrder(const LoopPlan& p, const std::vector<Index>& ports, double t, const Vector& x, const Vector& w) noexcept {
    for (const Index port : ports) {
      for (const Index input : p.inner_inputs) gather(input, w);
      evaluate(port, t, x);
      adopt(port);
    }
  }

  void markUnknowns(std::size_t number) noexcept {
    for (const Index e : full[number].plan.unknowns) is_unknown[e] = 0;
    for (const Index e : current(number).plan.unknowns) is_unknown[e] = 1;
  }
  Loop& current(std::size_t number) noexcept { return use_full[number] ? full[number] : pruned[number]; }

  SolveReport solveLoop(std::size_t number, double t, const Vector& x, const Vector& w) noexcept {
    Loop& loop = current(number);
    evaluateInOrder(loop.plan, loop.plan.before, t, x, w);
    SolveReport report;
    if (!loop.plan.unknowns.empty()) report = iterate(loop, t, x, w);
    for (const Index port : loop.plan.core) adopt(port);
    evaluateInOrder(loop.plan, loop.plan.after, t, x, w);
    const bool good = report.status == SolveStatus::kConverged && consistent(loop, t, x, w, report.entry);
    if (good || use_full[number]) return report;

    // Either a pruned zero became nonzero, or the pruned pattern hides what convergence needs: solve the whole loop.
    if (report.status == SolveStatus::kConverged) ++counters.pruning_failures;
    use_full[number] = 1;
    markUnknowns(number);
    return solveLoop(number, t, x, w);
  }

  SolveReport solve(double t, const Vector& x, const Vector& w) noexcept {
    ++counters.solves;
    stage_stamp = ++clock;
    SolveReport worst;
    for (const Action& action : actions) {
      if (action.kind == Action::Kind::kEvaluate) {
        evaluateOnce(action, t, x);
        continue;
      }
      if (action.kind != Action::Kind::kSolveLoop) {
        takeOver(action, w);
        continue;
      }
      const SolveReport report = solveLoop(static_cast<std::size_t>(action.number), t, x, w);
      if (report.status != SolveStatus::kConverged) return report;
      worst.iterations += report.iterations;
      if (report.error > worst.error) {
        worst.error = report.error;
        worst.entry = report.entry;
      }
    }
    return worst;
  }
};

AlgebraicSolver::AlgebraicSolver(CoupledSystem& system, const SolverOptions& options, double t, const Vector& x, const Vector& w)
    : impl_(std::make_unique<Implementation>(system, options)) {
  Implementation& s = *impl_;
  s.plan = planEvaluation(system, t, x, w);
  system.chooseNarrowForms(neededInStages(s.plan, system));
  s.y = s.g = Vector::Zero(system.outputSize());
  s.u = Vector::Zero(system.inputSize());
  s.input_stamp.assign(system.inputs().size(), 0);
  s.output_stamp.assign(system.outputs().size(), 0);
  s.evaluations.assign(system.subsystems().size(), 0);
  s.is_unknown.assign(static_cast<std::size_t>(system.outputSize()), 0);
  s.use_full.assign(s.plan.pruned.size(), options.prune ? 0 : 1);
  for (std::size_t l = 0; l < s.plan.pruned.size(); ++l) {
    s.pruned.emplace_back(s.plan.pruned[l]);
    s.full.emplace_back(s.plan.full[l]);
    std::size_t largest = 0;
    for (const Index port : s.plan.full[l].outputs) {
      const CoupledSystem::Output& output = system.outputs()[port];
      largest = std::max(largest, static_cast<std::size_t>(output.size * system.subsystems()[output.subsystem].u_size));
    }
    for (Loop* loop : {&s.pruned.back(), &s.full.back()}) {
      loop->jacobian.setZero(static_cast<Index>(largest));
      for (std::size_t k = 0; k < loop->nominal.size(); ++k)
        for (const Index port : loop->plan.outputs)
          if (const CoupledSystem::Output& output = system.outputs()[port]; loop->plan.unknowns[k] >= output.begin && loop->plan.unknowns[k] < output.begin + output.size)
            loop->inverse_nominal[k] = 1.0 / (loop->nominal[k] = output.nominal);
    }
    s.markUnknowns(l);
  }
  s.actions = s.actionsOf(s.plan.stage, s.plan.last_inputs);
  s.observed_actions = s.actionsOf(s.plan.observed, {});
  for (const CoupledSystem::Input& input : system.inputs())  // constants and commands, before anything reads them
    s.gather(&input - system.inputs().data(), w);

  // The system must be index 1 here, also where the start values happen to solve a loop that has no unique solution.
  SolveReport report = s.solve(t, x, w);
  for (std::size_t l = 0; l < s.pruned.size() && report.status == SolveStatus::kConverged; ++l)
    if (!s.current(l).plan.unknowns.empty() && !s.refresh(s.current(l), t, x, w)) report.status = SolveStatus::kSingular;
  for (std::size_t l = 0; l < s.pruned.size(); ++l) {
    const Loop& loop = s.current(l);
    s.infos.push_back({loop.plan.outputs, static_cast<Index>(s.plan.full[l].unknowns.size()), loop.plan.unknowns,
                       loop.plan.gradient.nonzeros(), loop.lu.factorNonzeros(), loop.plan.gradient,
                       loop.plan.unknowns.empty() ? SparsityPattern() : loop.lu.factorPattern()});
  }
  if (report.status == SolveStatus::kConverged) return;
  std::string ports;
  for (const LoopPlan& loop : s.plan.full)
    for (const Index port : loop.outputs) ports += (ports.empty() ? "" : ", ") + system.outputs()[port].name;
  throw CouplingError(report.status == SolveStatus::kSingular
      ? "the algebraic loop through " + ports + " is not index 1: I - dg/dy is singular at the initial state"
      : "the algebraic loop through " + ports + " has no solution near the initial state (Newton did not converge)");
}

AlgebraicSolver::~AlgebraicSolver() = default;

SolveReport AlgebraicSolver::solve(double t, const Vector& x, const Vector& w) noexcept { return impl_->solve(t, x, w); }

SolveReport AlgebraicSolver::solveStage(double t, const Vector& z, const Vector& w) noexcept {
  impl_->in_stage = true;
  const SolveReport report = impl_->solve(t, z, w);
  impl_->in_stage = false;
  return report;
}

void AlgebraicSolver::evalObserved(double t, const Vector& x, const Vector& w) noexcept {
  for (const Implementation::Action& action : impl_->observed_actions) {
    if (action.kind == Implementation::Action::Kind::kEvaluate) impl_->evaluateOnce(action, t, x);
    else impl_->takeOver(action, w);
  }
}

const Vector& AlgebraicSolver::y() const { return impl_->y; }
const Vector& AlgebraicSolver::u() const { return impl_->u; }
const SolverCounters& AlgebraicSolver::counters() const { return impl_->counters; }
const std::vector<std::uint64_t>& AlgebraicSolver::outputEvaluations() const { return impl_->evaluations; }
const std::vector<LoopInfo>& AlgebraicSolver::loops() const { return impl_->infos; }

std::vector<double> AlgebraicSolver::cache() const {
  std::vector<double> cache(impl_->y.begin(), impl_->y.end());
  for (std::size_t l = 0; l < impl_->pruned.size(); ++l) {
    cache.push_back(impl_->use_full[l]);
    for (const Loop* loop : {&impl_->pruned[l], &impl_->full[l]}) {
      cache.push_back(loop->factorized);
      cache.insert(cache.end(), loop->matrix.begin(), loop->matrix.end());
    }
  }
  return cache;
}

void AlgebraicSolver::restoreCache(const std::vector<double>& cache) {
  if (cache.size() != this->cache().size())
    throw std::invalid_argument("solver cache has " + std::to_string(cache.size()) + " values, expected " + std::to_string(this->cache().size()));
  auto value = cache.begin();
  std::copy_n(value, impl_->y.size(), impl_->y.begin());
  value += impl_->y.size();
  for (std::size_t l = 0; l < impl_->pruned.size(); ++l) {
    impl_->use_full[l] = *value++ != 0.0;
    for (Loop* loop : {&impl_->pruned[l], &impl_->full[l]}) {
      const bool factorized = *value++ != 0.0;
      std::copy_n(value, loop->matrix.size(), loop->matrix.begin());
      value += static_cast<std::ptrdiff_t>(loop->matrix.size());
      loop->factorized = factorized && loop->lu.factorize(loop->matrix);
    }
    impl_->markUnknowns(l);
  }
}

}  // namespace heerk_rotor
