// The coupled lag rotor against the monolithic equation (HEERK paper, A.2), which shares no code with it.
#include "heerk_rotor/models/monolithic_lag_rotor.hpp"

#include <random>

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

Configuration monolithic(double stiffness, const std::string& linear_part, const Overrides& more = {}) {
  return Configuration::parse("simulation: {integrator: HEERK4, rotor_speed: 6.63, step: 1.0e-3}\n"
                              "subsystems:\n  rotor: {type: monolithic_lag_rotor, linear_part: " + linear_part + ", initial: {lag_1: 0.01}}\n",
                              "monolithic", Overrides{set("subsystems.rotor.mast_stiffness", stiffness)} + more);
}

TEST(MonolithicLagRotor, derivativesEqualThoseOfTheCoupledSystem) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double stiffness : {3e4, 3e8}) {
    for (const char* formulation : {"printed", "absolute_lag"}) {
      ReducedOde coupled(shipped("lag_rotor.yaml", {set("subsystems.mast.stiffness", stiffness), std::string("simulation.formulation=") + formulation}), 1e-15);
      ReducedOde single(monolithic(stiffness, "zero"));
      const LagRotorConstants c((LagRotorParameters()));
      const double g = formulation == std::string("printed") ? 0.0 : c.g;
      double worst = 0.0;
      for (int sample = 0; sample < 200; ++sample) {
        const double t = 10.0 * unit(random);
        Vector paper(14);
        for (Index i = 0; i < 14; ++i) paper[i] = 0.2 * unit(random);
        Vector x = Vector::Zero(14);
        putPaperState(coupled.system, paper, g, x);
        const Vector found = coupled(t, x), expected = single(t, paper);
        Vector expected_coupled = Vector::Zero(14);
        putPaperState(coupled.system, expected, g, expected_coupled);
        worst = std::max(worst, (found - expected_coupled).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff());
      }
      report(std::string("derivatives, ") + formulation + ", K_s " + std::to_string(static_cast<long>(stiffness)), worst);
      // The LU of the monolithic mass matrix finds 1/kappa = 1/682 as a difference of numbers near 1, so its accelerations
      // carry a relative error of kappa times a few units of round-off, 2.2e-16 each.
      EXPECT_LE(worst, 4.0 * 682.0 * 2.2e-16);
    }
  }
}

TEST(MonolithicLagRotor, trajectoriesEqualThoseOfTheCoupledSystem) {
  const std::vector<std::string> single_state{"rotor.fuselage_x", "rotor.fuselage_y", "rotor.lag_1", "rotor.lag_2", "rotor.lag_3", "rotor.lag_4", "rotor.twist",
      "rotor.fuselage_x_rate", "rotor.fuselage_y_rate", "rotor.lag_rate_1", "rotor.lag_rate_2", "rotor.lag_rate_3", "rotor.lag_rate_4", "rotor.twist_rate"};
  for (const char* formulation : {"printed", "absolute_lag"}) {
    double previous = 0.0;
    for (const double h : {4e-4, 2e-4, 1e-4}) {
      auto coupled = buildSimulation(shipped("lag_rotor.yaml", {set("simulation.step", h), std::string("simulation.formulation=") + formulation, "simulation.newton_tolerance=1e-13"}));
      auto single = buildSimulation(monolithic(3e4, "exact", {set("simulation.step", h)}));
      const long n = std::lround(5.0 / h);
      ASSERT_TRUE(advance(*coupled, n) && advance(*single, n));
      const Vector a = look(*coupled, paperState()), b = look(*single, single_state);
      const double difference = (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
      report(std::string("trajectory difference, ") + formulation + ", h " + std::to_string(h), difference);
      // Two discretisations of the same system: the difference falls with h^4, far above round-off (1e-12).
      if (previous > 0.0) {
        EXPECT_NEAR(std::log2(previous / difference), 4.0, 0.3) << formulation << ", " << h;
      }
      previous = difference;
    }
    EXPECT_LE(previous, 1e-8) << formulation;
  }
}

TEST(MonolithicLagRotor, exactLinearPartIsTheColumnOfLagRotorMd) {
  MonolithicLagRotor::Parameters p;
  const Matrix S = stiffMatrix(MonolithicLagRotor(p).stiffPart());
  const double omega_s2 = p.mast_stiffness / 1966.204;
  const double column[] = {-0.18, 0.0, 705.50, 705.46, 705.50, 705.53, -681.77};
  for (int i = 0; i < 7; ++i) EXPECT_NEAR(S(7 + i, 6) / omega_s2, column[i], 0.0051) << i;  // two decimals published
  // Nothing else but the identity that makes rates of positions.
  Matrix rest = S;
  rest.block(7, 6, 7, 1).setZero();
  rest.topRightCorner(7, 7) -= Matrix::Identity(7, 7);
  EXPECT_EQ(rest.cwiseAbs().maxCoeff(), 0.0);
  p.linear_part = MonolithicLagRotor::LinearPart::kPaper;
  const Matrix paper = stiffMatrix(MonolithicLagRotor(p).stiffPart());
  EXPECT_NEAR(paper(9, 6) / omega_s2, 705.0, 1e-9);
  EXPECT_NEAR(paper(13, 6) / omega_s2, -680.0, 1e-9);
}

}  // namespace
}  // namespace heerk_rotor
