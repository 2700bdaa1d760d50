#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "implicit_pieces.hpp"
#include "narrow_newmark.hpp"
#include "step_method_kinds.hpp"

namespace heerk_rotor {
namespace {

/// Newmark's method with beta = 1/4, gamma = 1/2 (constant average acceleration), in acceleration form: the unknown of a step is a = f(t + h, x_{n+1}),
///   x_{n+1} = x_n + h/2 (f_n + a).
/// On displacements and rates (q' = v) this is q_{n+1} = q_n + h v_n + h^2/4 (a_n + a_{n+1}), v_{n+1} = v_n + h/2 (a_n + a_{n+1}); states that are no
/// second-order pair take part as in the trapezoidal rule. Unlike the displacement form, which divides differences of displacements by
/// h^2, it keeps its digits at small steps (what Liu & Zhang call accumulation of errors below 1e-7 s).
///
/// Equations: residual p = (I - h/2 S)^-1 (f(x_{n+1}) - a), quasi-Newton with the exact linear part and Broyden's memory for the rest, which is kept
/// from step to step: it begins each one with the linearly implicit prediction and needs one or two corrections more. Ends when a correction of the
/// state is below the tolerance in parts of the state, subsystem by subsystem (2-norms).
class Newmark final : public StepMethod {
 public:
  Newmark(const CoupledSystem& system, double h, double tolerance)
      : h_(h), size_(system.stateSize()), first_(Vector::Zero(size_)), last_(first_), right_(first_), iteration_(size_, tolerance) {
    std::vector<const ImplicitPiece*> pieces;  // one per subsystem
    for (const CoupledSystem::Subsystem& subsystem : system.subsystems()) {
      if (subsystem.x_size > 0) pieces_.push_back({subsystem.x_begin, subsystem.x_size, makeImplicitPiece(subsystem.stiff, 0.5 * h)});
      pieces.push_back(subsystem.x_size > 0 ? pieces_.back().of.get() : nullptr);
    }
    if (system.hasNarrowForms()) narrow_.emplace(system, pieces, 0.5 * h, tolerance);
  }

  std::string name() const override { return "Newmark"; }
  int order() const override { return kNewmarkOrder; }
  int evaluations() const override { return 2; }
  bool exponential() const override { return false; }

  Outcome advance(StageEvaluator& evaluate, double t, const Vector& x, Vector& next) noexcept override {
    if (narrow_) {
      const NarrowNewmark::Outcome outcome = narrow_->advance(evaluate, t, x, next);
      if (outcome == NarrowNewmark::Outcome::kDone) return Outcome::kDone;
      narrow_->forget();
      if (outcome == NarrowNewmark::Outcome::kGivenUp) {
        if (!evaluate.at(t, x, true, first_.data())) return Outcome::kStageFailed;
        return goOn(evaluate, t, x, next);
      }
    }
    evaluate.atStart(true, first_.data());
    return goOn(evaluate, t, x, next);
  }

  std::vector<double> memory() const override {
    std::vector<double> values = iteration_.memory().values();
    if (narrow_) {
      const std::vector<double> more = narrow_->memory();
      values.insert(values.end(), more.begin(), more.end());
    }
    return values;
  }
  void restoreMemory(const std::vector<double>& memory) override {
    if (memory.empty()) {
      iteration_.memory().clear();
      if (narrow_) narrow_->forget();
      return;
    }
    const auto split = memory.begin() + static_cast<std::ptrdiff_t>(std::min(memory.size(), iteration_.memory().values().size()));
    iteration_.memory().restore({memory.begin(), split});
    if (narrow_) narrow_->restoreMemory({split, memory.end()});
    else if (split != memory.end()) throw std::invalid_argument("Newmark's memory: " + std::to_string(memory.size()) + " numbers, expected " + std::to_string(split - memory.begin()));
  }

 private:
  struct Piece {
    Index begin, size;  // states of the subsystem
    std::unique_ptr<ImplicitPiece> of;
  };

  /// From f at the start of the step.
  Outcome goOn(StageEvaluator& evaluate, double t, const Vector& x, Vector& next) noexcept {
    // With J = S + what the memory knows, (I - h/2 J)^-1 (I + h/2 J) f_n = 2 (I - h/2 J)^-1 f_n - f_n.
    solveLinear(first_, last_);
    iteration_.memory().improve(last_.data());
    last_ = 2.0 * last_ - first_;
    const auto residual = [&](const Vector& last, Vector& result) noexcept {
      next = x + 0.5 * h_ * (first_ + last);
      if (!evaluate.at(t + h_, next, true, right_.data())) return false;
      right_ -= last;
      solveLinear(right_, result);
      return true;
    };
    const auto size = [&](const Vector& step) noexcept { return relativeCorrection(x, step); };
    switch (iteration_.solve(last_, residual, size)) {
      case SecantIteration::End::kNoResidual: return Outcome::kStageFailed;
      case SecantIteration::End::kDiverged: return Outcome::kNotConverged;
      case SecantIteration::End::kSolved: break;
    }
    next = x + 0.5 * h_ * (first_ + last_);
    return Outcome::kDone;
  }

  void solveLinear(const Vector& right, Vector& result) const noexcept {
    for (const Piece& piece : pieces_) piece.of->solve(right.data() + piece.begin, result.data() + piece.begin);
  }

  /// Of the state at the end of the step by a change of a; the worst subsystem. One that is (nearly) at rest is measured in a small part of the whole.
  double relativeCorrection(const Vector& x, const Vector& step) const noexcept {
    double worst = 0.0;
    const double floor = kAtRest * (x.norm() + h_ * last_.norm());
    for (const Piece& piece : pieces_) {
      const double correction = 0.5 * h_ * step.segment(piece.begin, piece.size).norm();
      const double magnitude = x.segment(piece.begin, piece.size).norm() + h_ * last_.segment(piece.begin, piece.size).norm();
      if (correction > 0.0) worst = std::max(worst, correction / std::max(magnitude, floor));
    }
    return worst;
  }

  const double h_;
  const Index size_;
  std::vector<Piece> pieces_;  // subsystems with states
  Vector first_, last_;        // f at both ends of the step
  Vector right_;               // f - a
  SecantIteration iteration_;
  std::optional<NarrowNewmark> narrow_;  // of a system that has narrow forms
};

}  // namespace

std::unique_ptr<StepMethod> makeNewmark(const CoupledSystem& system, double h, double tolerance) { return std::make_unique<Newmark>(system, h, tolerance); }

}  // namespace heerk_rotor
