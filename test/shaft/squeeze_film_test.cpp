#include "heerk_rotor/shaft/squeeze_film.hpp"

#include <cmath>
#include <random>

#include "measured.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kPi = 3.14159265358979323846;

SqueezeFilm::Parameters dualDiscFilm(bool full) { return {1.6e-4, 0.011, 0.0675, 0.02, full}; }

/// The pressure integrated numerically. Per length of circumference, short bearing: p = -mu L^3 (dh/dt) / h^3 over the length, with the gap
/// h = c - (x cos + y sin) and dh/dt = -(v_x cos + v_y sin) at the angle from the housing centre; only p > 0 counts in the half film.
/// The trapezoidal rule is exact to round-off for the periodic full film; the half film goes from zero to zero of p in its
/// own variable, beta = (pi / 2) sin(s) doubled in smoothness (tanh-sinh).
SqueezeFilm::Force integrated(const SqueezeFilm::Parameters& p, double x, double y, double v_x, double v_y) {
  const double towards = std::atan2(v_y, v_x), k = p.viscosity * p.radius * p.length * p.length * p.length;
  const auto add = [&](double angle, double weight, SqueezeFilm::Force& sum) {
    const double n_x = std::cos(angle), n_y = std::sin(angle);
    const double h = p.clearance - x * n_x - y * n_y, pressure = k * (v_x * n_x + v_y * n_y) / (h * h * h);
    sum.x -= weight * pressure * n_x;
    sum.y -= weight * pressure * n_y;
  };
  SqueezeFilm::Force sum{0.0, 0.0};
  if (p.full) {
    constexpr int kPoints = 20000;
    for (int i = 0; i < kPoints; ++i) add(2.0 * kPi * i / kPoints, 2.0 * kPi / kPoints, sum);
    return sum;
  }
  constexpr int kHalf = 4000;
  constexpr double kStep = 3.2 / kHalf;
  for (int i = -kHalf; i <= kHalf; ++i) {
    const double s = i * kStep, inner = 0.5 * kPi * std::sinh(s), cosh = std::cosh(inner);
    add(towards + 0.5 * kPi * std::tanh(inner), 0.5 * kPi * kStep * 0.5 * kPi * std::cosh(s) / (cosh * cosh), sum);
  }
  return sum;
}

TEST(SqueezeFilm, isTheIntegralOfThePressureForRandomStates) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const bool full : {false, true}) {
    const SqueezeFilm::Parameters p = dualDiscFilm(full);
    const SqueezeFilm film(p);
    double worst = 0.0;
    for (int i = 0; i < 300; ++i) {
      const double e = 0.95 * std::sqrt(unit(random)), angle = 2.0 * kPi * unit(random), direction = 2.0 * kPi * unit(random);
      const double speed = std::pow(10.0, -6.0 + 7.0 * unit(random));
      const double rho_x = e * std::cos(angle), rho_y = e * std::sin(angle), v_x = speed * std::cos(direction), v_y = speed * std::sin(direction);
      const SqueezeFilm::Force closed = film.force(rho_x, rho_y, v_x, v_y), sum = integrated(p, rho_x * p.clearance, rho_y * p.clearance, v_x, v_y);
      worst = std::max(worst, std::hypot(closed.x - sum.x, closed.y - sum.y) / std::hypot(sum.x, sum.y));
    }
    report(std::string("closed form against quadrature, ") + (full ? "full film" : "half film"), worst);
    // (1 - e)^-3 = 8000 amplifies the round-off of h in the sum.
    EXPECT_LE(worst, 1e-11);
  }
}

TEST(SqueezeFilm, neverFeedsEnergyIn) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.2, 1.2);
  for (const bool full : {false, true}) {
    const SqueezeFilm film(dualDiscFilm(full));
    for (int i = 0; i < 20000; ++i) {
      const double rho_x = any(random), rho_y = any(random), v_x = any(random), v_y = any(random);
      const SqueezeFilm::Force force = film.force(rho_x, rho_y, v_x, v_y);
      ASSERT_LT(force.x * v_x + force.y * v_y, 0.0) << rho_x << ' ' << rho_y << ' ' << v_x << ' ' << v_y;
    }
  }
}

TEST(SqueezeFilm, isSmoothThroughTheCentre) {
  // There Jc = pi / 2 (half) or pi (full), Js = 0: F = -k Jc v, and the next terms are of first order in rho.
  for (const bool full : {false, true}) {
    const SqueezeFilm film(dualDiscFilm(full));
    const double c0 = film.k() * kPi * (full ? 1.0 : 0.5);
    for (const double e : {0.0, 1e-300, 1e-9}) {
      const SqueezeFilm::Force force = film.force(e, -e, 0.3, 0.4);
      EXPECT_NEAR(force.x, -0.3 * c0, 1e-7 * c0);
      EXPECT_NEAR(force.y, -0.4 * c0, 1e-7 * c0);
    }
  }
}

TEST(SqueezeFilm, isLinearInTheVelocityAndZeroAtRest) {
  for (const bool full : {false, true}) {
    const SqueezeFilm film(dualDiscFilm(full));
    EXPECT_EQ(film.force(0.3, -0.5, 0.0, 0.0).x, 0.0);
    EXPECT_EQ(film.force(0.3, -0.5, 0.0, 0.0).y, 0.0);
    const SqueezeFilm::Force once = film.force(0.3, -0.5, 0.01, 0.02), twice = film.force(0.3, -0.5, 0.02, 0.04);
    EXPECT_NEAR(twice.x, 2.0 * once.x, 1e-14 * std::abs(twice.x));
    EXPECT_NEAR(twice.y, 2.0 * once.y, 1e-14 * std::abs(twice.y));
    // Only the full film is odd in it: the half film has its pressure on the other side then.
    const SqueezeFilm::Force back = film.force(0.3, -0.5, -0.01, -0.02);
    EXPECT_EQ(std::abs(back.x + once.x) <= 1e-13 * std::abs(once.x), full);
  }
}

TEST(SqueezeFilm, turnsWithTheAxes) {
  const SqueezeFilm film(dualDiscFilm(false));
  const SqueezeFilm::Force force = film.force(0.4, 0.3, 0.02, -0.05), turned = film.force(-0.3, 0.4, 0.05, 0.02);
  EXPECT_NEAR(turned.x, -force.y, 1e-13 * std::abs(force.y));
  EXPECT_NEAR(turned.y, force.x, 1e-13 * std::abs(force.x));
}

TEST(SqueezeFilm, beyondTheLimitTheForceIsThatAtTheLimit) {
  const SqueezeFilm film(dualDiscFilm(false));
  const SqueezeFilm::Force limit = film.force(0.999 * 0.6, 0.999 * 0.8, 0.01, 0.03), beyond = film.force(3.0 * 0.6, 3.0 * 0.8, 0.01, 0.03);
  EXPECT_NEAR(beyond.x, limit.x, 1e-9 * std::abs(limit.x));  // D = 1 - 0.999^2 = 2e-3 amplifies round-off, to the power 5/2
  EXPECT_NEAR(beyond.y, limit.y, 1e-9 * std::abs(limit.y));
  EXPECT_TRUE(std::isfinite(film.force(1.0, 0.0, 1.0, 0.0).x));
}

}  // namespace
}  // namespace heerk_rotor
