#pragma once
#include <cmath>

namespace heerk_rotor {

// Elementary functions without branches and calls, so that a loop over lanes becomes vector instructions; the C library's
// do not. Inputs that are not finite give results that are not finite.

/// The angle of (x, y) in [-pi, pi], like std::atan2 to 5e-16; 0 for (0, 0).
/// Reduced to |t| <= tan(pi/8); there a minimax polynomial for atan(t)/t in t^2 (12 terms, error 1.3e-18).
inline double arcTangent2(double y, double x) noexcept {
  constexpr double kTanEighth = 0.414213562373095048801688724210;
  const double ax = std::abs(x), ay = std::abs(y);
  const double large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
  const bool upper = small > kTanEighth * large;  // atan(q) = pi/4 + atan((q - 1)/(q + 1))
  const double numerator = upper ? small - large : small;
  const double sum = upper ? small + large : large;
  const double t = numerator / (sum == 0.0 ? 1.0 : sum), z = t * t, z2 = z * z, z4 = z2 * z2;
  const double p0 = 1.0 - 0.3333333333333312 * z + z2 * (0.19999999999940893 - 0.14285714279250245 * z);
  const double p1 = 0.11111110744919656 - 0.09090896809063952 * z + z2 * (0.07692045330900862 - 0.06662951813613517 * z);
  const double p2 = 0.05846878297215434 - 0.05035102456074966 * z + z2 * (0.037965257440323044 - 0.017805397190410625 * z);
  double angle = t * (p0 + z4 * (p1 + z4 * p2)) + (upper ? 0.25 * M_PI : 0.0);
  angle = ay > ax ? 0.5 * M_PI - angle : angle;
  angle = x < 0.0 ? M_PI - angle : angle;
  return std::copysign(angle, y);
}

/// `angle` shifted by whole turns into (-pi, pi].
inline double wrapAngle(double angle) noexcept { return angle - 2.0 * M_PI * std::ceil(angle * (0.5 / M_PI) - 0.5); }

struct SineCosine {
  double sine, cosine;
};

/// Sine and cosine to 2e-16 for |angle| up to 250 000 turns, ten hours at 7 turns per second: reduced to |r| <= pi/4, there Taylor series.
inline SineCosine sineCosine(double angle) noexcept {
  // pi/2 in two parts, the first with 33 bits, so that quarter * kHigh is exact
  constexpr double kHigh = 1.57079632673412561417e+00, kLow = 6.07710050650619224932e-11;
  const double quarter = std::floor(angle * (2.0 / M_PI) + 0.5);
  const double r = (angle - quarter * kHigh) - quarter * kLow, z = r * r, z2 = z * z, z4 = z2 * z2;
  const double s1 = -1.0 / 6 + z * (1.0 / 120) + z2 * (-1.0 / 5040 + z * (1.0 / 362880));
  const double s2 = -1.0 / 39916800 + z * (1.0 / 6227020800.0) - z2 * (1.0 / 1307674368000.0);
  const double c1 = 1.0 / 24 - z * (1.0 / 720) + z2 * (1.0 / 40320 - z * (1.0 / 3628800));
  const double c2 = 1.0 / 479001600.0 - z * (1.0 / 87178291200.0) + z2 * (1.0 / 20922789888000.0);
  const double sine = r + r * z * (s1 + z4 * s2), cosine = 1.0 - z * (0.5 - z * (c1 + z4 * c2));
  const double turn = quarter - 4.0 * std::floor(0.25 * quarter);  // 0, 1, 2, 3
  const bool swapped = turn == 1.0 || turn == 3.0;
  const double s = swapped ? cosine : sine, c = swapped ? sine : cosine;
  return {turn > 1.5 ? -s : s, turn == 1.0 || turn == 2.0 ? -c : c};
}

}  // namespace heerk_rotor
