#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "heerk_rotor/beam/blade_modes.hpp"

#include "blade_data.hpp"

namespace heerk_rotor {
namespace {

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4f", value);
  return text;
}

/// Expects the per-rev frequencies, to all printed digits, in this order.
void expectPerRev(const BladeProperties& p, double omega, double pitch, const std::vector<std::pair<std::string, std::string>>& rows) {
  const BladeMatrices blade = assembleBlade(p);
  const BladeModes modes = bladeModes(blade, blade.stiffness(omega, pitch));
  for (const auto& [name, value] : rows) EXPECT_EQ(digits(modes.omega[modes.index(name)] / omega), value) << name;
}

TEST(RotorBlade, bo105PerRevFrequenciesWithTenElements) {
  expectPerRev(bo105Blade(), kBo105Omega, 0,
               {{"L1", "0.7502"}, {"F1", "1.1200"}, {"F2", "2.8539"}, {"T1", "3.8603"}, {"L2", "3.9837"}, {"F3", "5.1972"}});
}

TEST(RotorBlade, bo105PerRevFrequenciesWithEightyElements) {
  expectPerRev(bo105Blade(8), kBo105Omega, 0,
               {{"L1", "0.7488"}, {"F1", "1.1196"}, {"F2", "2.8529"}, {"T1", "3.8400"}, {"L2", "3.9797"}, {"F3", "5.1936"}});
}

TEST(RotorBlade, hart2PerRevFrequencies) {
  expectPerRev(hart2Blade(), kHart2Omega, 0,
               {{"L1", "0.7753"}, {"F1", "1.1185"}, {"F2", "2.8371"}, {"T1", "3.8675"}, {"L2", "4.5951"}, {"F3", "5.1068"}});
}

TEST(RotorBlade, collectiveCouplesFlapAndLag) {
  expectPerRev(bo105Blade(), kBo105Omega, 0 * M_PI / 180, {{"L1", "0.7502"}, {"F1", "1.1200"}});
  expectPerRev(bo105Blade(), kBo105Omega, 5 * M_PI / 180, {{"L1", "0.7436"}, {"F1", "1.1244"}});
  expectPerRev(bo105Blade(), kBo105Omega, 10 * M_PI / 180, {{"L1", "0.7330"}, {"F1", "1.1313"}});
  expectPerRev(bo105Blade(), kBo105Omega, 15 * M_PI / 180, {{"L1", "0.7190"}, {"F1", "1.1402"}});
}

TEST(RotorBlade, stiffestEigenvalueMassAndInertia) {
  const BladeMatrices blade = assembleBlade(bo105Blade());
  EXPECT_EQ(blade.size(), 50);
  const BladeModes modes = bladeModes(blade, blade.stiffness(kBo105Omega));
  EXPECT_NEAR(modes.omega[49], 6.11e5, 0.005e5);
  const BladeInertia inertia = bladeInertia(bo105Blade());
  EXPECT_NEAR(inertia.mass, 30.9, 0.05);
  EXPECT_NEAR(inertia.second_moment, 219.6, 0.05);
  // Damping of the first lag mode 0.75 %, of the stiffest 3 %.
  EXPECT_NEAR(modes.damping[0] / (2 * modes.omega[0]), 0.0075, 0.00005);
  EXPECT_NEAR(modes.damping[49] / (2 * modes.omega[49]), 0.03, 0.001);
}

TEST(RotorBlade, massAndStiffnessAreSymmetricAndPositiveDefinite) {
  for (double pitch : {0.0, 0.2}) {
    const BladeMatrices blade = assembleBlade(bo105Blade());
    const BeamMatrix K = blade.stiffness(kBo105Omega, pitch);
    EXPECT_EQ((K - K.transpose()).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ((blade.M - blade.M.transpose()).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ((blade.G + blade.G.transpose()).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ(Eigen::LLT<BeamMatrix>(K).info(), Eigen::Success);
    EXPECT_EQ(Eigen::LLT<BeamMatrix>(blade.M).info(), Eigen::Success);
  }
}

TEST(RotorBlade, pitchIsANonstiffChangeInPitchedAxes) {
  // Without offsets the change turns v and w with Omega^2 [[sin^2, sin cos], [sin cos, -sin^2]], whose eigenvalues are
  // +-Omega^2 sin(theta): 342 1/s^2 for 10 deg, more than the change of the tennis-racket term (250), and nine decades below
  // omega_max^2. This is what makes a constant S possible.
  const double pitch = 10 * M_PI / 180;
  const BladeMatrices blade = assembleBlade(bo105Blade());
  const BeamMatrix change = blade.stiffness(kBo105Omega, pitch) - blade.stiffness(kBo105Omega);
  const Eigen::GeneralizedSelfAdjointEigenSolver<BeamMatrix> solver(change, blade.M, Eigen::EigenvaluesOnly);
  const double largest = static_cast<double>(solver.eigenvalues().cwiseAbs().maxCoeff());
  EXPECT_NEAR(largest, kBo105Omega * kBo105Omega * std::sin(pitch), 1e-6);
}

/// Per-rev frequencies of the lowest two modes with Coriolis coupling at precone.
std::pair<double, double> conedPerRev(const BladeMatrices& blade, BeamReal stiffness_precone, double axial_rate) {
  const BladeModes modes = bladeModes(blade, blade.stiffness(kBo105Omega, 0, stiffness_precone));
  const int n = static_cast<int>(modes.size());
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(2 * n, 2 * n);  // x = (omega q, q.)
  S.topRightCorner(n, n).diagonal() = modes.omega;
  S.bottomLeftCorner(n, n).diagonal() = -modes.omega;
  S.bottomRightCorner(n, n) = -2 * axial_rate * modes.project(blade.G);
  std::vector<double> found;
  const Eigen::VectorXcd eigenvalues = S.eigenvalues();
  for (int i = 0; i < 2 * n; ++i)
    if (eigenvalues[i].imag() > 0) found.push_back(eigenvalues[i].imag() / kBo105Omega);
  std::sort(found.begin(), found.end());
  return {found[0], found[1]};
}

TEST(RotorBlade, preconeCoriolisShiftsLagAndFlap) {
  const BladeMatrices blade = assembleBlade(bo105Blade());
  const double precone = 2.5 * M_PI / 180;
  const auto [lag, flap] = conedPerRev(blade, precone, kBo105Omega * std::sin(precone));
  EXPECT_NEAR(lag, 0.74449, 5e-6);
  EXPECT_NEAR(flap, 1.12420, 5e-6);
  const auto [lag_first_order, flap_first_order] = conedPerRev(blade, 0, kBo105Omega * precone);
  EXPECT_EQ(digits(lag_first_order), "0.7461");
  EXPECT_EQ(digits(flap_first_order), "1.1261");
}

}  // namespace
}  // namespace heerk_rotor
