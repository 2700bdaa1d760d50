#pragma once
#include <complex>

#include "heerk_rotor/aero/lanes.hpp"

namespace heerk_rotor {

/// Lag of the circulatory lift behind the downwash at the three-quarter chord, as an indicial function with two exponentials:
///   phi(s) = 1 - A1 exp(-b1 s) - A2 exp(-b2 s),   s = 2 U t / c (distance in semi-chords)
/// with two states per section, z_i' = (2 U / c)(w - b_i z_i), and effective downwash w (1 - A1 - A2) + sum A_i b_i z_i.
struct IndicialLag {
  double A[2], b[2];

  /// R. T. Jones' approximation of Wagner's function (NACA 681). C(k) within 0.0145 of Theodorsen's function.
  static IndicialLag jones() noexcept { return {{0.165, 0.335}, {0.0455, 0.3}}; }
  /// Beddoes' compressible form; mach below 1.
  static IndicialLag beddoes(double mach) noexcept {
    const double beta2 = 1.0 - mach * mach;
    return {{0.3, 0.7}, {0.14 * beta2, 0.53 * beta2}};
  }

  /// phi(s), s >= 0.
  double response(double s) const noexcept;
  /// C(k), lift amplitude and phase relative to quasi-steady lift at reduced frequency k = omega c / (2 U).
  std::complex<double> frequencyResponse(double k) const noexcept;

  /// speed: U >= 0 [m/s]; downwash: w [m/s]; z, zdot: the two states [m/s] and their rates [m/s^2].
  template <int N>
  void derivatives(double chord, const Lanes<N>& speed, const Lanes<N>& downwash, const Lanes<N> (&z)[2], Lanes<N> (&zdot)[2]) const noexcept {
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < N; ++k) zdot[i][k] = 2.0 * speed[k] / chord * (downwash[k] - b[i] * z[i][k]);
  }
  /// The downwash that acts [m/s].
  template <int N>
  void effectiveDownwash(const Lanes<N>& downwash, const Lanes<N> (&z)[2], Lanes<N>& effective) const noexcept {
    const double direct = 1.0 - A[0] - A[1], first = A[0] * b[0], second = A[1] * b[1];
    for (int k = 0; k < N; ++k) effective[k] = direct * downwash[k] + first * z[0][k] + second * z[1][k];
  }
  /// State i under a constant downwash: there effective and geometric downwash agree.
  double steadyState(int i, double downwash) const noexcept { return downwash / b[i]; }
};

}  // namespace heerk_rotor
