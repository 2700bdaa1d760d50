#include "heerk_rotor/integrate/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace heerk_rotor {
namespace {

/// eps = 0.001 min(1, (h / h_ref)^p) with h_ref = T_rev / 100 (HEERK paper, Section 4.2).
double paperTolerance(const StepOptions& options) {
  const double ratio = options.step / (options.revolution / 100.0);
  return 1e-3 * std::min(1.0, std::pow(ratio, orderOfStepMethod(options.method)));
}

Index firstNonFinite(const double* values, Index size) noexcept {
  // A sum is not finite when a term is not (or, rarely, when it overflows): one pass in registers in the usual case, in sums that need not wait for
  // each other.
  using Lanes = Eigen::Array<double, 4, 1>;
  using Load = Eigen::Map<const Lanes>;
  Lanes sums[4] = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
  double rest = 0.0;
  Index i = 0;
  for (; i + 16 <= size; i += 16)
    for (int k = 0; k < 4; ++k) sums[k] += Load(values + i + 4 * k);
  for (; i + 4 <= size; i += 4) sums[0] += Load(values + i);
#pragma GCC unroll 1
  for (; i < size; ++i) rest += values[i];
  if (std::isfinite(((sums[0] + sums[1]) + (sums[2] + sums[3])).sum() + rest)) return -1;
  for (i = 0; i < size; ++i)
    if (!std::isfinite(values[i])) return i;
  return -1;
}

}  // namespace

Simulation::Simulation(CoupledSystem system, const StepOptions& options) : system_(std::move(system)), options_(options) {
  if (!(options_.step > 0.0) || !std::isfinite(options_.step)) throw std::invalid_argument("Simulation: step " + std::to_string(options_.step) + " s, expected a positive number");
  if (options_.paper_tolerance) {
    if (!(options_.revolution > 0.0)) throw std::invalid_argument("Simulation: the paper's tolerance rule needs the time of one revolution");
    options_.solver.tolerance = paperTolerance(options_);
  }
  x0_ = x_ = system_.initialState();
  if (const Index i = firstNonFinite(x_.data(), x_.size()); i >= 0) throw std::invalid_argument("Simulation: the initial state " + std::to_string(i) + " is not finite");
  next_ = Vector::Zero(x_.size());
  w_ = system_.defaultCommand();
  solver_ = std::make_unique<AlgebraicSolver>(system_, options_.solver, t0_, x_, w_);
  method_ = makeStepMethod(options_.method, system_, options_.step, options_.solver.tolerance);
  initial_cache_ = solver_->cache();
  at_last_instant_ = solver_->counters();
}

Simulation::~Simulation() = default;

bool Simulation::accept(const SolveReport& report, double t) noexcept {
  if (report.status == SolveStatus::kConverged) return true;
  failure_report_ = report;
  status_ = StepStatus::kSolverStalled;
  if (failure_report_.status == SolveStatus::kNonFinite) status_ = StepStatus::kNonFinite;
  failure_time_ = t;
  failure_entry_ = failure_report_.entry;
  failure_in_output_ = true;
  return false;
}

bool Simulation::stateIsFinite(const Vector& x, double t) noexcept {
  const Index i = firstNonFinite(x.data(), x.size());
  if (i < 0) return true;
  status_ = StepStatus::kNonFinite;
  failure_time_ = t;
  failure_entry_ = i;
  failure_in_output_ = false;
  return false;
}

bool Simulation::outputsAreFinite() noexcept {
  const Index i = firstNonFinite(solver_->y().data(), solver_->y().size());
  if (i < 0) return true;
  status_ = StepStatus::kNonFinite;
  failure_time_ = modelTime();
  failure_entry_ = i;
  failure_in_output_ = true;
  return false;
}

void Simulation::removeObserver(Observer& observer) { observers_.erase(std::remove(observers_.begin(), observers_.end(), &observer), observers_.end()); }

void Simulation::atStart(bool complete, double* f) noexcept { system_.evalRemainder(modelTime(), x_, solver_->u(), complete, f); }

bool Simulation::at(double t, const Vector& x, bool complete, double* f) noexcept {
  return stateIsFinite(x, t) && accept(solver_->evalRemainderWithin(t, x, w_, complete, f), t);
}

bool Simulation::atStartNarrow(const Vector& z, double* r) noexcept { return system_.evalStageRemainder(modelTime(), z, solver_->u(), r); }

bool Simulation::atNarrow(double t, const Vector& z, double* r) noexcept {
  return firstNonFinite(z.data(), z.size()) < 0 && solver_->solveStage(t, z, w_).status == SolveStatus::kConverged && system_.evalStageRemainder(t, z, solver_->u(), r);
}

StepStatus Simulation::observe(const Vector& command) noexcept {
  // A failed instant stays failed until reset() or restore(): going on from it would publish what is not a solution.
  if (status_ != StepStatus::kOk) return status_;
  if (!solved_ || std::memcmp(w_.data(), command.data(), static_cast<std::size_t>(w_.size()) * sizeof(double)) != 0) {
    w_ = command;
    if (!accept(solver_->solve(modelTime(), x_, w_), modelTime())) return status_;
    solved_ = true;
  }
  bool observed = false;
  const SolverCounters& counters = solver_->counters();
  for (Observer* observer : observers_) {
    if (!observer->wants(step_)) continue;
    if (!observed) {
      solver_->evalObserved(modelTime(), x_, w_);
      if (!outputsAreFinite()) return status_;
    }
    observed = true;
    observer->observe({step_, epoch_, time(), x_, w_, solver_->y(), counters, counters.newton_iterations - at_last_instant_.newton_iterations,
                       counters.residual_evaluations - at_last_instant_.residual_evaluations});
  }
  return status_;
}

StepStatus Simulation::step(const Vector& command) noexcept {
  if (observe(command) != StepStatus::kOk) return status_;

  at_last_instant_ = solver_->counters();
  const double t = modelTime();
  switch (method_->advance(*this, t, x_, next_)) {
    case StepMethod::Outcome::kDone: break;
    case StepMethod::Outcome::kStageFailed: return status_;
    case StepMethod::Outcome::kNotConverged:
      method_failed_ = true;
      failure_time_ = t;
      return status_ = StepStatus::kSolverStalled;
  }
  if (!stateIsFinite(next_, t + options_.step)) return status_;
  x_.swap(next_);
  ++step_;
  solved_ = false;
  return status_;
}

void Simulation::reset() {
  x_ = x0_;
  w_ = system_.defaultCommand();
  solver_->restoreCache(initial_cache_);
  method_->restoreMemory({});
  t0_ = 0.0;
  step0_ = static_cast<std::int64_t>(step_);
  ++epoch_;
  at_last_instant_ = solver_->counters();
  solved_ = method_failed_ = false;
  status_ = StepStatus::kOk;
}

void Simulation::setState(const Vector& x) {
  if (x.size() != x_.size()) throw std::invalid_argument("Simulation::setState: " + std::to_string(x.size()) + " values, expected " + std::to_string(x_.size()));
  x_ = x;
  method_->restoreMemory({});
  solved_ = method_failed_ = false;
  status_ = StepStatus::kOk;
}

StepFailure Simulation::failure() const {
  StepFailure failure;
  failure.status = status_;
  failure.step = step_;
  failure.t = failure_time_;
  if (status_ == StepStatus::kOk) return failure;
  if (method_failed_) {
    failure.where = method_->name();
    failure.cause = "its equations for the next state did not converge: the step " + std::to_string(options_.step) + " s is too large, or they have no real solution";
    return failure;
  }
  const Signal::Kind kind = failure_in_output_ ? Signal::Kind::kOutput : Signal::Kind::kState;
  for (const Signal& signal : system_.signals())
    if (signal.kind == kind && signal.index == failure_entry_) failure.where = signal.name;
  if (failure.where.empty() && !failure_in_output_)
    for (const CoupledSystem::Subsystem& s : system_.subsystems())
      if (failure_entry_ >= s.x_begin && failure_entry_ < s.x_begin + s.x_size)
        failure.where = s.name + "." + s.model->states()[static_cast<std::size_t>(failure_entry_ - s.x_begin)].name;
  if (status_ == StepStatus::kNonFinite) {
    failure.cause = "the solution grew without bound: the step " + std::to_string(options_.step) + " s is probably too large for " + method_->name() +
                    (method_->exponential() ? " (stiffness that is not in S)" : " (explicit methods need a small step; try HEERK4)") + ", or the system is unstable";
  } else if (failure_report_.status == SolveStatus::kSingular) {
    failure.cause = "I - dg/dy became singular: the coupled system is not index 1 in this state";
  } else {
    failure.cause = "Newton stopped at a correction of " + std::to_string(failure_report_.error) + ": the solution changes too much within one step, or has no real value";
  }
  return failure;
}

std::uint64_t Simulation::stateHash() const {
  std::uint64_t hash = 14695981039346656037ull;  // FNV-1a
  const auto mix = [&hash](const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211ull;
  };
  const double t = modelTime();
  mix(&t, sizeof t);
  mix(x_.data(), static_cast<std::size_t>(x_.size()) * sizeof(double));
  return hash;
}

Simulation::Checkpoint Simulation::checkpoint() const {
  std::vector<double> cache = solver_->cache();
  const std::vector<double> memory = method_->memory();
  cache.insert(cache.end(), memory.begin(), memory.end());
  return {step_, step0_, epoch_, t0_, options_.step, x_, w_, std::move(cache)};
}

void Simulation::restore(const Checkpoint& checkpoint, bool new_epoch) {
  const auto expect = [](const char* what, double found, double expected) {
    if (found != expected) throw std::invalid_argument(std::string("snapshot: ") + what + " is " + std::to_string(found) + ", expected " + std::to_string(expected));
  };
  expect("number of states", static_cast<double>(checkpoint.x.size()), static_cast<double>(x_.size()));
  expect("number of commands", static_cast<double>(checkpoint.w.size()), static_cast<double>(w_.size()));
  expect("step size", checkpoint.h, options_.step);
  if (firstNonFinite(checkpoint.x.data(), checkpoint.x.size()) >= 0) throw std::invalid_argument("snapshot: a state is not finite");
  const std::size_t of_solver = std::min(checkpoint.solver_cache.size(), initial_cache_.size());
  const auto split = checkpoint.solver_cache.begin() + static_cast<std::ptrdiff_t>(of_solver);
  solver_->restoreCache({checkpoint.solver_cache.begin(), split});
  method_->restoreMemory({split, checkpoint.solver_cache.end()});
  x_ = checkpoint.x;
  w_ = checkpoint.w;
  t0_ = checkpoint.t0;
  step0_ = checkpoint.step0;
  if (new_epoch) {
    step0_ += static_cast<std::int64_t>(step_) - static_cast<std::int64_t>(checkpoint.step);
    ++epoch_;
  } else {
    step_ = checkpoint.step;
    epoch_ = checkpoint.epoch;
  }
  at_last_instant_ = solver_->counters();
  solved_ = method_failed_ = false;
  status_ = StepStatus::kOk;
}

}  // namespace heerk_rotor
