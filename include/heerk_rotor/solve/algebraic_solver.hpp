#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"
#include "heerk_rotor/solve/sparse_lu.hpp"

namespace heerk_rotor {

/// What solving the algebraic part has cost so far.
struct SolverCounters {
  std::uint64_t solves = 0;
  std::uint64_t newton_iterations = 0;
  std::uint64_t residual_evaluations = 0;
  std::uint64_t jacobians = 0;
  std::uint64_t factorizations = 0;
  std::uint64_t pruning_failures = 0;  // a pruned zero of the gradient became nonzero; the loop was solved unpruned instead
};

enum class SolveStatus { kConverged, kStalled, kSingular, kNonFinite };

struct SolveReport {
  SolveStatus status = SolveStatus::kConverged;
  int iterations = 0;
  double error = 0.0;     // last Newton correction: maximum over unknowns of |correction| / max(nominal, |y|)
  Index entry = -1;       // global y entry that limits it when not converged
};

struct SolverOptions {
  double tolerance = 1e-10;   // on the scaled Newton correction, which estimates the error of y
  int max_iterations = 30;
  bool prune = true;          // false: every entry of a port-level loop is an unknown (reference for tests)
};

/// A loop of output ports, and what pruning left of it (HEERK paper, Section 4.3).
struct LoopInfo {
  std::vector<Index> outputs;    // ports of the strongly connected component
  Index entries = 0;             // scalar entries of those ports
  std::vector<Index> unknowns;   // global y entries that are iterated
  Index gradient_nonzeros = 0;   // of I - dg/dy on the unknowns
  Index factor_nonzeros = 0;     // of L + U
  SparsityPattern gradient;      // of I - dg/dy on the unknowns
  SparsityPattern factors;       // of L + U, in the order of elimination
};

/// Solves y = g(t, x, u(y, w)) for the coupled system: ports outside loops once, in order of dependency; ports in
/// loops by simplified Newton on the pruned unknowns with a sparse LU that is kept until contraction is lost.
/// Holds y and u of the last solution, which also is the next start value.
class AlgebraicSolver {
 public:
  /// Chooses the system's narrow forms and probes the gradient around (t, x, w). Throws CouplingError when a loop is not index 1 there
  /// (I - dg/dy singular) and names the ports of the loop.
  AlgebraicSolver(CoupledSystem& system, const SolverOptions& options, double t, const Vector& x, const Vector& w);
  ~AlgebraicSolver();

  /// What f needs: u, and of y the ports in loops and those with several readers; all of y is right only after evalObserved(). Allocates nothing.
  SolveReport solve(double t, const Vector& x, const Vector& w) noexcept;

  /// The same for an instant within a step that nobody sees. A correction whose error, as estimated from earlier solves, is below a quarter of the tolerance
  /// is not checked by another evaluation of the loop; at least every eighth solve in a row is.
  SolveReport solveWithin(double t, const Vector& x, const Vector& w) noexcept;

  /// solveWithin(), then CoupledSystem::evalRemainder() while models still know that the state is the same; without a solution `remainder` is left alone.
  SolveReport evalRemainderWithin(double t, const Vector& x, const Vector& w, bool complete, double* remainder) noexcept;

  /// solveWithin() in a stage whose state is given as z (CoupledSystem::stageSize()).
  SolveReport solveStage(double t, const Vector& z, const Vector& w) noexcept;

  /// All other outputs, from the last solution: call before reading y.
  void evalObserved(double t, const Vector& x, const Vector& w) noexcept;

  const Vector& y() const;
  const Vector& u() const;
  const SolverCounters& counters() const;
  std::vector<std::uint64_t> outputEvaluations() const;  // per subsystem: calls of evalOutput
  const std::vector<LoopInfo>& loops() const;

  /// Everything the next solve depends on (start values, Jacobians), for bitwise equal continuation.
  std::vector<double> cache() const;
  void restoreCache(const std::vector<double>& cache);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> impl_;
};

}  // namespace heerk_rotor
