#pragma once
#include <vector>

#include "heerk_rotor/integrate/step_method.hpp"
#include "heerk_rotor/solve/start_values.hpp"
#include "implicit_pieces.hpp"
#include "narrow_stages.hpp"
#include "secant_iteration.hpp"

namespace heerk_rotor {

/// A step of Newmark's method on a system with narrow forms. With f~ = B r(t, z), z = C x and a = h/2, eliminating x_{n+1} leaves
///   z_{n+1} = C P x_n + C Q (r_n + r_{n+1}),   x_{n+1} = P x_n + Q (r_n + r_{n+1}),
///   P = (I - a S)^-1 (I + a S) = 2 (I - a S)^-1 - I,   Q = a (I - a S)^-1 B,
/// so the unknowns are the few r_{n+1} (a subsystem without narrow form has z = x and B = I). They start from a parabola through the last three r.
class NarrowNewmark {
 public:
  /// pieces: (I - a S)^-1 of each subsystem, null where it has no states; they must outlive this.
  NarrowNewmark(const CoupledSystem& system, const std::vector<const ImplicitPiece*>& pieces, double a, double tolerance);

  enum class Outcome {
    kDone,
    kNotStarted,  // no narrow form here and now
    kGivenUp      // none later in the step, or no solution found: outputs at t_n are no longer known
  };
  Outcome advance(StageEvaluator& evaluate, double t, const Vector& x, Vector& next) noexcept;

  /// The next step begins without what earlier ones left.
  void forget() noexcept;
  std::vector<double> memory() const;
  /// Throws std::invalid_argument when the number of values is wrong.
  void restoreMemory(const std::vector<double>& memory);

 private:
  struct Part {
    const ImplicitPiece* piece;
    bool narrow;
    Index x_begin, x_size, z_begin, z_size, r_begin, r_size;
    ColumnSum start;     // of x: rows of C, then of C P
    ColumnSum implicit;  // C Q of r
    ColumnSum last;      // Q of r
    Matrix square;       // Q' Q
    Vector start_z;
  };

  void begin(const Vector& x) noexcept;
  void addImplicit(const double* r, const double* base, double* z) noexcept;
  double normOfChange(const Part& part, const Vector& r) noexcept;
  double relativeCorrection(const Vector& step) noexcept;
  void finish(const Vector& x, Vector& next) noexcept;

  const double a_;
  std::vector<Part> parts_;
  std::vector<double> x_norms_;      // of the parts at t_n
  Vector z_, free_z_;                // z as it is asked for; what x_n and r_n decide of z_{n+1}
  Vector start_r_, end_r_, sum_;     // r_n, r_{n+1}, their sum
  StartValues start_;                // of r_{n+1}
  Vector scratch_;                   // (largest part)
  SecantIteration iteration_;
};

}  // namespace heerk_rotor
