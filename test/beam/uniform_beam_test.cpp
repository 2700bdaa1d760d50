#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "heerk_rotor/beam/blade_modes.hpp"

#include "blade_data.hpp"
#include "frobenius_beam.hpp"

namespace heerk_rotor {
namespace {

BladeModes modesOf(const BladeProperties& p, double omega) {
  const BladeMatrices blade = assembleBlade(p);
  return bladeModes(blade, blade.stiffness(omega));
}

double frequency(const BladeModes& modes, const std::string& name) { return modes.omega[modes.index(name)]; }

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5f", value);
  return text;
}

struct CantileverRow {
  double eta;
  const char* exact[3];
  const char* fe10[3];
};

// Flap frequencies; Wright, Smith, Thresher & Wang, J. Appl. Mech. 49 (1982) 197 print the exact ones to three decimals.
const CantileverRow kCantilever[] = {
    {0, {"3.51602", "22.03449", "61.69721"}, {"3.51602", "22.03522", "61.71292"}},
    {2, {"4.13732", "22.61492", "62.27318"}, {"4.13732", "22.61563", "62.28875"}},
    {6, {"7.36037", "26.80908", "66.68391"}, {"7.36041", "26.80981", "66.69872"}},
    {12, {"13.17015", "37.60311", "79.61448"}, {"13.17058", "37.60499", "79.63014"}},
};

TEST(UniformBeam, cantileverTableHoldsToAllPrintedDigits) {
  for (const CantileverRow& row : kCantilever) {
    const BladeModes modes = modesOf(uniformBlade(10), row.eta);
    FrobeniusBeam beam;
    beam.eta = row.eta;
    const std::vector<double> exact = beam.eigenvalues(3);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(digits(frequency(modes, "F" + std::to_string(k + 1))), row.fe10[k]) << "eta " << row.eta;
      EXPECT_EQ(digits(std::sqrt(exact[k])), row.exact[k]) << "eta " << row.eta;
    }
  }
}

TEST(UniformBeam, hingedBladeAtEtaTwelve) {
  FrobeniusBeam beam;
  beam.eta = 12;
  beam.hinged = true;
  const std::vector<double> exact = beam.eigenvalues(3);
  const char* printed[] = {"12.00000", "33.76030", "70.83732"};
  BladeProperties p = uniformBlade(40);
  p.root.flap_hinge = true;
  const BladeModes modes = modesOf(p, 12);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(digits(std::sqrt(exact[k])), printed[k]);
    EXPECT_NEAR(frequency(modes, "F" + std::to_string(k + 1)), std::sqrt(exact[k]), 1e-6 * std::sqrt(exact[k]));
  }
  EXPECT_NEAR(frequency(modes, "F1"), 12.0, 1e-12);  // w = r is in the space of the elements
}

TEST(UniformBeam, bendingConvergesWithFourthOrder) {
  // Worst relative error of modes 1..3 over the table's eta. It is mode 3 at rest, which the table itself gives for n = 10:
  // (61.71292 - 61.69721) / 61.69721 = 2.5e-4.
  const double expected[] = {3.59e-3, 2.54e-4, 1.64e-5, 1.03e-6};
  double before = 0;
  for (int i = 0; i < 4; ++i) {
    double worst = 0;
    for (const CantileverRow& row : kCantilever) {
      FrobeniusBeam beam;
      beam.eta = row.eta;
      const std::vector<double> exact = beam.eigenvalues(3);
      const BladeModes modes = modesOf(uniformBlade(5 << i), row.eta);
      for (int k = 0; k < 3; ++k)
        worst = std::max(worst, std::abs(frequency(modes, "F" + std::to_string(k + 1)) / std::sqrt(exact[k]) - 1));
    }
    EXPECT_NEAR(worst, expected[i], 0.01 * expected[i]) << (5 << i) << " elements";
    if (i > 0) {
      EXPECT_NEAR(before / worst, 16, 2) << (5 << i) << " elements";
    }
    before = worst;
  }
}

TEST(UniformBeam, articulatedRigidBladeHasItsHingeFrequencies) {
  // nu_flap^2 = 1 + 1.5 e / (1 - e), nu_lag^2 = 1.5 e / (1 - e) for hinges at e R; the blade is stiff enough to be rigid.
  BladeProperties p = uniformBlade(10, 0.05);
  p.EI_flap = {1e6};
  p.EI_lag = {1e6};
  p.GJ = {1e6};
  p.root.flap_hinge = p.root.lag_hinge = true;
  const BladeModes modes = modesOf(p, 1.0);
  EXPECT_NEAR(frequency(modes, "F1"), 1.038724, 5e-7);
  EXPECT_NEAR(frequency(modes, "L1"), 0.280976, 5e-7);
  EXPECT_NEAR(frequency(modes, "F1"), std::sqrt(1 + 1.5 * 0.05 / 0.95), 1e-7);
  EXPECT_NEAR(frequency(modes, "L1"), std::sqrt(1.5 * 0.05 / 0.95), 1e-7);
}

TEST(UniformBeam, hingeSpringsAddTheirStiffness) {
  // I nu^2 = I nu_0^2 + k for a rigid blade, I = m l^3 / 3 about the hinge.
  BladeProperties p = uniformBlade(6, 0.05);
  p.EI_flap = {1e6};
  p.EI_lag = {1e6};
  p.GJ = {1e6};
  p.root.flap_hinge = p.root.lag_hinge = true;
  p.root.flap_spring = 0.02;
  p.root.lag_spring = 0.07;
  p.root.lag_damper = 0.3;
  const double inertia = std::pow(0.95, 3) / 3;
  const BladeMatrices blade = assembleBlade(p);
  const BladeModes modes = bladeModes(blade, blade.stiffness(1.0));
  EXPECT_NEAR(frequency(modes, "F1"), std::sqrt(1 + 1.5 * 0.05 / 0.95 + 0.02 / inertia), 1e-7);
  EXPECT_NEAR(frequency(modes, "L1"), std::sqrt(1.5 * 0.05 / 0.95 + 0.07 / inertia), 1e-7);
  // The damper acts on the lag angle alone: V' C V = d / I there.
  const Eigen::MatrixXd D = modes.project(blade.C_hinge);
  EXPECT_NEAR(D(modes.index("L1"), modes.index("L1")), 0.3 / inertia, 1e-6);
  EXPECT_LT(std::abs(D(modes.index("F1"), modes.index("F1"))), 1e-12);
}

TEST(UniformBeam, torsionConvergesWithSecondOrderToTheTennisRacketSolution) {
  // Uniform blade without kA: omega^2 = GJ / (m (km1^2 + km2^2)) (pi / 2 l)^2 + Omega^2 (km2^2 - km1^2) / (km1^2 + km2^2).
  const double expected[] = {9.4e-4, 2.4e-4, 5.9e-5};
  for (int i = 0; i < 3; ++i) {
    BladeProperties p = bo105Blade();
    p.nodes = equalNodes(10 << i, 0.20, 4.91);
    p.stations.clear();
    p.mass = {5.55};
    p.EI_flap = {8700};
    p.EI_lag = {82000};
    p.GJ = {5800};
    p.kA = {0.0};
    p.twist = {0.0};
    const double sum = 0.0075 * 0.0075 + 0.0730 * 0.0730, difference = 0.0730 * 0.0730 - 0.0075 * 0.0075;
    const double wave = M_PI / 2 / 4.71;
    const double exact = std::sqrt(5800 / (5.55 * sum) * wave * wave + kBo105Omega * kBo105Omega * difference / sum);
    const double error = frequency(modesOf(p, kBo105Omega), "T1") / exact - 1;
    EXPECT_NEAR(error, expected[i], 0.05e-4) << (10 << i) << " elements";
  }
}

struct OffsetCase {
  double eta, root, tip_mass;
};

TEST(UniformBeam, tipMassAndHubOffsetAgreeWithThePowerSeries) {
  // 40 elements: bending error 1e-6 (see above) in the third mode, less below.
  for (const OffsetCase& c : {OffsetCase{6, 0.0, 0.3}, OffsetCase{6, 0.1, 0.0}, OffsetCase{12, 0.2, 0.15}, OffsetCase{0, 0.1, 1.0}}) {
    BladeProperties p = uniformBlade(40, c.root);
    p.tip_mass = c.tip_mass;
    FrobeniusBeam beam;
    beam.eta = c.eta;
    beam.root = c.root;
    beam.tip_mass = c.tip_mass;
    const std::vector<double> exact = beam.eigenvalues(3);
    const BladeModes flap = modesOf(p, c.eta);
    // The same beam on edge: soft in plane, where lambda = omega^2 + eta^2.
    p.EI_flap = {1e4};
    p.EI_lag = {1.0};
    const BladeModes lag = modesOf(p, c.eta);
    for (int k = 0; k < 3; ++k) {
      const std::string number = std::to_string(k + 1);
      EXPECT_NEAR(frequency(flap, "F" + number) / std::sqrt(exact[k]), 1, 2e-6) << "eta " << c.eta << " root " << c.root;
      const double in_plane = std::sqrt(exact[k] - c.eta * c.eta);
      EXPECT_NEAR(frequency(lag, "L" + number) / in_plane, 1, 2e-6) << "eta " << c.eta << " root " << c.root;
    }
  }
}

TEST(UniformBeam, ninetyDegreesOfPitchExchangeFlapAndLag) {
  BladeProperties p = uniformBlade(10);
  const BladeMatrices blade = assembleBlade(p);
  const BladeModes turned = bladeModes(blade, blade.stiffness(6, M_PI / 2));
  p.EI_flap = {1e4};
  p.EI_lag = {1.0};
  const BladeModes edge = modesOf(p, 6);
  EXPECT_NEAR(frequency(turned, "F1") / frequency(edge, "L1"), 1, 1e-12);
  EXPECT_NEAR(frequency(turned, "F2") / frequency(edge, "L2"), 1, 1e-12);
}

}  // namespace
}  // namespace heerk_rotor
