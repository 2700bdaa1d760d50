#include "heerk_rotor/aero/unsteady_lift.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace heerk_rotor {
namespace {

using Complex = std::complex<double>;

/// C(k) = H1/(H1 + i H0) with Hankel functions of the second kind, H = J - i Y.
Complex theodorsen(double k) {
  const Complex i(0.0, 1.0);
  const Complex h0 = std::cyl_bessel_j(0.0, k) - i * std::cyl_neumann(0.0, k), h1 = std::cyl_bessel_j(1.0, k) - i * std::cyl_neumann(1.0, k);
  return h1 / (h1 + i * h0);
}

/// Wagner's function itself: phi(s) = 1/2 + 2/pi int_0^inf (Re C - 1/2) sin(k s)/k dk. Re C - 1/2 falls as 1/k^2; with k = e^v
/// the trapezoidal rule converges quickly on both sides.
double wagner(double s) {
  double sum = 0.0;
  const double step = 1e-4;
  for (double v = -25.0; v < 6.0; v += step) sum += (theodorsen(std::exp(v)).real() - 0.5) * std::sin(std::exp(v) * s);
  return 0.5 + 2.0 / M_PI * sum * step;
}

TEST(IndicialLag, theodorsensFunctionIsTheKnownOne) {
  EXPECT_NEAR(theodorsen(0.1).real(), 0.83192, 5e-6);
  EXPECT_NEAR(theodorsen(0.1).imag(), -0.17230, 5e-6);
}

TEST(IndicialLag, jonesDiffersFromTheodorsenByAtMost0p0145) {
  double worst = 0.0;
  for (double k = 0.02; k <= 8.0; k *= 1.01) worst = std::max(worst, std::abs(IndicialLag::jones().frequencyResponse(k) - theodorsen(k)));
  // The error of the form itself: 0.014526, quoted as 0.0145.
  EXPECT_NEAR(worst, 0.0145, 5e-5);
}

// The values usually quoted as Wagner's are those of Jones' form to all five digits.
TEST(IndicialLag, jonesReachesTheQuotedValuesOfWagnersFunction) {
  const double s[] = {0, 1, 5, 10, 20}, phi[] = {0.5, 0.59417, 0.79383, 0.87864, 0.93275};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(IndicialLag::jones().response(s[i]), phi[i], 6e-6) << s[i];
}

TEST(IndicialLag, jonesStaysWithinOnePercentOfWagnersFunctionItself) {
  for (double s : {1.0, 5.0, 10.0, 20.0}) {
    EXPECT_NEAR(IndicialLag::jones().response(s), wagner(s), 0.01) << s;
    RecordProperty("wagner_" + std::to_string(static_cast<int>(s)), std::to_string(wagner(s)));
  }
}

TEST(IndicialLag, statesReproduceTheIndicialResponse) {
  // Unit step of downwash from zero states: z_i = (1 - exp(-b_i s))/b_i solves the equations; derivative by the chain rule.
  const IndicialLag lag = IndicialLag::jones();
  const double chord = 0.4, U = 60.0;
  for (double s : {0.0, 0.5, 3.0, 30.0}) {
    Lanes<4> z[2], zdot[2], w, speed, effective;
    for (int k = 0; k < 4; ++k) {
      w[k] = k + 1.0;
      speed[k] = U;
      for (int i = 0; i < 2; ++i) z[i][k] = w[k] * (1.0 - std::exp(-lag.b[i] * s)) / lag.b[i];
    }
    lag.derivatives(chord, speed, w, z, zdot);
    lag.effectiveDownwash(w, z, effective);
    for (int k = 0; k < 4; ++k) {
      for (int i = 0; i < 2; ++i) EXPECT_NEAR(zdot[i][k], w[k] * std::exp(-lag.b[i] * s) * 2.0 * U / chord, 1e-11);
      EXPECT_NEAR(effective[k], w[k] * lag.response(s), 1e-14 * w[k]);
    }
  }
}

TEST(IndicialLag, statesReproduceTheFrequencyResponse) {
  // z = Z e^{i k s} with zdot = i k Z (per semi-chord) and w = 1: the real and the imaginary part are two lanes.
  const IndicialLag lag = IndicialLag::jones();
  const double k = 0.1;
  Complex Z[2];
  for (int i = 0; i < 2; ++i) Z[i] = 1.0 / Complex(lag.b[i], k);
  Lanes<4> z[2] = {}, zdot[2], w = {{1, 0, 0, 0}}, speed = {{1, 1, 1, 1}}, effective;
  for (int i = 0; i < 2; ++i) {
    z[i][0] = Z[i].real();
    z[i][1] = Z[i].imag();
  }
  lag.derivatives(2.0, speed, w, z, zdot);  // chord 2, speed 1: time in semi-chords
  lag.effectiveDownwash(w, z, effective);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(std::abs(Complex(zdot[i][0], zdot[i][1]) - Complex(0, k) * Z[i]), 0.0, 1e-14);
  EXPECT_NEAR(std::abs(Complex(effective[0], effective[1]) - lag.frequencyResponse(k)), 0.0, 1e-15);
}

TEST(IndicialLag, steadyStatesHaveNoLag) {
  for (const IndicialLag& lag : {IndicialLag::jones(), IndicialLag::beddoes(0.6)}) {
    Lanes<1> z[2] = {{{lag.steadyState(0, 7.0)}}, {{lag.steadyState(1, 7.0)}}}, zdot[2], effective;
    lag.derivatives<1>(0.3, {{50.0}}, {{7.0}}, z, zdot);
    lag.effectiveDownwash<1>({{7.0}}, z, effective);
    EXPECT_NEAR(effective[0], 7.0, 1e-14);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(zdot[i][0], 0.0, 1e-12);
  }
  EXPECT_NEAR(IndicialLag::beddoes(0.6).b[0], 0.14 * 0.64, 1e-16);
}

}  // namespace
}  // namespace heerk_rotor
