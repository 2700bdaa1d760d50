#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "implicit_pieces.hpp"
#include "secant_memory.hpp"
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
      : h_(h), tolerance_(tolerance), size_(system.stateSize()), first_(Vector::Zero(size_)), last_(first_), residual_(first_), step_(first_), before_(first_), secants_(size_) {
    for (const CoupledSystem::Subsystem& subsystem : system.subsystems())
      if (subsystem.x_size > 0) pieces_.push_back({subsystem.x_begin, subsystem.x_size, makeImplicitPiece(subsystem.stiff, 0.5 * h)});
  }

  std::string name() const override { return "Newmark"; }
  int order() const override { return kNewmarkOrder; }
  int evaluations() const override { return 2; }
  bool exponential() const override { return false; }

  Outcome advance(StageEvaluator& evaluate, double t, const Vector& x, Vector& next) noexcept override {
    evaluate.atStart(true, first_.data());
    // With J = S + what the memory knows, (I - h/2 J)^-1 (I + h/2 J) f_n = 2 (I - h/2 J)^-1 f_n - f_n.
    solveLinear(first_, last_);
    secants_.improve(last_);
    last_ = 2.0 * last_ - first_;
    bool taken = false;      // step_ has been applied in this step
    bool forgotten = false;  // the memory was cleared in this step
    double first_size = 0.0;  // of the corrections
    double correction = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      next = x + 0.5 * h_ * (first_ + last_);
      if (!evaluate.at(t + h_, next, true, before_.data())) return Outcome::kStageFailed;
      before_ -= last_;
      solveLinear(before_, residual_);
      secants_.improve(residual_);
      if (taken && correction > kWorthLearning) {
        secants_.learn(step_, residual_);
        // H has changed: H_new p = left + a (b' p), and b' p = s' H p = s' left.
        const double square = step_.squaredNorm(), along = step_.dot(residual_);
        if (std::abs(square - along) > 1e-3 * square) residual_ *= 1.0 + along / (square - along);
      }
      step_ = residual_;
      taken = true;
      // Rounding in f, which loops of the system may amplify, can keep corrections above a very small tolerance: there they stop shrinking.
      const double before = correction;
      correction = relativeCorrection(x);
      if (correction > before && before > kNoise * tolerance_ && !forgotten) {  // misled by what earlier steps taught: once, on from here with S alone
        secants_.clear();
        solveLinear(before_, step_);
        correction = std::numeric_limits<double>::infinity();
        taken = false;
        forgotten = true;
      }
      const double size = step_.norm();
      if (iteration == 0) first_size = size;
      if (!(size <= kDiverged * first_size)) break;
      last_ += step_;
      if (correction <= tolerance_ || (correction >= before && correction <= kNoise * tolerance_)) {
        next = x + 0.5 * h_ * (first_ + last_);
        return Outcome::kDone;
      }
    }
    secants_.clear();
    return Outcome::kNotConverged;
  }

  std::vector<double> memory() const override { return secants_.values(); }
  void restoreMemory(const std::vector<double>& memory) override {
    if (memory.empty()) secants_.clear();
    else secants_.restore(memory);
  }

 private:
  static constexpr int kMaxIterations = 50;  // a good step takes two or three
  static constexpr double kSmall = 1e-3;
  static constexpr double kDiverged = 1e3;        // growth of the corrections
  static constexpr double kWorthLearning = 1e-9;  // relative correction; what smaller ones change is mostly rounding
  static constexpr double kNoise = 1e3;      // tolerances: corrections that do not shrink any more may be so large
  struct Piece {
    Index begin, size;  // states of the subsystem
    std::unique_ptr<ImplicitPiece> of;
  };

  void solveLinear(const Vector& right, Vector& result) const noexcept {
    for (const Piece& piece : pieces_) piece.of->solve(right.data() + piece.begin, result.data() + piece.begin);
  }

  /// Of the state at the end of the step by step_; the worst subsystem. One that is (nearly) at rest is measured in a small part of the whole.
  double relativeCorrection(const Vector& x) const noexcept {
    double worst = 0.0;
    const double floor = kSmall * (x.norm() + h_ * last_.norm());
    for (const Piece& piece : pieces_) {
      const double correction = 0.5 * h_ * step_.segment(piece.begin, piece.size).norm();
      const double magnitude = x.segment(piece.begin, piece.size).norm() + h_ * last_.segment(piece.begin, piece.size).norm();
      if (correction > 0.0) worst = std::max(worst, correction / std::max(magnitude, floor));
    }
    return worst;
  }

  const double h_, tolerance_;
  const Index size_;
  std::vector<Piece> pieces_;  // subsystems with states
  Vector first_, last_;        // f at both ends of the step
  Vector residual_, step_, before_;
  SecantMemory secants_;
};

}  // namespace

std::unique_ptr<StepMethod> makeNewmark(const CoupledSystem& system, double h, double tolerance) { return std::make_unique<Newmark>(system, h, tolerance); }

}  // namespace heerk_rotor
