// Shafts whose motion is known in closed form.
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "dual_disc.hpp"
#include "heerk_rotor/shaft/diagonal_form.hpp"
#include "heerk_rotor/shaft/energy_coordinates.hpp"
#include "heerk_rotor/shaft/shaft_element.hpp"
#include "measured.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kPi = 3.14159265358979323846;

/// Whirl frequencies at the speed, ascending; modes forward and backward together [rad/s].
std::vector<double> whirl(const ShaftMatrices& shaft, double speed) {
  std::vector<double> frequencies;
  for (const auto& eigenvalue : diagonalForm(energyCoordinates(shaft, speed).H).eigenvalues) frequencies.push_back(static_cast<double>(std::abs(eigenvalue)));
  std::sort(frequencies.begin(), frequencies.end());
  return frequencies;
}

/// The shaft clamped at node 0.
ShaftMatrices clamped(const ShaftMatrices& shaft) {
  const Eigen::Index n = shaft.size() - kShaftNodeDofs;
  return {shaft.M.bottomRightCorner(n, n), shaft.C.bottomRightCorner(n, n), shaft.G.bottomRightCorner(n, n), shaft.K.bottomRightCorner(n, n), shaft.unbalance.bottomRows(n)};
}

struct Section {
  double EI, GA, rho_A, rho_I;  // GA with the shear coefficient
};
Section section(const ShaftProperties& p) {
  const double d = p.diameter.front(), area = kPi / 4.0 * d * d, I = kPi / 64.0 * d * d * d * d;
  const double kappa = 6.0 * (1.0 + p.poisson_ratio) / (7.0 + 6.0 * p.poisson_ratio);
  return {p.youngs_modulus * I, kappa * p.youngs_modulus / (2.0 * (1.0 + p.poisson_ratio)) * area, p.density * area, p.density * I};
}

/// Relative error of the first three frequencies with n elements and with 2 n.
struct Convergence {
  double coarse, fine;
};
template <class Exact>
Convergence converge(bool shear, double speed, const Exact& exact) {
  const auto error = [&](int n) {
    ShaftProperties p = uniformShaft(n);
    p.shear = shear;
    const std::vector<double> found = whirl(assembleShaft(p), speed);
    std::vector<double> expected;
    for (int k = 1; k <= 3; ++k)
      for (const double root : exact(section(p), k * kPi / 2.0)) expected.push_back(std::abs(root));
    std::sort(expected.begin(), expected.end());
    double worst = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) worst = std::max(worst, std::abs(found[i] / expected[i] - 1.0));
    return worst;
  };
  return {error(8), error(16)};
}

TEST(ClosedForms, uniformShaftWithRotaryInertiaWhirlsAsRayleighSays) {
  // z = x + i y = sin(k s) e^{i l t}: -l^2 (rho A + rho I k^2) + 2 rho I k^2 Omega l + E I k^4 = 0; forward l > 0, backward l < 0.
  const double speed = 3000.0;  // [rad/s], fast enough that forward and backward differ by percents
  const Convergence error = converge(false, speed, [&](const Section& s, double k) {
    const double a = s.rho_A + s.rho_I * k * k, b = s.rho_I * k * k * speed, c = s.EI * k * k * k * k;
    const double root = std::sqrt(b * b + a * c);
    return std::vector<double>{(b + root) / a, (b - root) / a};
  });
  report("Rayleigh shaft, 8 elements", error.coarse);
  report("Rayleigh shaft, 16 elements", error.fine);
  // The cubic element's frequencies are (k h)^4 / 1440 too high, k h = 3 pi / 8 and half of it.
  EXPECT_NEAR(error.coarse, std::pow(3.0 * kPi / 8.0, 4) / 1440.0, 0.2 * error.coarse);
  EXPECT_NEAR(error.coarse / error.fine, 16.0, 1.5);
}

/// The Timoshenko element is exact for loads at its nodes, so its shear force is constant; that of the mode varies, which makes the shear's
/// share s = E I k^2 / GA / (1 + ..) of the compliance (k h)^2 / 12 too stiff: frequencies s (k h)^2 / 24 too high, and the bending
/// error on top. The third mode is the worst; s = 4 %.
void expectShearError(const Convergence& error) {
  const Section s = section(uniformShaft(1));
  const double k = 1.5 * kPi, compliance = s.EI * k * k / s.GA, share = compliance / (1.0 + compliance);
  for (const auto& [found, elements] : {std::pair<double, double>{error.coarse, 8.0}, {error.fine, 16.0}}) {
    const double kh = k * 2.0 / elements;
    EXPECT_NEAR(found, share * kh * kh / 24.0 + std::pow(kh, 4) / 1440.0, 0.1 * found) << elements << " elements";
  }
}

TEST(ClosedForms, uniformTimoshenkoShaftHasItsFrequencies) {
  // rho A rho I / GA l^4 - (rho A + rho I k^2 + rho A E I k^2 / GA) l^2 + E I k^4 = 0, the lower root, both planes.
  const Convergence error = converge(true, 0.0, [](const Section& s, double k) {
    const double a = s.rho_A * s.rho_I / s.GA, b = s.rho_A + s.rho_I * k * k + s.rho_A * s.EI * k * k / s.GA, c = s.EI * k * k * k * k;
    const double low = std::sqrt(2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c)));
    return std::vector<double>{low, low};
  });
  report("Timoshenko shaft, 8 elements", error.coarse);
  report("Timoshenko shaft, 16 elements", error.fine);
  expectShearError(error);
}

TEST(ClosedForms, rotatingTimoshenkoShaft) {
  // With gyroscopic moments: the tilt's inertia rho I (l^2 - 2 Omega l) in place of rho I l^2.
  const double speed = 3000.0;
  const Convergence error = converge(true, speed, [&](const Section& s, double k) {
    std::vector<double> roots;
    for (const double sign : {1.0, -1.0}) {
      // (GA k^2 - rho A l^2)(E I k^2 + GA - rho I (l^2 - 2 Omega l)) = GA^2 k^2 by Newton from the Euler-Bernoulli value.
      double l = sign * std::sqrt(s.EI / s.rho_A) * k * k;
      for (int i = 0; i < 50; ++i) {
        const double first = s.GA * k * k - s.rho_A * l * l, second = s.EI * k * k + s.GA - s.rho_I * (l * l - 2.0 * speed * l);
        const double f = first * second - s.GA * s.GA * k * k;
        l -= f / (-2.0 * s.rho_A * l * second - first * s.rho_I * (2.0 * l - 2.0 * speed));
      }
      roots.push_back(l);
    }
    return roots;
  });
  report("rotating Timoshenko shaft, 8 elements", error.coarse);
  report("rotating Timoshenko shaft, 16 elements", error.fine);
  expectShearError(error);
}

TEST(ClosedForms, cantileverBendsAndShearsUnderATipForce) {
  // P l^3 / 3 E I + P l / GA and slope P l^2 / 2 E I, exact at the nodes with any number of elements.
  for (const bool shear : {false, true})
    for (const int n : {1, 5}) {
      ShaftProperties p = uniformShaft(n, 0.3, 0.1);
      p.shear = shear;
      p.bearings.clear();
      const ShaftMatrices shaft = clamped(assembleShaft(p));
      const Section s = section(p);
      const ShaftMatrix flexibility = shaft.K.llt().solve(ShaftMatrix::Identity(shaft.size(), shaft.size()));
      const Eigen::Index tip = shaft.size() - kShaftNodeDofs;
      const double l = 0.3, deflection = l * l * l / (3.0 * s.EI) + (shear ? l / s.GA : 0.0), slope = l * l / (2.0 * s.EI);
      EXPECT_NEAR(static_cast<double>(flexibility(tip + kShaftX, tip + kShaftX)), deflection, 1e-13 * deflection);
      EXPECT_NEAR(static_cast<double>(flexibility(tip + kShaftY, tip + kShaftY)), deflection, 1e-13 * deflection);
      EXPECT_NEAR(static_cast<double>(flexibility(tip + kShaftTiltY, tip + kShaftX)), slope, 1e-13 * slope);
      EXPECT_NEAR(static_cast<double>(flexibility(tip + kShaftTiltX, tip + kShaftY)), -slope, 1e-13 * slope);
    }
}

TEST(ClosedForms, shearCoefficientsOfCowper) {
  // Solid: 6 (1 + nu) / (7 + 6 nu); thin tube: 2 (1 + nu) / (4 + 3 nu).
  EXPECT_NEAR(static_cast<double>(shearCoefficient(1, 0, 0.3L)), 6.0 * 1.3 / 8.8, 1e-15);
  EXPECT_NEAR(static_cast<double>(shearCoefficient(1, 1 - 1e-9L, 0.3L)), 2.0 * 1.3 / 4.9, 1e-9);
}

TEST(ClosedForms, boreTakesMassAndStiffness) {
  ShaftProperties solid = uniformShaft(4), tube = solid, core = solid;
  tube.inner_diameter = {0.06};
  core.diameter = {0.06};
  for (ShaftProperties* p : {&solid, &tube, &core}) p->bearings.clear();
  const ShaftMatrices a = assembleShaft(solid), b = assembleShaft(tube), c = assembleShaft(core);
  EXPECT_LE(static_cast<double>((a.M - b.M - c.M).norm()), 1e-15 * static_cast<double>(a.M.norm()));
  EXPECT_LE(static_cast<double>((a.K - b.K - c.K).norm()), 1e-15 * static_cast<double>(a.K.norm()));
  EXPECT_LE(static_cast<double>((a.G - b.G - c.G).norm()), 1e-15 * static_cast<double>(a.G.norm()));
}

TEST(ClosedForms, overhungDiscOnAMasslessShaft) {
  // (12 E I / l^3 - m w^2)(4 E I / l - J_d w^2 + J_p Omega w) = (6 E I / l^2)^2, four roots: two forward, two backward.
  const double l = 0.5, m = 8.0, diametral = 0.03, polar = 0.055, speed = 800.0;
  ShaftProperties p = uniformShaft(3, l, 0.03);
  p.bearings.clear();
  p.density = 1e-7;  // mass of the shaft over that of the disc: 4e-12
  p.discs = {{3, m, diametral, polar, 0.0, 0.0}};
  const std::vector<double> found = whirl(clamped(assembleShaft(p)), speed);
  const double EI = section(p).EI, k11 = 12.0 * EI / (l * l * l), k12 = 6.0 * EI / (l * l), k22 = 4.0 * EI / l;
  // m J_d w^4 - m J_p Omega w^3 - (m k22 + J_d k11) w^2 + k11 J_p Omega w + k11 k22 - k12^2 = 0, companion matrix.
  const double lead = m * diametral;
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.topRightCorner<3, 3>().setIdentity();
  companion.row(3) << -(k11 * k22 - k12 * k12) / lead, -k11 * polar * speed / lead, (m * k22 + diametral * k11) / lead, polar * speed / diametral;
  std::vector<double> expected;
  for (const auto& root : companion.eigenvalues()) {
    double w = root.real();
    for (int i = 0; i < 3; ++i) {  // the companion matrix, whose entries span ten decades, leaves 1e-8
      const double first = k11 - m * w * w, second = k22 - diametral * w * w + polar * speed * w;
      w -= (first * second - k12 * k12) / (-2.0 * m * w * second + first * (polar * speed - 2.0 * diametral * w));
    }
    expected.push_back(std::abs(w));
  }
  std::sort(expected.begin(), expected.end());
  for (std::size_t i = 0; i < 4; ++i) {
    report("overhung disc, frequency " + std::to_string(i + 1), found[i]);
    EXPECT_NEAR(found[i], expected[i], 1e-9 * expected[i]);
  }
}

TEST(ClosedForms, gyroscopicMomentTurnsWithTheRotor) {
  // A disc tilted at the rate r about y, turning with omega > 0 about z, needs the moment J_p omega r about +x (d/dt of J_p omega times
  // the axis' x component): the equation's -omega G[tilt_x, tilt_y] must be +omega J_p.
  ShaftProperties p = uniformShaft(1);
  p.density = 1e-9;
  p.discs = {{1, 1.0, 0.5, 0.7, 0.0, 0.0}};
  const ShaftMatrices shaft = assembleShaft(p);
  EXPECT_NEAR(static_cast<double>(-shaft.G(shaftRow(1, kShaftTiltX), shaftRow(1, kShaftTiltY))), 0.7, 1e-9);
  EXPECT_NEAR(static_cast<double>(-shaft.G(shaftRow(1, kShaftTiltY), shaftRow(1, kShaftTiltX))), -0.7, 1e-9);
}

TEST(ClosedForms, anisotropicBearingsGiveTheFrequenciesOfBothPlanes) {
  ShaftProperties both = dualDisc(), soft = both, stiff = both;
  for (std::size_t i : {0u, 1u}) {
    both.bearings[i].stiffness_x = soft.bearings[i].stiffness_x = soft.bearings[i].stiffness_y = 2e6 + 1e6 * static_cast<double>(i);
    both.bearings[i].stiffness_y = stiff.bearings[i].stiffness_x = stiff.bearings[i].stiffness_y = 9e6;
  }
  const std::vector<double> found = whirl(assembleShaft(both), 0.0);
  std::vector<double> expected;
  for (const ShaftProperties* p : {&soft, &stiff}) {
    const std::vector<double> twice = whirl(assembleShaft(*p), 0.0);
    for (std::size_t i = 0; i < twice.size(); i += 2) expected.push_back(twice[i]);
  }
  std::sort(expected.begin(), expected.end());
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(found[i], expected[i], 1e-11 * expected[i]);
  EXPECT_GT(found[1] / found[0], 1.1);  // they are not the same twice
}

TEST(ClosedForms, bearingDamperDampsTheRigidShaft) {
  // A stiff light shaft with one disc between two equal bearings: m x'' + 2 c x' + 2 k x = 0, bouncing.
  ShaftProperties p = uniformShaft(2, 0.2, 0.2);
  p.density = 1e-3;
  p.youngs_modulus = 1e14;
  p.discs = {{1, 10.0, 0.1, 0.15, 0.0, 0.0}};
  p.bearings = {{0, 1e4, 1e4, 25.0, 10.0}, {2, 1e4, 1e4, 25.0, 10.0}};
  const DiagonalForm modes = diagonalForm(energyCoordinates(assembleShaft(p), 100.0).H);
  for (const double damping : {50.0, 20.0}) {
    const double real = -0.5 * damping / 10.0, imaginary = std::sqrt(2e4 / 10.0 - real * real);
    double nearest = 1e9;
    for (const auto& eigenvalue : modes.eigenvalues) nearest = std::min(nearest, static_cast<double>(std::abs(eigenvalue - std::complex<ShaftReal>(real, imaginary))));
    EXPECT_LE(nearest, 1e-5 * imaginary) << damping;  // flexibility of the shaft, 2 k l^3 / 48 E I = 5e-8, and its mass
  }
}

TEST(ClosedForms, whatHasNoDiagonalFormIsRefused) {
  ShaftMatrix critical(4, 4);  // two oscillators at critical damping
  critical << 0, 0, 1, 0, 0, 0, 0, 2, -1, 0, -2, 0, 0, -2, 0, -4;
  EXPECT_THROW(diagonalForm(critical), std::runtime_error);
  ShaftMatrix real(2, 2);  // two real eigenvalues, -1 and -3
  real << -2, 1, 1, -2;
  const DiagonalForm form = diagonalForm(real);
  EXPECT_EQ(form.blocks[0](0, 1), 0.0);
  EXPECT_NEAR(form.blocks[0](0, 0), -1.0, 1e-15);
  EXPECT_NEAR(form.blocks[0](1, 1), -3.0, 1e-15);
}

TEST(ClosedForms, aShaftThatNothingHoldsIsRefused) {
  ShaftProperties p = dualDisc();
  p.bearings.pop_back();  // one bearing: the shaft may tilt about it
  EXPECT_THROW(energyCoordinates(assembleShaft(p), 100.0), std::invalid_argument);
}

TEST(ClosedForms, everyProblemIsTold) {
  ShaftProperties p = dualDisc();
  p.segments[2] = -1.0;
  p.discs[0].node = 9;
  p.discs[1].polar_inertia = 1.0;
  p.bearings[0].stiffness_x = -5.0;
  EXPECT_EQ(shaftProblems(p).size(), 4u);
  EXPECT_THROW(assembleShaft(p), std::invalid_argument);
  EXPECT_TRUE(shaftProblems(dualDisc()).empty());
}

}  // namespace
}  // namespace heerk_rotor
