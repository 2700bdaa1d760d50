#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "problem.hpp"

namespace heerk_rotor::work_precision {

/// CPU time of the process [s].
double cpuSeconds();

/// Right-hand sides fail from this CPU time on, so that a run that creeps ends; infinite at first.
extern double cpu_deadline;

/// One method with one setting on one problem, ready to run. Everything that a user would do once is done at construction.
class Integration {
 public:
  virtual ~Integration() = default;
  /// From the start to the end; states() then holds the solution at the problem's instants. May be called again. False: failed on the way.
  virtual bool run() = 0;
  const Matrix& states() const { return states_; }   // (n x instants)
  long steps() const { return steps_; }              // of the last run
  long evaluations() const { return evaluations_; }  // of the right-hand side with its algebraic part, those for Jacobians included

 protected:
  Matrix states_;
  long steps_ = 0, evaluations_ = 0;
};

/// A curve of the comparison: one method with one setting, from loose to tight.
struct Family {
  std::string method;                       // HEERK4, CVODE BDF, ...
  std::string setting;                      // what else was chosen; the best setting of a method counts
  std::vector<double> parameters;           // step [s] or tolerance, loose to tight
  std::function<std::unique_ptr<Integration>(double)> make;
  Problem::Overrides overrides = {};        // of the system that it solves
  bool truncated = false;                   // solves a system that is not the problem's
};

/// Steps [s] that divide the distance of the problem's instants, large to small.
std::vector<double> dividingSteps(const Problem& problem, bool quick);
/// Relative tolerances, loose to tight.
std::vector<double> tolerances(bool quick);

/// The curves of each kind of method for a problem; empty where a library is missing or a method does not apply.
/// scale: magnitude of each state of the unchanged system, for absolute tolerances.
std::vector<Family> ownMethods(const Problem& problem, bool quick);
std::vector<Family> generalizedAlpha(const Problem& problem, bool quick);
std::vector<Family> odeintPeers(const Problem& problem, const Vector& scale, bool quick);
std::vector<Family> cvodePeers(const Problem& problem, const Vector& scale, bool quick);
std::vector<Family> arkodePeers(const Problem& problem, const Vector& scale, bool quick);
std::vector<Family> idaPeers(const Problem& problem, const Vector& scale, bool quick);

/// The solution to compare with: `main` and a check by code that shares no step with it.
struct ReferenceMethods {
  std::string main_name, check_name;
  std::unique_ptr<Integration> main, check;
};
ReferenceMethods referenceMethods(const Problem& problem, const Vector& scale);
/// Explicit Runge-Kutta of order 8 with tolerance 1e-13 (ARKODE), stopping at every instant; nullptr without SUNDIALS.
std::unique_ptr<Integration> tightExplicit(const Problem& problem, const Vector& scale);
/// A method of ours by name.
std::unique_ptr<Integration> ownMethod(const Problem& problem, const std::string& name, double step, const Problem::Overrides& overrides, double newton_tolerance);

/// Magnitude of each state for tolerances: largest value over start and `states` of all states that have the same unit.
Vector stateScale(const Problem& problem, const Matrix& states);

}  // namespace heerk_rotor::work_precision
