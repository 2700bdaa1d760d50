#pragma once
#include <cmath>
#include <limits>

#include "heerk_rotor/solve/secant_memory.hpp"

namespace heerk_rotor {

/// Part of the whole state in which corrections of a subsystem (nearly) at rest are measured.
inline constexpr double kAtRest = 1e-3;

/// Solves r(a) = 0 for residuals that are a change away from -a: Newton's method with H = I and what earlier steps taught (SecantMemory), which
/// is kept from solve to solve. Ends when a correction is below the tolerance in the caller's measure.
class SecantIteration {
 public:
  SecantIteration(Index unknowns, double tolerance) : tolerance_(tolerance), raw_(Vector::Zero(unknowns)), left_(raw_), step_(raw_), memory_(unknowns) {}

  enum class End { kSolved, kNoResidual, kDiverged };

  /// residual(a, r) writes r at a, false when it has none there; size(correction) is relative. a: start value, then the solution.
  template <class Residual, class Size>
  End solve(Vector& a, Residual&& residual, Size&& size) noexcept {
    bool taken = false;       // step_ has been applied in this solve
    bool forgotten = false;   // the memory was cleared in this solve
    double first_norm = 0.0;  // of the corrections
    double correction = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      if (!residual(a, raw_)) return End::kNoResidual;
      left_ = raw_;
      memory_.improve(left_.data());
      // Rounding in f, which loops of the system may amplify, can keep corrections above a very small tolerance: there they stop shrinking.
      const double before = correction;
      correction = size(left_);
      if (taken && correction > tolerance_ && before > kWorthLearning) {  // nothing to learn from what has converged
        memory_.learn(step_.data(), raw_.data(), left_.data());
        correction = size(left_);
      }
      step_ = left_;
      taken = true;
      if (correction > before && before > kNoise * tolerance_ && !forgotten) {  // misled by what earlier steps taught: once, on from here without it
        memory_.clear();
        step_ = raw_;
        correction = std::numeric_limits<double>::infinity();
        taken = false;
        forgotten = true;
      }
      const double norm = step_.norm();
      if (iteration == 0) first_norm = norm;
      if (!(norm <= kDiverged * first_norm)) break;
      a += step_;
      if (correction <= tolerance_ || (correction >= before && correction <= kNoise * tolerance_)) return End::kSolved;
    }
    memory_.clear();
    return End::kDiverged;
  }

  SecantMemory& memory() { return memory_; }
  const SecantMemory& memory() const { return memory_; }

 private:
  static constexpr int kMaxIterations = 50;       // a good step takes two or three
  static constexpr double kDiverged = 1e3;        // growth of the corrections
  static constexpr double kWorthLearning = 1e-9;  // relative correction; what smaller ones change is mostly rounding
  static constexpr double kNoise = 1e3;           // tolerances: corrections that do not shrink any more may be so large

  double tolerance_;
  Vector raw_, left_, step_;
  SecantMemory memory_;
};

}  // namespace heerk_rotor
