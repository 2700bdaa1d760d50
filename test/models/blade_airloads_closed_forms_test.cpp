// Blade-element integrals that textbooks give in closed form. Gauss sections integrate their polynomials in r exactly, so that what is
// left is round-off.
#include "models/blade_airloads_rig.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kRho = 1.225, kChord = 0.27, kSlope = 5.7, kRadius = 5.0;
const std::string kRotor = "nodes: [0.0, 5.0], root_cutout: 0.0, section_rule: gauss, sections: 6, blades: ";
const std::string kTextbook = "    lift_slope: 5.7\n    drag: 0.0\n    compressible: false\n    kinematics: small_angle\n";

double solidity(int blades) { return blades * kChord / (M_PI * kRadius); }

TEST(BladeAirloadsClosedForm, hoverThrustAndTorque) {
  // CT = sigma a / 2 (theta / 3 - lambda / 2); profile torque CQ0 = sigma cd0 / 8, induced torque lambda CT (uniform inflow).
  for (const int blades : {2, 3, 4, 5, 8}) {
    AirloadsRig rig(kRotor + std::to_string(blades), "    lift_slope: 5.7\n    drag: 0.011\n    compressible: false\n    kinematics: small_angle\n");
    ASSERT_EQ(rig.complaints, "");
    const double theta = 0.14, lambda = 0.055, a = kSlope, sigma = solidity(blades);
    rig.turn(kOmega, theta);
    rig.port("inflow")[0] = lambda;
    const double expected = 0.5 * sigma * a * (theta / 3.0 - lambda / 2.0);
    const Vector rotor = rig.output("rotor_loads"), loads = rig.output("section_loads");
    EXPECT_NEAR(rotor[0], expected, 1e-10 * expected);
    EXPECT_NEAR(rotor[1], 0.0, 1e-17);
    EXPECT_NEAR(rotor[2], 0.0, 1e-17);
    double torque = 0.0;
    for (Index j = 0; j < rig.sections.count(); ++j)
      for (Index k = 0; k < blades; ++k) torque -= rig.sections.r[j] * rig.loadOf(loads, j, k)[1];
    const double tip_speed = kOmega * kRadius, reference = kRho * M_PI * kRadius * kRadius * tip_speed * tip_speed * kRadius;
    EXPECT_NEAR(torque / reference, lambda * expected + 0.125 * sigma * 0.011, 1e-10 * torque / reference);
  }
}

TEST(BladeAirloadsClosedForm, hoverBladeElementMomentumTheory) {
  // lambda(r) = sigma a / 16 (sqrt(1 + 32 theta r / (sigma a)) - 1) balances each annulus: dCT = 4 lambda^2 r dr. As the inflow port
  // knows only a linear distribution, the blade climbs section by section instead.
  AirloadsRig rig(kRotor + "4", kTextbook);
  const double theta = 0.15, sa = solidity(4) * kSlope, tip_speed = kOmega * kRadius;
  rig.turn(kOmega, theta);
  std::vector<double> lambda;
  for (Index j = 0; j < rig.sections.count(); ++j) {
    lambda.push_back(sa / 16.0 * (std::sqrt(1.0 + 32.0 * theta * rig.sections.r[j] / kRadius / sa) - 1.0));
    for (Index k = 0; k < 4; ++k) rig.at("section_velocity", j, 2, 3, k) = lambda.back() * tip_speed;
  }
  const Vector loads = rig.output("section_loads");
  for (Index j = 0; j < rig.sections.count(); ++j) {
    double thrust = 0.0;
    for (Index k = 0; k < 4; ++k) thrust += rig.loadOf(loads, j, k)[2];
    const double r = rig.sections.r[j] / kRadius, dr = rig.sections.width[j] / kRadius;
    const double expected = 4.0 * lambda[j] * lambda[j] * r * dr;
    EXPECT_NEAR(thrust / (kRho * M_PI * kRadius * kRadius * tip_speed * tip_speed), expected, 1e-10 * expected) << r;
  }
}

/// A rigid blade hinged at the centre in edgewise flight, angles so small that their products vanish.
struct FlappingRotor {
  double root_pitch, twist, theta1c, theta1s, lambda, l1c, l1s, mu, b0, b1c, b1s;

  double flap(double psi) const { return b0 + b1c * std::cos(psi) + b1s * std::sin(psi); }
  double flapRate(double psi) const { return kOmega * (b1s * std::cos(psi) - b1c * std::sin(psi)); }

  void feed(AirloadsRig& rig, double azimuth) const {
    rig.level();
    rig.port("hub_motion")[0] = azimuth;
    rig.port("hub_motion")[1] = kOmega;
    const double inflow[3] = {lambda, l1s, l1c}, speed = mu * kOmega * kRadius;
    std::copy(inflow, inflow + 3, rig.port("inflow"));
    for (Index k = 0; k < rig.blades(); ++k) {
      const double psi = rig.azimuth(k), beta = flap(psi);
      for (Index j = 0; j < rig.sections.count(); ++j) {
        const double r = rig.sections.r[j];
        rig.set("section_velocity", j, k, {-speed * std::cos(psi), kOmega * r + speed * std::sin(psi), r * flapRate(psi)});
        rig.set("section_axes", j, k, {0, 1, 0, -beta, 0, 1});
        rig.set("section_pitch", j, k, {root_pitch + twist * r / kRadius + theta1c * std::cos(psi) + theta1s * std::sin(psi)});
      }
    }
  }
};

TEST(BladeAirloadsClosedForm, hingeMomentsGiveTheTextbooksFlapping) {
  // aeromechanics.md, section 3, for gamma = 8 and nu = 1: with these coefficients the flap moment is gamma [...] in the mean and has no
  // first harmonic. In units of I Omega^2, gamma = rho a c R^4 / I.
  for (const double mu : {0.0, 0.1, 0.2, 0.3}) {
    FlappingRotor rotor{0.24, -0.14, 0.02, -0.05, 0.04, 0.01, 0.004, mu, 0, 0, 0};
    const double gamma = 8.0, th = rotor.root_pitch, tw = rotor.twist, s1 = rotor.theta1s, lam = rotor.lambda, l1s = rotor.l1s;
    const double mean = (1.0 + mu * mu) / 8.0 * th + (0.1 + mu * mu / 12.0) * tw + mu / 6.0 * s1 - lam / 6.0 - mu * l1s / 12.0;
    rotor.b0 = gamma * mean;
    rotor.b1c = -(8.0 / 3.0 * mu * th + 2.0 * mu * tw - 2.0 * mu * lam + (1.0 + 1.5 * mu * mu) * s1 - l1s) / (1.0 - 0.5 * mu * mu);
    rotor.b1s = rotor.theta1c - (4.0 / 3.0 * mu * rotor.b0 + rotor.l1c) / (1.0 + 0.5 * mu * mu);
    const double deg = 180.0 / M_PI;
    if (mu == 0.0) {  // printed there, four decimals
      EXPECT_NEAR(rotor.b0 * deg, 4.2781, 6e-5);
      EXPECT_NEAR(rotor.b1c * deg, 3.0940, 6e-5);
      EXPECT_NEAR(rotor.b1s * deg, 0.5730, 6e-5);
    }
    AirloadsRig rig(kRotor + "4", kTextbook);
    double average = 0.0, cosine = 0.0, sine = 0.0;
    const int azimuths = 8;  // of four blades: 32 points, exact for harmonics far beyond the fourth, the highest here
    for (int i = 0; i < azimuths; ++i) {
      rotor.feed(rig, 0.5 * M_PI * i / azimuths);
      const Vector loads = rig.output("section_loads");
      for (Index k = 0; k < 4; ++k) {
        double moment = 0.0;
        for (Index j = 0; j < rig.sections.count(); ++j) moment += rig.sections.r[j] * rig.loadOf(loads, j, k)[2];
        moment /= kRho * kSlope * kChord * std::pow(kRadius, 4) * kOmega * kOmega * 4 * azimuths;
        average += moment;
        cosine += 2.0 * moment * std::cos(rig.azimuth(k));
        sine += 2.0 * moment * std::sin(rig.azimuth(k));
      }
    }
    EXPECT_NEAR(average, mean, 1e-10 * mean) << mu;
    EXPECT_NEAR(cosine, 0.0, 1e-10 * mean) << mu;
    EXPECT_NEAR(sine, 0.0, 1e-10 * mean) << mu;
  }
}

TEST(BladeAirloadsClosedForm, thrustHarmonicsHaveTheSignsOfTheInflowPorts) {
  // Cyclic pitch theta1s lifts the right side (psi = 90 deg): Cs = int r sin psi dCT = sigma a / 2 theta1s / 8, nothing else; theta1c likewise.
  AirloadsRig rig(kRotor + "3", kTextbook);
  FlappingRotor rotor{0, 0, 0, 0.03, 0, 0, 0, 0, 0, 0, 0};
  rotor.feed(rig, 0.3);
  Vector loads = rig.output("rotor_loads");
  const double expected = solidity(3) * kSlope / 2.0 * 0.03 / 8.0;
  EXPECT_NEAR(loads[1], expected, 1e-10 * expected);
  EXPECT_NEAR(loads[2], 0.0, 1e-10 * expected);
  rotor.theta1s = 0.0;
  rotor.theta1c = 0.03;
  rotor.feed(rig, 0.3);
  loads = rig.output("rotor_loads");
  EXPECT_NEAR(loads[1], 0.0, 1e-10 * expected);
  EXPECT_NEAR(loads[2], expected, 1e-10 * expected);
}

}  // namespace
}  // namespace heerk_rotor
