#pragma once
#include <stdexcept>
#include <vector>

namespace heerk_rotor {

/// Independent solution: uniform rotating beam of unit mass and stiffness on root..1, by power series around the root.
///   w'''' - eta^2 (t w')' = lambda w,   t = (1 - r^2) / 2 + tip_mass,   lambda = omega^2 (flap) or omega^2 + eta^2 (in plane)
/// root: w = w' = 0 (clamped) or w = w'' = 0 (hinged); tip: w'' = 0, w''' - eta^2 tip_mass w' + tip_mass lambda w = 0.
/// Shares no code with the finite elements.
struct FrobeniusBeam {
  long double eta = 0, root = 0, tip_mass = 0;
  bool hinged = false;

  /// Zero when lambda is an eigenvalue.
  long double determinant(long double lambda) const {
    constexpr int kTerms = 120;  // |lambda| < 2e4: terms fall below 1e-25 after 60
    const long double length = 1 - root;
    const long double t0 = (1 - root * root) / 2 + tip_mass, t1 = -root, t2 = -0.5L;
    long double second[2], shear[2];
    for (int solution = 0; solution < 2; ++solution) {
      std::vector<long double> a(kTerms, 0.0L);
      a[solution == 1 ? 3 : (hinged ? 1 : 2)] = 1;
      for (int k = 0; k + 4 < kTerms; ++k) {
        const long double tension = (k + 1) * (t0 * (k + 2) * a[k + 2] + t1 * (k + 1) * a[k + 1] + t2 * k * a[k]);
        a[k + 4] = (eta * eta * tension + lambda * a[k]) / (static_cast<long double>(k + 4) * (k + 3) * (k + 2) * (k + 1));
      }
      long double d[4] = {0, 0, 0, 0}, power = 1;  // w, w', w'', w''' at the tip
      for (int k = 0; k < kTerms; ++k, power *= length) {
        long double factor = power;
        for (int n = 0; n < 4 && n <= k; ++n) {
          d[n] += a[k] * factor;
          factor *= (k - n) / length;
        }
      }
      second[solution] = d[2];
      shear[solution] = d[3] - eta * eta * tip_mass * d[1] + tip_mass * lambda * d[0];
    }
    return second[0] * shear[1] - second[1] * shear[0];
  }

  /// The lowest `count` values of lambda, each found by bisection between sign changes.
  std::vector<double> eigenvalues(int count) const {
    std::vector<double> found;
    long double left = 1e-9L, f_left = determinant(left);
    for (long double s = 0.25L; s < 150; s += 0.25L) {  // in sqrt(lambda): neighbours are more than 1 apart
      const long double right = s * s, f_right = determinant(right);
      if ((f_left < 0) != (f_right < 0)) {
        long double a = left, b = right;
        for (int i = 0; i < 70; ++i) {
          const long double middle = (a + b) / 2;
          ((determinant(middle) < 0) == (f_left < 0) ? a : b) = middle;
        }
        found.push_back(static_cast<double>((a + b) / 2));
        if (static_cast<int>(found.size()) == count) return found;
      }
      left = right;
      f_left = f_right;
    }
    throw std::runtime_error("FrobeniusBeam: too few eigenvalues below 150^2");
  }
};

}  // namespace heerk_rotor
