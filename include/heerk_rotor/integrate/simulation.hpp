#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"
#include "heerk_rotor/integrate/step_method.hpp"
#include "heerk_rotor/solve/algebraic_solver.hpp"

namespace heerk_rotor {

/// One instant (t_n, x_n, w_n, y_n) as observers see it: state, the command in effect and all outputs agree.
struct Sample {
  std::uint64_t step;
  std::uint32_t epoch;   // increments with every reset and every loaded snapshot
  double t;              // simulation time: goes on over resets and loaded snapshots [s]
  const Vector& x;
  const Vector& w;
  const Vector& y;
  const SolverCounters& counters;       // since construction
  std::uint64_t newton_iterations;      // spent since the previous instant: the rest of its step and this instant's outputs
  std::uint64_t residual_evaluations;
};

class Observer {
 public:
  virtual ~Observer() = default;
  virtual bool wants(std::uint64_t /*step*/) const noexcept { return true; }
  /// Runs on the stepping thread: must not block, allocate or throw where real time matters.
  virtual void observe(const Sample& sample) noexcept = 0;
};

enum class StepStatus { kOk, kSolverStalled, kNonFinite };

/// Why a step failed, enough for one clear message.
struct StepFailure {
  StepStatus status = StepStatus::kOk;
  std::uint64_t step = 0;
  double t = 0.0;
  std::string where;    // state or output entry by name
  std::string cause;    // likely cause, in words
};

struct StepOptions {
  double step = 1e-3;                // h [s]
  std::string method = "HEERK4";     // see stepMethodNames()
  bool paper_tolerance = false;      // eps = 0.001 min(1, (h/h_ref)^p), h_ref = T_rev / 100 (paper, Section 4.2)
  double revolution = 0.0;           // T_rev [s]; needed with paper_tolerance
  SolverOptions solver;              // its tolerance also ends the iteration of implicit methods
};

/// Advances the coupled system by fixed steps of an integration method, t = t0 + step * h. A step begins at t_n: the command is latched,
/// the outputs are solved, observers see the instant, then the method goes on from there.
class Simulation : private StageEvaluator {
 public:
  Simulation(CoupledSystem system, const StepOptions& options);
  ~Simulation() override;

  void addObserver(Observer& observer) { observers_.push_back(&observer); }
  void removeObserver(Observer& observer);

  /// One step with the command w (size commandSize(); finite). On failure the state stays at the last good instant.
  StepStatus step(const Vector& command) noexcept;

  /// Solves and shows the present instant to the observers without stepping (the last row of a record).
  StepStatus observe(const Vector& command) noexcept;

  /// Back to the initial state; step number and simulation time go on, the model time restarts, the epoch increments.
  void reset();

  const CoupledSystem& system() const { return system_; }
  const AlgebraicSolver& solver() const { return *solver_; }
  const StepMethod& method() const { return *method_; }
  const StepOptions& options() const { return options_; }
  std::uint64_t stepCount() const { return step_; }
  std::uint32_t epoch() const { return epoch_; }
  double stepSize() const { return options_.step; }
  /// Simulation time, step * h: never goes back [s].
  double time() const { return static_cast<double>(step_) * options_.step; }
  /// Time t of f(t, x, u): restarts with reset(), continues with a loaded snapshot [s].
  double modelTime() const { return t0_ + static_cast<double>(static_cast<std::int64_t>(step_) - step0_) * options_.step; }
  const Vector& state() const { return x_; }

  /// Replaces the state (sizes must agree); the next step starts from it.
  void setState(const Vector& x);

  /// What went wrong in the last failed step; builds strings, call outside the real-time path.
  StepFailure failure() const;

  /// 64-bit hash of model time and state, bit by bit.
  std::uint64_t stateHash() const;

  /// Time base, state, last command and solver cache; see snapshot.hpp for the file.
  struct Checkpoint {
    std::uint64_t step = 0;
    std::int64_t step0 = 0;  // model time = t0 + (step - step0) h
    std::uint32_t epoch = 0;
    double t0 = 0.0, h = 0.0;
    Vector x, w;
    std::vector<double> solver_cache;  // of the algebraic solver, then what the method keeps
  };
  Checkpoint checkpoint() const;
  /// Throws std::invalid_argument when the sizes or the step differ. With new_epoch the epoch increments instead of
  /// taking the checkpoint's, and step and simulation time go on (the node's ~load_snapshot).
  void restore(const Checkpoint& checkpoint, bool new_epoch = false);

 private:
  bool accept(const SolveReport& report, double t) noexcept;
  bool stateIsFinite(const Vector& x, double t) noexcept;
  bool outputsAreFinite() noexcept;
  void atStart(bool complete, double* f) noexcept override;
  bool at(double t, const Vector& x, bool complete, double* f) noexcept override;
  bool atStartNarrow(const Vector& z, double* r) noexcept override;
  bool atNarrow(double t, const Vector& z, double* r) noexcept override;

  CoupledSystem system_;
  StepOptions options_;
  std::unique_ptr<AlgebraicSolver> solver_;
  std::unique_ptr<StepMethod> method_;
  std::vector<Observer*> observers_;
  std::uint64_t step_ = 0;
  std::int64_t step0_ = 0;
  std::uint32_t epoch_ = 0;
  double t0_ = 0.0;
  Vector x0_, x_, next_, w_;
  std::vector<double> initial_cache_;
  SolverCounters at_last_instant_;                               // what the solver had spent when the last step left its first stage
  bool solved_ = false;                                          // outputs at t_n with w_ are up to date
  StepStatus status_ = StepStatus::kOk;
  double failure_time_ = 0.0;
  Index failure_entry_ = -1;
  bool failure_in_output_ = false;
  bool method_failed_ = false;                                   // the method's own equations had no solution
  SolveReport failure_report_;
};

}  // namespace heerk_rotor
