#include <optional>
#include <vector>

#include "heerk_rotor/integrate/linear_propagator.hpp"
#include "narrow_stages.hpp"
#include "step_method_kinds.hpp"

namespace heerk_rotor {
namespace {

/// A half-explicit exponential Runge-Kutta method (HEERK paper, eq. 6), given by its tableau:
///   X_i = e^{c_i hS} x_n + h sum_j a_ij(hS) f~(t_n + c_j h, X_j, Y_j),  g(t_n + c_i h, X_i, Y_i) = Y_i.
class ExponentialRungeKutta final : public StepMethod {
 public:
  ExponentialRungeKutta(const Tableau& tableau, const CoupledSystem& system, double h)
      : tableau_(tableau), h_(h), size_(system.stateSize()), stage_(Vector::Zero(size_)), remainders_(Vector::Zero(tableau.stages() * size_)) {
    std::vector<const LinearPropagator*> propagators;  // one per subsystem
    for (const CoupledSystem::Subsystem& subsystem : system.subsystems()) {
      if (subsystem.x_size > 0) pieces_.push_back({subsystem.x_begin, makePropagator(subsystem.stiff, h, tableau)});
      propagators.push_back(subsystem.x_size > 0 ? pieces_.back().propagator.get() : nullptr);
    }
    if (tableau.exponential && system.hasNarrowForms()) narrow_.emplace(system, tableau, propagators);
  }

  std::string name() const override { return tableau_.name; }
  int order() const override { return tableau_.order; }
  int evaluations() const override { return tableau_.stages(); }
  bool exponential() const override { return tableau_.exponential; }

  Outcome advance(StageEvaluator& evaluate, double t, const Vector& x, Vector& next) noexcept override {
    const bool complete = !tableau_.exponential;
    if (!narrow_ || !startNarrow(evaluate, x)) {
      evaluate.atStart(complete, remainders_.data());
    } else {
      if (goOnNarrow(evaluate, t, x, next)) return Outcome::kDone;
      if (!evaluate.at(t, x, complete, remainders_.data())) return Outcome::kStageFailed;  // the outputs at the start are gone
    }
    for (int i = 1; i < tableau_.stages(); ++i) {
      combine(i, x, stage_);
      if (!evaluate.at(t + tableau_.c[static_cast<std::size_t>(i)] * h_, stage_, complete, remainders_.data() + i * size_)) return Outcome::kStageFailed;
    }
    combine(tableau_.stages(), x, next);
    return Outcome::kDone;
  }

 private:
  struct Piece {
    Index begin;  // first state of the subsystem
    std::unique_ptr<LinearPropagator> propagator;
  };

  bool startNarrow(StageEvaluator& evaluate, const Vector& x) noexcept {
    narrow_->begin(x);
    return evaluate.atStartNarrow(narrow_->stage(0), narrow_->remainder(0));
  }

  bool goOnNarrow(StageEvaluator& evaluate, double t, const Vector& x, Vector& next) noexcept {
    for (int i = 1; i < tableau_.stages(); ++i)
      if (!evaluate.atNarrow(t + tableau_.c[static_cast<std::size_t>(i)] * h_, narrow_->stage(i), narrow_->remainder(i))) return false;
    narrow_->finish(x, next);
    return true;
  }

  void combine(int row, const Vector& x, Vector& result) const noexcept {
    for (const Piece& piece : pieces_) piece.propagator->combine(row, x.data() + piece.begin, remainders_.data() + piece.begin, size_, result.data() + piece.begin);
  }

  const Tableau& tableau_;
  const double h_;
  const Index size_;
  std::vector<Piece> pieces_;         // subsystems with states
  Vector stage_;
  Vector remainders_;                 // (stages x state size), one row per stage; aligned by Eigen, see types.hpp
  std::optional<NarrowStages> narrow_;  // of a system that has narrow forms
};

}  // namespace

std::unique_ptr<StepMethod> makeExponentialRungeKutta(const Tableau& tableau, const CoupledSystem& system, double h) {
  return std::make_unique<ExponentialRungeKutta>(tableau, system, h);
}

}  // namespace heerk_rotor
