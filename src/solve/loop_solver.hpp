#pragma once
#include <vector>

#include "explicit_inverse.hpp"
#include "heerk_rotor/solve/algebraic_solver.hpp"
#include "heerk_rotor/solve/evaluation_plan.hpp"
#include "heerk_rotor/solve/secant_memory.hpp"
#include "heerk_rotor/solve/sparse_lu.hpp"
#include "heerk_rotor/solve/start_values.hpp"
#include "port_values.hpp"

namespace heerk_rotor {

/// Solves one loop of output ports by simplified Newton on its pruned unknowns; on all of its entries from the moment when pruning has failed.
class LoopSolver {
 public:
  LoopSolver(PortValues& values, const SolverOptions& options, SolverCounters& counters, const LoopPlan& pruned, const LoopPlan& full);

  /// `trust`: the last correction need not be checked by another evaluation where earlier solves say that it is good enough; what pruning assumes is.
  SolveReport solve(double t, const Vector& x, const Vector& w, bool trust) noexcept;

  /// Takes and factorises the Jacobian at the present y. False: singular.
  bool refresh(double t, const Vector& x, const Vector& w) noexcept { return current().plan.unknowns.empty() || refresh(current(), t, x, w); }

  LoopInfo info() const;
  const std::vector<Index>& outputs() const { return full_.plan.outputs; }

  /// What the next solve depends on besides y: appended to a cache, and read back from one.
  void appendTo(std::vector<double>& cache) const;
  void restore(std::vector<double>::const_iterator& value);

 private:
  /// A plan with the numbers that solving it needs.
  struct Loop {
    explicit Loop(const LoopPlan& p) : plan(p), lu(p.gradient), inverse(p.gradient.size), matrix(p.gradient.rows.size(), 0.0), nominal(p.unknowns.size(), 1.0), inverse_nominal(nominal),
          step(p.unknowns.size(), 0.0), raw(step), taken(step), reference(step), kept(step), before(step), predicted(step), secants(p.gradient.size), start(p.gradient.size) {}
    LoopPlan plan;
    std::vector<PortGroup> core_groups;    // of plan.core
    SparseLu lu;
    ExplicitInverse inverse;               // of the same matrix, where it is small
    std::vector<double> matrix;            // I - dg/dy in units of the nominal magnitudes, in the order of plan.gradient.rows
    std::vector<double> nominal, inverse_nominal;  // magnitude of each unknown; makes pivots of different quantities comparable
    bool factorized = false;
    std::vector<double> step, raw, taken;  // residual, then correction, in units of the nominal magnitudes; without secants; the last one applied
    std::vector<double> reference, kept;   // g and y before differences are taken
    std::vector<double> before, predicted; // y when a solve begins, and the guess it begins with
    SecantMemory secants;                  // how the Jacobian has changed since it was taken
    StartValues start;
    double contraction = 1.0;              // what the first correction of a solve left of the error, as found by the last check
    double contraction_seen_at = 0.0;      // the size of that first correction; 0: nothing is known
    int unchecked = 0;                     // solves in a row that ended with a trusted correction
    bool trusted = false;                  // the present one has
    Vector jacobian;                       // scratch for a model's own Jacobian
  };

  Loop& current() noexcept { return use_full_ ? full_ : pruned_; }
  const Loop& current() const noexcept { return use_full_ ? full_ : pruned_; }
  void markUnknowns() noexcept;
  void adopt(Index port) noexcept;
  void residual(Loop& loop, double t, const Vector& x, const Vector& w) noexcept;
  bool residualIsRoundOff(const Loop& loop) const noexcept;
  bool refresh(Loop& loop, double t, const Vector& x, const Vector& w) noexcept;
  void applyModelJacobians(Loop& loop, double t, const Vector& x) noexcept;
  static bool factorize(Loop& loop) noexcept;
  static void solveLinear(Loop& loop) noexcept;
  double correction(Loop& loop, bool learn, Index& worst) noexcept;
  double relativeSize(const Loop& loop, Index& worst) const noexcept;
  SolveReport iterate(Loop& loop, double t, const Vector& x, const Vector& w, bool trust) noexcept;
  SolveReport iterateFromPrediction(Loop& loop, double t, const Vector& x, const Vector& w, bool trust) noexcept;
  double errorAfter(const Loop& loop, double correction) const noexcept;
  void observeContraction(Loop& loop, double first, double second) const noexcept;
  void apply(Loop& loop) noexcept;
  bool consistent(const std::vector<Index>& ports, double t, const Vector& x, const Vector& w, Index& worst) noexcept;
  void evaluateInOrder(const std::vector<Index>& ports, const std::vector<std::vector<Index>>& inputs, double t, const Vector& x, const Vector& w) noexcept;

  PortValues& values_;
  const SolverOptions options_;
  SolverCounters& counters_;
  Loop pruned_, full_;
  bool use_full_;                    // from the start, or because pruning has failed once
  std::vector<char> is_unknown_;     // per y entry, for the plan in use
};

}  // namespace heerk_rotor
