#include "heerk_rotor/analysis/revolution_map.hpp"

#include <stdexcept>

namespace heerk_rotor {

/// Sums the signals over the instants t_0 .. t_{N-1}: for a periodic signal the trapezoidal rule, exact but for harmonics
/// of N per revolution.
class RevolutionMap::MeanObserver : public Observer {
 public:
  explicit MeanObserver(const std::vector<Signal>& signals) : signals_(signals), sum_(Vector::Zero(static_cast<Index>(signals.size()))) {}
  void observe(const Sample& sample) noexcept override {
    Index k = 0;
    for (const Signal& signal : signals_) sum_[k++] += signal.kind == Signal::Kind::kState ? sample.x[signal.index] : sample.y[signal.index];
  }
  void clear() { sum_.setZero(); }
  const Vector& sum() const { return sum_; }

 private:
  const std::vector<Signal>& signals_;
  Vector sum_;
};

class RevolutionMap::MagnitudeObserver : public Observer {
 public:
  MagnitudeObserver(Vector& states, Vector& outputs) : states_(states), outputs_(outputs) {}
  void observe(const Sample& sample) noexcept override {
    states_ = states_.cwiseMax(sample.x.cwiseAbs());
    outputs_ = outputs_.cwiseMax(sample.y.cwiseAbs());
  }

 private:
  Vector &states_, &outputs_;
};

RevolutionMap::RevolutionMap(std::unique_ptr<Simulation> simulation, long steps, std::vector<Signal> signals)
    : simulation_(std::move(simulation)), steps_(steps), signals_(std::move(signals)), base_(simulation_->checkpoint()) {
  if (steps_ < 1) throw std::invalid_argument("RevolutionMap: " + std::to_string(steps_) + " steps, expected at least one");
  base_.step = 0;
  base_.step0 = 0;
  base_.t0 = 0.0;
  mean_ = std::make_unique<MeanObserver>(signals_);
}

RevolutionMap::~RevolutionMap() = default;

bool RevolutionMap::run(const Vector& x, const Vector& w, long steps) {
  Simulation::Checkpoint start = base_;
  start.x = x;
  start.w = w;
  simulation_->restore(start);
  revolutions_ += steps / steps_;
  for (long i = 0; i < steps; ++i)
    if ((cancel_ && *cancel_) || simulation_->step(w) != StepStatus::kOk) return false;
  return true;
}

bool RevolutionMap::settle(Vector& x, const Vector& w, long revolutions) {
  if (!run(x, w, revolutions * steps_)) return false;
  x = simulation_->state();
  base_.solver_cache = simulation_->checkpoint().solver_cache;
  return true;
}

bool RevolutionMap::evaluate(const Vector& x, const Vector& w, Vector& end, Vector& means) {
  if (!x.allFinite() || !w.allFinite()) return false;
  mean_->clear();
  if (!signals_.empty()) simulation_->addObserver(*mean_);
  const bool good = run(x, w, steps_);
  simulation_->removeObserver(*mean_);
  end = simulation_->state();
  means = mean_->sum() / static_cast<double>(steps_);
  return good && means.allFinite();
}

bool RevolutionMap::magnitudes(const Vector& x, const Vector& w, Vector& states, Vector& outputs) {
  states = x.cwiseAbs();
  outputs = Vector::Zero(system().outputSize());
  MagnitudeObserver observer(states, outputs);
  simulation_->addObserver(observer);
  const bool good = run(x, w, steps_);
  simulation_->removeObserver(observer);
  return good;
}

}  // namespace heerk_rotor
