#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "heerk_rotor/analysis/monodromy.hpp"
#include "heerk_rotor/analysis/trim_settings.hpp"

namespace heerk_rotor {

/// A motion with the period of one revolution, and the controls that keep it: the solution of
///   x(T; x(0), w) - x(0) = 0,   mean over T of signal_k = target_k,
/// by Newton's method on the step map (periodic shooting). Unknown are x(0), except held states, and the chosen entries of w.
///
/// The gradient is differenced, one revolution per state and control, and kept while the residual shrinks to less than 0.3 per
/// iteration. Steps are least-squares solutions of minimum norm in scaled unknowns, because neutral directions exist (the
/// position of a free fuselage) and held states make the system rectangular; they are halved until the residual falls. Controls
/// stop at their limits and leave them again when the step leads inward.
struct TrimResult {
  enum class Status { kTrimmed, kInfeasible, kStalled, kIterationsExhausted, kSimulationFailed };
  Status status = Status::kSimulationFailed;
  std::string message;                  // why it failed, in words; empty when trimmed
  Vector x, w;                          // start of the revolution, all commands
  Vector means;                         // reached, one per target
  Vector periodicity;                   // x(T) - x(0) in units of the scales
  MapScales scales;
  std::string worst_state;              // of the largest periodicity residual
  double worst_periodicity = 0.0;       // in units of the state's magnitude
  double worst_target = 0.0;            // likewise
  long iterations = 0, gradients = 0, revolutions = 0;
  std::vector<double> history;          // norm of the scaled residual before each iteration, and at the end
  double period = 0.0;                  // T [s]
  Matrix monodromy;                     // of the last gradient, when trimmed that of the solution, in units of the scales; may be empty

  bool trimmed() const { return status == Status::kTrimmed; }
};

struct TrimOptions {
  unsigned threads = 0;                 // 0: one per processor; the result does not depend on it
  std::function<void(const std::string&)> progress = {};  // one line per iteration
  const std::atomic<bool>* cancel = nullptr;              // set from another thread: the search ends soon, as kSimulationFailed
};

/// `build` makes a fresh simulation of the configuration, once per thread; `revolution` [s] must be a whole number of its steps
/// (std::invalid_argument otherwise).
TrimResult trim(const std::function<std::unique_ptr<Simulation>()>& build, double revolution, const TrimSettings& settings, const TrimOptions& options = {});

/// Number of steps of h [s] in a revolution. Throws std::invalid_argument when that is not whole (to 1e-9).
long stepsPerRevolution(double revolution, double h);

/// Revolution maps for the threads of a gradient.
MapTeam makeTeam(const std::function<std::unique_ptr<Simulation>()>& build, long steps, const std::vector<Signal>& signals, unsigned threads);

}  // namespace heerk_rotor
