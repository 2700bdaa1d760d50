#include "heerk_rotor/aero/section_loads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "aero/shipped_deck.hpp"
#include "heerk_rotor/aero/airfoil_table.hpp"
#include "heerk_rotor/aero/linear_polar.hpp"
#include "heerk_rotor/aero/tip_loss.hpp"
#include "heerk_rotor/core/branch_free_math.hpp"
#include "models/allocation_counter.hpp"

namespace heerk_rotor {
namespace {

constexpr SectionKinematics kFull = SectionKinematics::kFull, kSmall = SectionKinematics::kSmallAngle;

struct Loads {
  double vertical, inplane, moment, alpha, mach;
};

template <class Polar>
Loads loads(const Polar& polar, double ut, double up, double theta, const BladeSection& section = {}, const Air& air = {},
            SectionKinematics kinematics = kFull, double lag_angle = 0.0) {
  SectionLoads<1> result;
  sectionLoads<1>(section, polar, air, kinematics, {{{ut}}, {{up}}, {{theta}}, {{lag_angle}}}, result);
  return {result.vertical[0], result.inplane[0], result.moment[0], result.alpha[0], result.mach[0]};
}

LinearPolar someLinearPolar() {
  LinearPolar polar;
  polar.lift_slope = 6.1;
  polar.zero_lift_angle = -0.02;
  polar.drag[0] = 0.009;
  polar.drag[1] = 0.003;
  polar.drag[2] = 0.4;
  polar.moment = -0.012;
  return polar;
}

TEST(BranchFreeMath, agreesWithTheLibrary) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> value(-3.0, 3.0), exponent(-8.0, 8.0);
  for (int n = 0; n < 200000; ++n) {
    const double x = value(random) * std::exp2(exponent(random)), y = value(random) * std::exp2(exponent(random));
    ASSERT_NEAR(arcTangent2(y, x), std::atan2(y, x), 9e-16) << y << ", " << x;  // two units in the last place near pi
    const double angle = (n % 2 == 0 ? 100.0 : 5e5) * value(random);  // up to ten hours of azimuth
    ASSERT_NEAR(sineCosine(angle).sine, std::sin(angle), 3e-16) << angle;
    ASSERT_NEAR(sineCosine(angle).cosine, std::cos(angle), 3e-16) << angle;
  }
  EXPECT_EQ(arcTangent2(0.0, 0.0), 0.0);
  EXPECT_EQ(arcTangent2(0.0, -1.0), M_PI);
  EXPECT_EQ(arcTangent2(-2.0, 0.0), -0.5 * M_PI);
  EXPECT_TRUE(std::isnan(arcTangent2(std::nan(""), 1.0)));
  EXPECT_TRUE(std::isnan(arcTangent2(1.0, std::nan(""))));
  EXPECT_EQ(wrapAngle(M_PI), M_PI);
  EXPECT_EQ(wrapAngle(-M_PI), M_PI);
  EXPECT_NEAR(wrapAngle(1.0 - 4.0 * M_PI), 1.0, 1e-15);
}

/// The formulas of the header with trigonometry and the library's functions: the plain reference.
Loads plain(const LinearPolar& p, const BladeSection& s, const Air& air, double ut, double up, double theta) {
  const double W = std::hypot(ut, up), phi = std::atan2(up, ut), alpha = std::remainder(theta - phi, 2.0 * M_PI), mach = W / air.speed_of_sound;
  const double q = 0.5 * air.density * W * W * s.chord;
  const double cl = p.lift_slope / std::sqrt(1.0 - mach * mach) * (alpha - p.zero_lift_angle), cd = p.drag[0] + p.drag[1] * alpha + p.drag[2] * alpha * alpha;
  const double L = q * cl * s.lift_factor, D = q * cd;
  // force normal to the chord line, from lift and drag by alpha
  const double normal = L * std::cos(alpha) + D * std::sin(alpha);
  return {L * std::cos(phi) - D * std::sin(phi), L * std::sin(phi) + D * std::cos(phi),
          q * s.chord * p.moment + (s.elastic_axis - 0.25) * s.chord * normal, alpha, mach};
}

TEST(SectionLoads, agreeWithTheFormulas) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> ut(20.0, 240.0), up(-15.0, 15.0), theta(-0.1, 0.1);
  BladeSection section{0.31, 0.28, 0.9};
  const Air air{1.1, 330.0};
  for (int n = 0; n < 2000; ++n) {
    const double t = ut(random), p = up(random), th = theta(random);
    const Loads a = loads(someLinearPolar(), t, p, th, section, air), b = plain(someLinearPolar(), section, air, t, p, th);
    const double scale = 0.5 * air.density * t * t * section.chord;
    ASSERT_NEAR(a.vertical, b.vertical, 1e-13 * scale);
    ASSERT_NEAR(a.inplane, b.inplane, 1e-13 * scale);
    ASSERT_NEAR(a.moment, b.moment, 1e-13 * scale);
    ASSERT_NEAR(a.alpha, b.alpha, 1e-15);
    ASSERT_NEAR(a.mach, b.mach, 1e-15);
  }
}

TEST(SectionLoads, tableAndLinearPolarUseTheSameKinematics) {
  // A deck whose lift is exactly linear within +-40 deg and whose drag is constant.
  C81Block lift{{0.0, 1.0}, {-40, 40}, {}}, drag{{0.0}, {-40, 40}, {0.01, 0.01}}, moment{{0.0}, {-40, 40}, {-0.02, -0.02}};
  const double edge = 5.73 * 40.0 * M_PI / 180.0;
  lift.values = {-edge, -edge, edge, edge};
  const AirfoilTable table({"line", lift, drag, moment});
  LinearPolar polar;
  polar.moment = -0.02;
  Air air;
  air.speed_of_sound = std::numeric_limits<double>::infinity();
  BladeSection section;
  section.elastic_axis = 0.3;
  for (SectionKinematics kinematics : {kFull, kSmall})
    for (double up : {-20.0, 0.0, 30.0}) {
      const Loads a = loads(table, 100.0, up, 0.1, section, air, kinematics), b = loads(polar, 100.0, up, 0.1, section, air, kinematics);
      EXPECT_NEAR(a.vertical, b.vertical, 1e-11);
      EXPECT_NEAR(a.inplane, b.inplane, 1e-11);
      EXPECT_NEAR(a.moment, b.moment, 1e-11);
      EXPECT_NEAR(a.alpha, b.alpha, 1e-15);
    }
}

TEST(SectionLoads, prandtlGlauertRaisesTheLiftOnly) {
  LinearPolar polar;
  const double up = 0.0, theta = 0.05;
  const Loads slow = loads(polar, 0.001 * 340.3, up, theta), fast = loads(polar, 0.6 * 340.3, up, theta);
  const double ratio = 0.6 * 0.6 / 1e-6;  // of the dynamic pressures
  EXPECT_NEAR(fast.vertical / slow.vertical / ratio, 1.0 / 0.8, 1e-6);
  EXPECT_NEAR(fast.inplane / slow.inplane / ratio, 1.0, 1e-9);
  EXPECT_TRUE(std::isfinite(loads(polar, 400.0, up, theta).vertical));  // beyond Mach 1
}

template <class Polar>
void expectDragOpposesTheFlow(const Polar& polar) {
  // Lift does no work against the relative wind; the air's power on a section at rest in it is D W.
  for (double angle = -3.1; angle < 3.15; angle += 0.05)
    for (double theta : {-0.2, 0.0, 0.3}) {
      const double W = 80.0, ut = W * std::cos(angle), up = W * std::sin(angle);
      const Loads l = loads(polar, ut, up, theta);
      const double drag = (l.inplane * ut - l.vertical * up) / W;  // the wind blows along (in-plane, z) = (U_T, -U_P)
      const double q = 0.5 * 1.225 * W * W * 0.3;
      ASSERT_GT(drag, 0.005 * q) << angle << " " << theta;
      ASSERT_NEAR(std::abs(wrapAngle(theta - angle) - l.alpha), 0.0, 1e-14);
    }
}

TEST(SectionLoads, dragOpposesTheFlowFromEverywhere) {
  expectDragOpposesTheFlow(LinearPolar());
  expectDragOpposesTheFlow(AirfoilTable(test::shippedDeck()));
}

TEST(SectionLoads, liftDoesNoWork) {
  LinearPolar polar;
  polar.drag[0] = 0.0;
  for (double angle = -3.1; angle < 3.15; angle += 0.05) {
    const double ut = 80.0 * std::cos(angle), up = 80.0 * std::sin(angle);
    const Loads l = loads(polar, ut, up, 0.2);
    EXPECT_NEAR(l.inplane * ut - l.vertical * up, 0.0, 1e-15 * 80.0 * 1e4);
  }
}

TEST(SectionLoads, reverseFlowUnderANoseUpSectionPushesItDown) {
  const AirfoilTable table(test::shippedDeck());
  for (double theta : {0.05, 0.1}) {
    const Loads t = loads(table, -50.0, 0.0, theta), l = loads(LinearPolar(), -50.0, 0.0, theta);
    EXPECT_LT(t.vertical, 0.0);
    EXPECT_LT(l.vertical, 0.0);
    EXPECT_LT(t.inplane, 0.0);  // towards the leading edge, with the wind
    EXPECT_LT(l.inplane, 0.0);
    EXPECT_NEAR(l.alpha, theta - M_PI, 1e-15);
    // flat-plate lift of the mirrored flow
    EXPECT_NEAR(l.vertical, -loads(LinearPolar(), 50.0, 0.0, theta).vertical, 1e-11);
  }
}

TEST(SectionLoads, symmetricSectionIsAntisymmetricInTheFlow) {
  const AirfoilTable table(test::symmetricDeck());
  BladeSection section;
  section.elastic_axis = 0.35;
  for (double angle = 0.02; angle < 3.1; angle += 0.1) {
    const double ut = 90.0 * std::cos(angle), up = 90.0 * std::sin(angle);
    const Loads a = loads(table, ut, up, 0.12, section), b = loads(table, ut, -up, -0.12, section);
    EXPECT_NEAR(a.vertical, -b.vertical, 1e-9);
    EXPECT_NEAR(a.inplane, b.inplane, 1e-9);
    EXPECT_NEAR(a.moment, -b.moment, 1e-9);
  }
}

TEST(SectionLoads, areContinuousAllAround) {
  for (double theta : {-0.3, 0.0, 0.2}) {
    const AirfoilTable table(test::shippedDeck());
    Loads last_table{}, last_linear{};
    for (int n = 0; n <= 20000; ++n) {
      const double angle = -M_PI + 2.0 * M_PI * n / 20000, ut = 60.0 * std::cos(angle), up = 60.0 * std::sin(angle);
      const Loads t = loads(table, ut, up, theta), l = loads(LinearPolar(), ut, up, theta);
      if (n > 0) {
        // q c = 662 N/m, coefficients change by at most 10 per rad: 2 N/m in 3.1e-4 rad; a jump in cl of 0.01 would be 6.6
        ASSERT_NEAR(t.vertical, last_table.vertical, 3.0) << angle;
        ASSERT_NEAR(l.vertical, last_linear.vertical, 3.0) << angle;
        ASSERT_NEAR(l.inplane, last_linear.inplane, 3.0) << angle;
      }
      last_table = t;
      last_linear = l;
    }
  }
}

TEST(SectionLoads, momentArmFollowsTheElasticAxis) {
  const LinearPolar polar;
  BladeSection behind, at;
  behind.elastic_axis = 0.35;
  const double theta = 0.1;
  const Loads a = loads(polar, 100.0, 3.0, theta, behind), b = loads(polar, 100.0, 3.0, theta, at);
  EXPECT_EQ(b.moment, 0.0);
  EXPECT_GT(a.moment, 0.0);  // lift ahead of the axis: nose up
  EXPECT_NEAR(a.moment, 0.1 * 0.3 * (a.vertical * std::cos(theta) + a.inplane * std::sin(theta)), 1e-12);
}

TEST(SectionLoads, smallAnglesAreTheTextbooksPolynomial) {
  Air air;
  air.speed_of_sound = std::numeric_limits<double>::infinity();
  const LinearPolar polar;
  const double k = 0.5 * air.density * 0.3;
  for (double ut : {-30.0, 0.0, 1e-9, 50.0})
    for (double up : {-5.0, 0.0, 8.0}) {
      const double theta = 0.15;
      const Loads l = loads(polar, ut, up, theta, {}, air, kSmall);
      EXPECT_NEAR(l.vertical, k * 5.73 * (theta * ut * ut - up * ut), 1e-12);
      EXPECT_NEAR(l.inplane, k * (5.73 * (theta * ut - up) * up + 0.01 * ut * ut), 1e-12);
    }
  // and the limit of the full ones: differences are of second order in phi
  const double phi = 1e-3;
  const Loads full = loads(polar, 100.0, 100.0 * phi, phi + 1e-3), small = loads(polar, 100.0, 100.0 * phi, phi + 1e-3, {}, {}, kSmall);
  EXPECT_NEAR(full.vertical / small.vertical, 1.0, 5e-3);  // drag: cd phi / cl = 0.01 x 1e-3 / 5.7e-3 = 1.7e-3
  EXPECT_NEAR(full.inplane / small.inplane, 1.0, 1e-5);
}

TEST(SectionLoads, lagAngleChangesTheCoefficientsNotTheDirection) {
  const LinearPolar polar;
  Air air;
  air.speed_of_sound = std::numeric_limits<double>::infinity();
  const Loads a = loads(polar, 100.0, 0.0, 0.1, {}, air, kFull, -0.03), b = loads(polar, 100.0, 0.0, 0.07, {}, air);
  EXPECT_NEAR(a.vertical, b.vertical, 1e-11);
  EXPECT_NEAR(a.inplane, b.inplane, 1e-11);
}

TEST(SectionLoads, vanishWithoutWindAndPassNotANumberOn) {
  const AirfoilTable table(test::shippedDeck());
  for (SectionKinematics kinematics : {kFull, kSmall}) {
    for (const Loads& l : {loads(table, 0.0, 0.0, 0.1, {}, {}, kinematics), loads(LinearPolar(), 0.0, 0.0, 0.1, {}, {}, kinematics)}) {
      EXPECT_EQ(l.vertical, 0.0);
      EXPECT_EQ(l.inplane, 0.0);
      EXPECT_EQ(l.moment, 0.0);
    }
    for (int which = 0; which < 3; ++which) {
      const double nan = std::nan(""), ut = which == 0 ? nan : 50.0, up = which == 1 ? nan : 2.0, theta = which == 2 ? nan : 0.1;
      EXPECT_FALSE(std::isfinite(loads(table, ut, up, theta, {}, {}, kinematics).vertical)) << which;
      EXPECT_FALSE(std::isfinite(loads(LinearPolar(), ut, up, theta, {}, {}, kinematics).vertical)) << which;
    }
  }
}

template <int N, class Polar>
void expectLanesLikeScalar(const Polar& polar) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> ut(-60.0, 240.0), up(-30.0, 30.0), theta(-0.3, 0.4), lag(-0.02, 0.02);
  BladeSection section;
  section.elastic_axis = 0.27;
  for (SectionKinematics kinematics : {kFull, kSmall})
    for (int n = 0; n < 2000; ++n) {
      SectionFlow<N> flow;
      for (int k = 0; k < N; ++k) {
        flow.tangential[k] = ut(random);
        flow.perpendicular[k] = up(random);
        flow.pitch[k] = theta(random);
        flow.lag_angle[k] = lag(random);
      }
      SectionLoads<N> result;
      sectionLoads(section, polar, Air(), kinematics, flow, result);
      for (int k = 0; k < N; ++k) {
        const Loads one = loads(polar, flow.tangential[k], flow.perpendicular[k], flow.pitch[k], section, Air(), kinematics, flow.lag_angle[k]);
        // rounding of fused multiply-adds, times a dynamic pressure of 1e4 N/m and slopes of up to 100 per rad in the table
        const double tolerance = 1e-15 * (1e4 * 100.0 + std::abs(one.vertical) * 10.0 + std::abs(one.alpha) * 1e4);
        ASSERT_NEAR(result.vertical[k], one.vertical, tolerance);
        ASSERT_NEAR(result.inplane[k], one.inplane, tolerance);
        ASSERT_NEAR(result.moment[k], one.moment, tolerance);
        ASSERT_NEAR(result.alpha[k], one.alpha, 1e-14 * std::max(1.0, std::abs(one.alpha)));
        ASSERT_NEAR(result.mach[k], one.mach, 1e-15);
      }
    }
}

TEST(SectionLoads, lanesGiveWhatOneSectionGives) {
  const AirfoilTable linear(test::shippedDeck()), cubic(test::shippedDeck(), TableInterpolation::kMonotoneCubic);
  expectLanesLikeScalar<4>(someLinearPolar());
  expectLanesLikeScalar<8>(someLinearPolar());
  expectLanesLikeScalar<4>(linear);
  expectLanesLikeScalar<8>(linear);
  expectLanesLikeScalar<4>(cubic);
  expectLanesLikeScalar<8>(cubic);
}

TEST(SectionLoads, doNotAllocate) {
  if (!test::heapIsCounted()) GTEST_SKIP() << "the heap cannot be counted in this build";
  const AirfoilTable table(test::shippedDeck());
  SectionFlow<4> flow{{{100, 110, 120, 130}}, {{1, 2, 3, 4}}, {{0.1, 0.1, 0.1, 0.1}}, {}};
  SectionLoads<4> result;
  const test::HeapCalls heap;
  for (SectionKinematics kinematics : {kFull, kSmall}) {
    sectionLoads(BladeSection(), table, Air(), kinematics, flow, result);
    sectionLoads(BladeSection(), LinearPolar(), Air(), kinematics, flow, result);
  }
  EXPECT_EQ(heap.count(), 0u);
}

TEST(TipLoss, smoothStepIsTwiceContinuouslyDifferentiable) {
  EXPECT_EQ(smoothStep(1.0, 1.0, 2.0), 0.0);
  EXPECT_EQ(smoothStep(2.0, 1.0, 2.0), 1.0);
  EXPECT_EQ(smoothStep(1.5, 1.0, 2.0), 0.5);
  // Near an end s: 10 s^3, so first and second difference quotients vanish with s
  const double s = 1e-4;
  EXPECT_NEAR(smoothStep(1.0 + s, 1.0, 2.0), 10.0 * s * s * s, 20.0 * s * s * s * s);
  EXPECT_NEAR(1.0 - smoothStep(2.0 - s, 1.0, 2.0), 10.0 * s * s * s, 20.0 * s * s * s * s);
}

TEST(TipLoss, effectiveRadiusIsB) {
  // Antisymmetric about B: the integral of the factor over the span is B exactly.
  const int n = 200000;
  double sum = 0.0, root = 0.0;
  for (int i = 0; i < n; ++i) {
    sum += tipLossFactor((i + 0.5) / n, 0.97) / n;
    root += rootCutoutFactor((i + 0.5) / n, 0.2) / n;
  }
  EXPECT_NEAR(sum, 0.97, 1e-9);
  EXPECT_NEAR(root, 0.8, 1e-9);
  for (const double inner : {0.9, 0.962, 0.967, 0.972}) {  // its mean over a segment, against the midpoint rule
    const double outer = inner + 0.02;
    double mean = 0.0;
    for (int i = 0; i < n; ++i) mean += tipLossFactor(inner + 0.02 * (i + 0.5) / n, 0.97) / n;
    EXPECT_NEAR(meanTipLossFactor(inner, outer, 0.97), mean, 1e-7) << inner;
  }
  EXPECT_EQ(meanTipLossFactor(0.9, 1.0, 1.0), 1.0);
  EXPECT_EQ(tipLossFactor(0.9649, 0.97), 1.0);
  EXPECT_EQ(tipLossFactor(0.9751, 0.97), 0.0);
  EXPECT_EQ(tipLossFactor(1.0, 1.0), 1.0);
  EXPECT_EQ(rootCutoutFactor(0.0, 0.0), 1.0);
  EXPECT_EQ(rootCutoutFactor(0.1, 0.2), 0.0);
}

TEST(TipLoss, prandtl) {
  EXPECT_EQ(prandtlTipLoss(4, 1.0, 0.1), 0.0);
  EXPECT_EQ(prandtlTipLoss(4, 0.5, 0.0), 1.0);
  EXPECT_EQ(prandtlTipLoss(4, 0.0, 0.1), 1.0);
  // exp(-f) = 1/2 gives acos = pi/3, F = 2/3: f = N/2 (1 - r)/(r sin phi) = ln 2
  const double r = 0.9, sine = 2.0 * (1.0 - r) / (r * std::log(2.0));
  EXPECT_NEAR(prandtlTipLoss(4, r, std::asin(sine)), 2.0 / 3.0, 1e-15);
  EXPECT_EQ(prandtlTipLoss(4, r, -0.1), prandtlTipLoss(4, r, 0.1));
}

}  // namespace
}  // namespace heerk_rotor
