#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "heerk_rotor/models/inflow_ports.hpp"
#include "heerk_rotor/models/pitt_peters_inflow.hpp"
#include "heerk_rotor/models/static_inflow.hpp"

namespace heerk_rotor {
namespace {

using Six = Eigen::Matrix<double, 6, 1>;
using Three = Eigen::Vector3d;

Six flow(double ct, double cs, double cc, double forward, double left, double up) { return (Six() << ct, cs, cc, forward, left, up).finished(); }

template <class Model>
Three output(Model& model, const Six& u, const Three& x = Three::Zero()) {
  Three y;
  model.evalOutput(0, 0.0, In(x.data(), static_cast<Index>(model.states().size())), In(u.data(), 6), Out(y.data(), 3));
  return y;
}

Three derivatives(PittPetersInflow& model, const Six& u, const Three& x) {
  Three xdot;
  model.evalDerivatives(0.0, In(x.data(), 3), In(u.data(), 6), Out(xdot.data(), 3));
  return xdot;
}

/// Steady state by Newton on differenced derivatives, from Glauert's mean.
Three steady(PittPetersInflow& model, const Six& u) {
  Three x(glauertInflow(u[0], std::hypot(u[3], u[4]), u[5]), 0.0, 0.0);
  for (int i = 0; i < 50; ++i) {
    Eigen::Matrix3d jacobian;
    const Three f = derivatives(model, u, x);
    for (int k = 0; k < 3; ++k) {
      Three moved = x;
      moved[k] += 1e-7;
      jacobian.col(k) = (derivatives(model, u, moved) - f) / 1e-7;
    }
    x -= jacobian.partialPivLu().solve(f);
  }
  return x;
}

constexpr double kCt = 0.0064;

TEST(GlauertInflow, hasThePublishedValues) {
  // Closed form edgewise: l0^2 = (-mu^2 + sqrt(mu^4 + CT^2)) / 2. The floor eps = 1e-4 enters as eps^2 / 4 l0 at most.
  for (const auto& [mu, printed] : {std::pair{0.0, 0.056569}, {0.1, 0.030599}, {0.3, 0.010660}}) {
    const double l0 = glauertInflow(kCt, mu, 0.0);
    EXPECT_NEAR(l0, printed, 6e-7) << mu;  // six printed decimals
    EXPECT_NEAR(l0, std::sqrt((-mu * mu + std::sqrt(mu * mu * mu * mu + kCt * kCt)) / 2.0), 1e-7) << mu;
  }
}

TEST(GlauertInflow, solvesItsEquationForAnyThrustAndClimb) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> ct(-0.02, 0.02), mu(0.0, 0.5), climb(-0.02, 0.1);
  for (int k = 0; k < 10000; ++k) {
    const double c = ct(random), m = mu(random), z = (c < 0.0 ? -1.0 : 1.0) * climb(random), l = glauertInflow(c, m, z);
    EXPECT_NEAR(2.0 * l * std::sqrt(m * m + (z + l) * (z + l) + 1e-8), c, 1e-15) << c << " " << m << " " << z;
  }
}

TEST(GlauertInflow, isSmoothThroughZeroThrust) {
  // Slope 1 / (2 eps) at most, and odd in CT.
  for (const double ct : {1e-12, 1e-9, 1e-7}) {
    EXPECT_NEAR(glauertInflow(ct, 0.0, 0.0), -glauertInflow(-ct, 0.0, 0.0), 1e-18);
    EXPECT_LE(glauertInflow(ct, 0.0, 0.0), ct / 2e-4 * (1.0 + 1e-12));
  }
}

TEST(DreesInflow, followsItsFormulasInForwardFlightAndIsUniformInHover) {
  DreesInflow model(1.0);
  const double mu = 0.15, l0 = glauertInflow(kCt, mu, 0.01), chi = std::atan2(mu, 0.01 + l0);
  const Three y = output(model, flow(kCt, 0, 0, mu, 0.0, 0.01));
  EXPECT_NEAR(y[0], l0, 1e-15);
  EXPECT_NEAR(y[1], -2.0 * mu * l0, 1e-15);
  EXPECT_NEAR(y[2], l0 * 4.0 / 3.0 * (1.0 - std::cos(chi) - 1.8 * mu * mu) / std::sin(chi), 1e-6 * l0);  // floor of the skew angle
  const Three hover = output(model, flow(kCt, 0, 0, 0.0, 0.0, 0.0));
  EXPECT_EQ(hover[1], 0.0);
  EXPECT_EQ(hover[2], 0.0);
}

TEST(UniformInflow, scalesTheThrustByKappa) {
  UniformInflow model(1.15);
  EXPECT_NEAR(output(model, flow(kCt, 0, 0, 0, 0, 0))[0], std::sqrt(1.15 * kCt / 2.0), 1e-7);
}

TEST(PittPeters, settlesAtGlauertsInflowInHover) {
  PittPetersInflow model({1.0, 1.0, false});
  const Three x = steady(model, flow(kCt, 0, 0, 0, 0, 0));
  EXPECT_NEAR(x[0], std::sqrt(kCt / 2.0), 1e-7);
  EXPECT_NEAR(x.tail(2).norm(), 0.0, 1e-12);
}

TEST(PittPeters, hasTheHoverEigenvaluesOfTheClosedForm) {
  PittPetersInflow model({1.0, 1.0, false});  // Omega = 1: eigenvalues per radian
  const Six u = flow(kCt, 0, 0, 0, 0, 0);
  const Three x = steady(model, u);
  Eigen::Matrix3d jacobian;
  for (int k = 0; k < 3; ++k) {
    Three up = x, down = x;
    up[k] += 1e-6;
    down[k] -= 1e-6;
    jacobian.col(k) = (derivatives(model, u, up) - derivatives(model, u, down)) / 2e-6;
  }
  const double l0 = std::sqrt(kCt / 2.0);
  EXPECT_NEAR(jacobian(0, 0), -1.5 * M_PI * l0, 2e-6);  // -.2666; the floor of VT enters with (1e-4 / l0)^2
  EXPECT_NEAR(jacobian(1, 1), -45.0 * M_PI / 16.0 * l0, 2e-6);  // -.4998
  EXPECT_NEAR(jacobian(2, 2), -45.0 * M_PI / 16.0 * l0, 2e-6);
  EXPECT_NEAR(jacobian(0, 0), -0.2666, 5e-5);
  EXPECT_NEAR(jacobian(1, 1), -0.4998, 5e-5);
}

TEST(PittPeters, forwardFlightTiltsTheInflowByTheSkewAngle) {
  PittPetersInflow model({1.0, 1.0, false});
  const double mu = 0.2;
  const Three x = steady(model, flow(kCt, 0, 0, mu, 0, 0));
  const double skew = halfSkewTangent(mu, x[0]);
  EXPECT_NEAR(x[2] / x[0], 15.0 * M_PI / 32.0 * skew, 1e-9);  // more flow at the tail
  EXPECT_NEAR(x[1], 0.0, 1e-12);
}

TEST(PittPeters, turnsWithTheDirectionOfFlight) {
  PittPetersInflow model({30.0, 1.1, true});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 200; ++k) {
    const double delta = 3.1 * unit(random), mu = 0.3 * std::abs(unit(random)), c = std::cos(delta), s = std::sin(delta);
    const Three loads(kCt, 1e-3 * unit(random), 1e-3 * unit(random)), x(0.04, 0.02 * unit(random), 0.02 * unit(random));
    // (sine, cosine) parts in axes that lie an angle delta behind: psi' = psi - delta.
    const auto turned = [&](const Three& v) { return Three(v[0], v[1] * c - v[2] * s, v[2] * c + v[1] * s); };
    const Three straight = derivatives(model, flow(kCt, turned(loads)[1], turned(loads)[2], mu, 0.0, 0.01), turned(x));
    const Three skewed = derivatives(model, flow(kCt, loads[1], loads[2], mu * c, mu * s, 0.01), x);
    EXPECT_LT((turned(skewed) - straight).norm(), 1e-13 * (1.0 + straight.norm())) << k;
  }
}

TEST(PittPeters, isSmoothThroughHover) {
  PittPetersInflow model({30.0, 1.0, false});
  const Three x(0.05, 0.01, -0.01), still = derivatives(model, flow(kCt, 1e-4, 2e-4, 0, 0, 0), x);
  for (const double angle : {0.0, 1.0, 2.5, -2.0}) {
    const Three moving = derivatives(model, flow(kCt, 1e-4, 2e-4, 1e-9 * std::cos(angle), 1e-9 * std::sin(angle), 0), x);
    EXPECT_LT((moving - still).norm(), 1e-6) << angle;  // the change is of the order of the speed, times rates of 30 rad/s
  }
}

}  // namespace
}  // namespace heerk_rotor
