#include "heerk_rotor/solve/algebraic_solver.hpp"

#include <algorithm>

#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/solve/evaluation_plan.hpp"
#include "loop_solver.hpp"
#include "port_values.hpp"

namespace heerk_rotor {

struct AlgebraicSolver::Implementation {
  explicit Implementation(CoupledSystem& system) : values(system) {}

  /// One thing to do in a solve. An input is taken over before anything reads it in this solve, so nobody asks whether it changed.
  struct Action {
    enum class Kind { kCopy, kFetch, kEvaluate, kEvaluateTogether, kSolveLoop };
    Kind kind;
    Index number;                 // kFetch: input; kSolveLoop: loop; kEvaluate...: first of `ports` and `results`
    Index size = 0;               // of a copy; kEvaluateTogether: ports, all of one subsystem
    const double* from = nullptr; // of a copy: the one output that feeds an input
    double* to = nullptr;         // of a copy; kEvaluate: the port's values
    CoupledSystem::OutputCall call = {};   // kEvaluate
  };

  static Action copy(const double* from, Index size, double* to) { return {Action::Kind::kCopy, 0, size, from, to}; }

  PortValues values;
  std::vector<LoopSolver> loops;
  std::vector<Action> actions, stage_actions;      // what f needs, from x and from a stage's z
  std::vector<Action> observed_actions;            // what only observers need
  std::vector<Index> ports;                        // of kEvaluate
  std::vector<double*> results;                    // where their values go
  std::vector<LoopInfo> infos;
  SolverCounters counters;

  Action take(Index number) {
    const CoupledSystem::Input& input = values.system.inputs()[number];
    if (input.source_begin.size() != 1) return {Action::Kind::kFetch, number};
    return copy(values.y.data() + input.source_begin[0], input.size, values.u.data() + input.begin);
  }

  /// The input that alone reads a port outside loops, with no other source: -1 if there is none such.
  Index onlyReader(Index output) const {
    Index reader = -1, readers = 0;
    for (std::size_t i = 0; i < values.system.inputs().size(); ++i) {
      const CoupledSystem::Input& input = values.system.inputs()[i];
      if (std::find(input.sources.begin(), input.sources.end(), output) == input.sources.end()) continue;
      ++readers;
      reader = input.sources.size() == 1 ? static_cast<Index>(i) : -1;
    }
    return readers == 1 ? reader : -1;
  }

  enum class For { kF, kStage, kObservers };

  std::vector<Action> actionsOf(const std::vector<EvaluationPlan::Item>& items, const std::vector<Index>& last_inputs, For whom) {
    const auto& outputs = values.system.outputs();
    std::vector<Action> list;
    std::vector<char> written(values.system.inputs().size(), 0);  // inputs into which the port that feeds them writes
    const auto takeOver = [&](Index input) { if (!written[input]) list.push_back(take(input)); };
    std::vector<Index> group;  // outputs of the last action, when that is an evaluation
    for (const EvaluationPlan::Item& item : items) {
      if (item.output < 0) {
        for (const Index input : item.inputs) takeOver(input);
        list.push_back({Action::Kind::kSolveLoop, item.loop});
        group.clear();
        continue;
      }
      const CoupledSystem::Output& output = outputs[item.output];
      const auto feedsItself = [&](Index input) {
        const auto& sources = values.system.inputs()[input].sources;
        return std::any_of(sources.begin(), sources.end(), [&](Index source) { return std::find(group.begin(), group.end(), source) != group.end(); });
      };
      const bool joins = !group.empty() && outputs[group.front()].subsystem == output.subsystem && group.size() < static_cast<std::size_t>(CoupledSystem::kTogether) &&
                         std::none_of(item.inputs.begin(), item.inputs.end(), feedsItself);
      Action evaluate{Action::Kind::kEvaluate, static_cast<Index>(ports.size()), 0};
      if (joins) {
        evaluate = list.back();
        list.pop_back();
      } else {
        group.clear();
      }
      for (const Index input : item.inputs) takeOver(input);
      // A port that a single input reads goes there at once; y gets it only when somebody observes.
      double* result = values.y.data() + output.begin;
      if (const Index reader = onlyReader(item.output); whom != For::kObservers && reader >= 0) {
        const CoupledSystem::Input& input = values.system.inputs()[reader];
        result = values.u.data() + input.begin;
        written[reader] = 1;
        if (whom == For::kF) observed_actions.push_back(copy(result, output.size, values.y.data() + output.begin));
      }
      ports.push_back(item.output);
      results.push_back(result);
      group.push_back(item.output);
      if (++evaluate.size > 1) evaluate.kind = Action::Kind::kEvaluateTogether;
      evaluate.to = result;
      evaluate.call = values.system.outputCall(item.output, whom == For::kStage);
      list.push_back(evaluate);
    }
    for (const Index input : last_inputs) takeOver(input);
    return list;
  }

  SolveReport run(const std::vector<Action>& list, double t, const Vector& x, const Vector& w, bool trust = false) noexcept {
    SolveReport worst;
    for (const Action& action : list) {
      switch (action.kind) {
        case Action::Kind::kCopy: copyShort(action.from, action.size, action.to); break;
        case Action::Kind::kFetch: values.system.fetch(action.number, values.y, w, values.u); break;
        case Action::Kind::kEvaluate:
          ++values.evaluations[static_cast<std::size_t>(ports[static_cast<std::size_t>(action.number)])];
          action.call(t, x.data(), values.u.data(), action.to);
          break;
        case Action::Kind::kEvaluateTogether: values.evaluateInto(ports.data() + action.number, action.size, t, x, results.data() + action.number); break;
        case Action::Kind::kSolveLoop: {
          const SolveReport report = loops[static_cast<std::size_t>(action.number)].solve(t, x, w, trust);
          if (report.status != SolveStatus::kConverged) return report;
          worst.iterations += report.iterations;
          if (report.error > worst.error) {
            worst.error = report.error;
            worst.entry = report.entry;
          }
          break;
        }
      }
    }
    return worst;
  }

  SolveReport solve(double t, const Vector& x, const Vector& w, bool in_stage, bool trust) noexcept {
    return solve(t, x, w, in_stage, trust, [] {});
  }

  /// then(): evaluates more at the same state, if there is a solution.
  template <class Then>
  SolveReport solve(double t, const Vector& x, const Vector& w, bool in_stage, bool trust, const Then& then) noexcept {
    ++counters.solves;
    values.in_stage = in_stage;
    values.beginSolve();
    const SolveReport report = run(in_stage ? stage_actions : actions, t, x, w, trust);
    if (report.status == SolveStatus::kConverged) then();
    values.endSolve();
    return report;
  }
};

AlgebraicSolver::AlgebraicSolver(CoupledSystem& system, const SolverOptions& options, double t, const Vector& x, const Vector& w)
    : impl_(std::make_unique<Implementation>(system)) {
  Implementation& s = *impl_;
  const EvaluationPlan plan = planEvaluation(system, t, x, w);
  system.chooseNarrowForms(neededInStages(plan, system));
  for (std::size_t l = 0; l < plan.pruned.size(); ++l) s.loops.emplace_back(s.values, options, s.counters, plan.pruned[l], plan.full[l]);
  s.actions = s.actionsOf(plan.stage, plan.last_inputs, Implementation::For::kF);
  s.stage_actions = s.actionsOf(plan.stage, plan.last_inputs, Implementation::For::kStage);
  const auto observed = s.actionsOf(plan.observed, {}, Implementation::For::kObservers);
  s.observed_actions.insert(s.observed_actions.end(), observed.begin(), observed.end());
  for (std::size_t input = 0; input < system.inputs().size(); ++input)  // constants and commands, before anything reads them
    s.values.gather(static_cast<Index>(input), w);

  // The system must be index 1 here, also where the start values happen to solve a loop that has no unique solution.
  SolveReport report = s.solve(t, x, w, false, false);
  for (LoopSolver& loop : s.loops)
    if (report.status == SolveStatus::kConverged && !loop.refresh(t, x, w)) report.status = SolveStatus::kSingular;
  for (const LoopSolver& loop : s.loops) s.infos.push_back(loop.info());
  if (report.status == SolveStatus::kConverged) return;
  std::string ports;
  for (const LoopSolver& loop : s.loops)
    for (const Index port : loop.outputs()) ports += (ports.empty() ? "" : ", ") + system.outputs()[port].name;
  throw CouplingError(report.status == SolveStatus::kSingular
      ? "the algebraic loop through " + ports + " is not index 1: I - dg/dy is singular at the initial state"
      : "the algebraic loop through " + ports + " has no solution near the initial state (Newton did not converge)");
}

AlgebraicSolver::~AlgebraicSolver() = default;

SolveReport AlgebraicSolver::solve(double t, const Vector& x, const Vector& w) noexcept { return impl_->solve(t, x, w, false, false); }

SolveReport AlgebraicSolver::solveWithin(double t, const Vector& x, const Vector& w) noexcept { return impl_->solve(t, x, w, false, true); }

SolveReport AlgebraicSolver::evalRemainderWithin(double t, const Vector& x, const Vector& w, bool complete, double* remainder) noexcept {
  return impl_->solve(t, x, w, false, true, [&] { impl_->values.system.evalRemainder(t, x, impl_->values.u, complete, remainder); });
}

SolveReport AlgebraicSolver::solveStage(double t, const Vector& z, const Vector& w) noexcept { return impl_->solve(t, z, w, true, true); }

void AlgebraicSolver::evalObserved(double t, const Vector& x, const Vector& w) noexcept {
  impl_->values.in_stage = false;
  impl_->run(impl_->observed_actions, t, x, w);
}

const Vector& AlgebraicSolver::y() const { return impl_->values.y; }
const Vector& AlgebraicSolver::u() const { return impl_->values.u; }
const SolverCounters& AlgebraicSolver::counters() const { return impl_->counters; }
std::vector<std::uint64_t> AlgebraicSolver::outputEvaluations() const {
  const CoupledSystem& system = impl_->values.system;
  std::vector<std::uint64_t> sums(system.subsystems().size(), 0);
  for (std::size_t o = 0; o < system.outputs().size(); ++o) sums[static_cast<std::size_t>(system.outputs()[o].subsystem)] += impl_->values.evaluations[o];
  return sums;
}
const std::vector<LoopInfo>& AlgebraicSolver::loops() const { return impl_->infos; }

std::vector<double> AlgebraicSolver::cache() const {
  std::vector<double> cache(impl_->values.y.begin(), impl_->values.y.end());
  for (const LoopSolver& loop : impl_->loops) loop.appendTo(cache);
  return cache;
}

void AlgebraicSolver::restoreCache(const std::vector<double>& cache) {
  if (cache.size() != this->cache().size())
    throw std::invalid_argument("solver cache has " + std::to_string(cache.size()) + " values, expected " + std::to_string(this->cache().size()));
  Vector& y = impl_->values.y;
  std::copy_n(cache.begin(), y.size(), y.begin());
  auto value = cache.begin() + y.size();
  for (LoopSolver& loop : impl_->loops) loop.restore(value);
}

}  // namespace heerk_rotor
