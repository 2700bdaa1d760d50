#include <vector>

#include "precise_pieces.hpp"

namespace heerk_rotor {
namespace {

/// The one-step block precise integration method (Liu & Zhang, eq. 9-13): Duhamel's integral by Clenshaw-Curtis quadrature with four nodes, the
/// states at the inner nodes predicted by the classical Runge-Kutta method in one step from t_k,
///   v_{k+1} = e^{H dt} v_k + dt sum_i w_i e^{(1 - c_i) H dt} r(t_k + c_i dt, v~_i),  H = S, r = f~.
/// Order 4 (the text says 3). The predictor is explicit: what it cannot follow, the method cannot integrate, however exact its exponential.
/// precise_1 and precise_2 do the same sums on different blocks and agree to round-off. In eq. 13 S_1 does not depend on i, so that a step takes 13 evaluations.
class PreciseIntegration final : public StepMethod {
 public:
  PreciseIntegration(PreciseVariant variant, const CoupledSystem& system, double h)
      : variant_(variant), h_(h), size_(system.stateSize()), stage_(Vector::Zero(size_)), slope_(Vector::Zero(size_)), first_(Vector::Zero(size_)), sum_(Vector::Zero(size_)),
        remainders_(Vector::Zero(4 * size_)) {
    for (const CoupledSystem::Subsystem& subsystem : system.subsystems())
      if (subsystem.x_size > 0) pieces_.push_back({subsystem.x_begin, makePrecisePiece(variant, subsystem.stiff, h)});
  }

  std::string name() const override { return variant_ == PreciseVariant::kDense ? "precise_1" : "precise_2"; }
  int order() const override { return kPreciseOrder; }
  int evaluations() const override { return 13; }
  bool exponential() const override { return false; }  // its predictor is not

  Outcome advance(StageEvaluator& evaluate, double t, const Vector& x, Vector& next) noexcept override {
    evaluate.atStart(false, remainders_.data());
    complete(x, remainders_.data(), first_);
    for (std::size_t i = 1; i < 4; ++i) {
      // Predict at the node: S_2, S_3, S_4 of the classical method over c_i dt.
      const double step = kPreciseNode[i] * h_;
      sum_ = first_;
      stage_ = x + 0.5 * step * first_;
      if (!slope(evaluate, t + 0.5 * step)) return Outcome::kStageFailed;
      sum_ += 2.0 * slope_;
      stage_ = x + 0.5 * step * slope_;
      if (!slope(evaluate, t + 0.5 * step)) return Outcome::kStageFailed;
      sum_ += 2.0 * slope_;
      stage_ = x + step * slope_;
      if (!slope(evaluate, t + step)) return Outcome::kStageFailed;
      stage_ = x + (step / 6.0) * (sum_ + slope_);
      if (!evaluate.at(t + step, stage_, false, remainders_.data() + static_cast<Index>(i) * size_)) return Outcome::kStageFailed;
    }
    for (const Piece& piece : pieces_) piece.of->combine(x.data() + piece.begin, remainders_.data() + piece.begin, size_, next.data() + piece.begin);
    return Outcome::kDone;
  }

 private:
  struct Piece {
    Index begin;  // first state of the subsystem
    std::unique_ptr<PrecisePiece> of;
  };

  /// slope_ = S v + r at (t, stage_).
  bool slope(StageEvaluator& evaluate, double t) noexcept {
    if (!evaluate.at(t, stage_, false, slope_.data())) return false;
    complete(stage_, slope_.data(), slope_);
    return true;
  }

  void complete(const Vector& x, const double* r, Vector& f) const noexcept {
    for (const Piece& piece : pieces_) piece.of->complete(x.data() + piece.begin, r + piece.begin, f.data() + piece.begin);
  }

  const PreciseVariant variant_;
  const double h_;
  const Index size_;
  std::vector<Piece> pieces_;       // subsystems with states
  Vector stage_, slope_, first_, sum_;
  Vector remainders_;  // (4 x state size), one row per node; aligned by Eigen, see types.hpp
};

}  // namespace

std::unique_ptr<StepMethod> makePreciseIntegration(PreciseVariant variant, const CoupledSystem& system, double h) {
  return std::make_unique<PreciseIntegration>(variant, system, h);
}

}  // namespace heerk_rotor
