#pragma once
#include <cmath>

namespace heerk_rotor {

/// 0 below `begin`, 1 above `end`, twice continuously differentiable between (quintic); 1/2 in the middle.
inline double smoothStep(double x, double begin, double end) noexcept {
  const double s = x <= begin ? 0.0 : x >= end ? 1.0 : (x - begin) / (end - begin);
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

/// Factor on the lift for the tip-loss factor B: no lift outside r = B R; profile drag stays. The step is spread over 1 % of R
/// around B, so that loads change smoothly with B and with the position of a section. r: r/R. B >= 1 is no tip loss.
inline double tipLossFactor(double r, double B) noexcept { return B >= 1.0 ? 1.0 : 1.0 - smoothStep(r, B - 0.005, B + 0.005); }

/// Mean of tipLossFactor over a segment, so that a few wide sections lose as much lift as many narrow ones. inner < outer: r/R.
inline double meanTipLossFactor(double inner, double outer, double B) noexcept {
  if (B >= 1.0) return 1.0;
  const auto integral = [B](double x) {  // of the smooth step from far inside to x
    const double s = (x - (B - 0.005)) / 0.01;
    if (s <= 0.0) return 0.0;
    if (s >= 1.0) return 0.005 + (x - (B + 0.005));
    return 0.01 * s * s * s * s * (2.5 + s * (s - 3.0));
  };
  return 1.0 - (integral(outer) - integral(inner)) / (outer - inner);
}

/// Factor on all loads: none inside the root cut-out, likewise spread over 1 % of R. r, cutout: parts of R; 0 is no cut-out.
inline double rootCutoutFactor(double r, double cutout) noexcept { return cutout <= 0.0 ? 1.0 : smoothStep(r, cutout - 0.005, cutout + 0.005); }

/// Prandtl's factor F = 2/pi acos exp(-N_b/2 (1 - r)/(r |sin phi|)) on the induced flow of momentum theory.
/// r: r/R; inflow_angle: phi [rad]. 1 in the limit phi -> 0, 0 at the tip.
inline double prandtlTipLoss(int blades, double r, double inflow_angle) noexcept {
  const double sine = std::abs(std::sin(inflow_angle));
  if (r >= 1.0) return 0.0;
  if (sine == 0.0 || r <= 0.0) return 1.0;
  return 2.0 / M_PI * std::acos(std::exp(-0.5 * blades * (1.0 - r) / (r * sine)));
}

}  // namespace heerk_rotor
