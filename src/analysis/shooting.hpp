#pragma once
#include <string>
#include <vector>

#include <Eigen/QR>

#include "heerk_rotor/analysis/trim.hpp"

namespace heerk_rotor {

/// Newton's method of trim(): unknowns z = (all states, chosen controls) in units of their scales, residual
/// r = (x(T) - x(0), mean - target) in units of theirs.
class Shooting {
 public:
  Shooting(MapTeam& maps, const TrimSettings& settings, const TrimOptions& options, TrimResult& result);

  /// Solves; fills the result's status, motion and counts.
  void solve();

 private:
  struct Step {
    Vector z;               // in units of the scales (n + controls)
    double predicted = 0.0; // norm of the residual that the linear model leaves
  };
  struct Point {
    Vector x, w, residual, means;
  };

  bool evaluate(Point& point);
  bool refreshGradient(const Point& at);
  void iterate(Point& point, bool controls_free);
  Step newtonStep(const Point& at, const std::vector<char>& fixed, Vector control_step) const;
  Step limitedStep(const Point& at, bool controls_free) const;
  bool accept(Point& point, const Step& step);
  /// Norm that must fall from step to step: residuals in units of the motion's scale, where curvature does not yet count.
  double merit(const Point& point) const;
  bool converged(const Point& point) const;
  std::string limits(const Point& point) const;
  void conclude(const Point& point, TrimResult::Status status, const std::string& message);
  double low(std::size_t control) const;   // [scale of the control]
  double high(std::size_t control) const;

  MapTeam& maps_;
  const TrimSettings& settings_;
  const TrimOptions& options_;
  TrimResult& result_;
  Index n_, c_, m_;              // states, controls, targets
  bool with_targets_ = true;
  Matrix jacobian_;              // (n + m) x (n + c), dr/dz
  Vector weights_;               // (n + m) from residual to merit
  bool fresh_ = false;           // jacobian_ belongs to the present point
  bool stalled_ = false;
  mutable Eigen::CompleteOrthogonalDecomposition<Matrix> factors_;
  mutable std::vector<char> factors_fixed_;  // controls for which factors_ is made
  mutable bool factorized_ = false;
};

}  // namespace heerk_rotor
