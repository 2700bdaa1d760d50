#pragma once
#include <atomic>
#include <memory>
#include <vector>

#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// The step map carried over one revolution as a function of its start: (x(0), w) -> x(T) and the means of chosen signals.
/// Every evaluation begins at model time 0 with the same solver cache, so that the result depends on x(0) and w only and not
/// on what was evaluated before or on which thread. Between evaluations the simulation must not be used otherwise.
class RevolutionMap {
 public:
  /// `steps` of the simulation's step size make up the revolution T.
  RevolutionMap(std::unique_ptr<Simulation> simulation, long steps, std::vector<Signal> signals);
  ~RevolutionMap();

  /// Plain running for `revolutions` from x, which is replaced by the end. False when a step failed.
  bool settle(Vector& x, const Vector& w, long revolutions);

  /// False when a step failed; end (n) and means (signals) are then meaningless.
  bool evaluate(const Vector& x, const Vector& w, Vector& end, Vector& means);

  /// Largest |x_i| and |y_i| over the revolution from x.
  bool magnitudes(const Vector& x, const Vector& w, Vector& states, Vector& outputs);

  /// The instant all evaluations begin from, apart from x and w.
  const Simulation::Checkpoint& base() const { return base_; }
  void setBase(const Simulation::Checkpoint& base) { base_ = base; }

  /// All runs end early, as failed, once this becomes true.
  void setCancel(const std::atomic<bool>* cancel) { cancel_ = cancel; }

  const Simulation& simulation() const { return *simulation_; }
  const CoupledSystem& system() const { return simulation_->system(); }
  const std::vector<Signal>& signals() const { return signals_; }
  long steps() const { return steps_; }
  double period() const { return static_cast<double>(steps_) * simulation_->stepSize(); }
  long revolutions() const { return revolutions_; }  // simulated so far

 private:
  class MeanObserver;
  class MagnitudeObserver;
  bool run(const Vector& x, const Vector& w, long steps);

  std::unique_ptr<Simulation> simulation_;
  long steps_;
  std::vector<Signal> signals_;
  Simulation::Checkpoint base_;
  std::unique_ptr<MeanObserver> mean_;
  long revolutions_ = 0;
  const std::atomic<bool>* cancel_ = nullptr;
};

}  // namespace heerk_rotor
