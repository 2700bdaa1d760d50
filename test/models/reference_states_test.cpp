// Quadruple-precision states of the lag rotor on its elastic mast (test/data/lag_rotor_reference.json), at t = 0.5, 1, 2,
// 5 and 10 s, for K_s = 3e4..3e7 N m/rad and three rotor speeds.
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

struct Case {
  double stiffness, rotor_speed;
  std::vector<double> t;
  std::vector<std::vector<double>> x;
  std::vector<double> state_max;
};

std::vector<Case> readCases() {
  const YAML::Node file = YAML::LoadFile(std::string(HEERK_SOURCE_DIR) + "/test/data/lag_rotor_reference.json");
  std::vector<Case> cases;
  for (const YAML::Node& node : file["cases"]) {
    Case c{node["K_s"].as<double>(), node["rotor_speed"].as<double>(), {}, {}, node["state_max"].as<std::vector<double>>()};
    c.t = node["t"].as<std::vector<double>>();
    c.x = node["x"].as<std::vector<std::vector<double>>>();
    cases.push_back(c);
  }
  return cases;
}
const std::vector<Case>& cases() {
  static const std::vector<Case> all = readCases();
  return all;
}

struct Accuracy {
  double error = 0.0;                // largest deviation of any state at any instant, over the state's maximum
  double evaluations_per_solve = 0.0;
  bool finished = true;
};

Accuracy run(const Case& c, const std::string& formulation, double h, const Overrides& more = {}) {
  auto simulation = buildSimulation(shipped("lag_rotor.yaml", Overrides{set("simulation.step", h), set("simulation.rotor_speed", c.rotor_speed),
      set("subsystems.mast.stiffness", c.stiffness), "simulation.formulation=" + formulation, "simulation.newton_tolerance=1e-12"} + more));
  Accuracy accuracy;
  for (std::size_t k = 0; k < c.t.size(); ++k) {
    const long target = std::lround(c.t[k] / h);
    if (!advance(*simulation, target - static_cast<long>(simulation->stepCount()))) {
      accuracy.finished = false;
      return accuracy;
    }
    const Vector x = look(*simulation, paperState());
    for (Index i = 0; i < x.size(); ++i) {
      const auto s = static_cast<std::size_t>(i);
      accuracy.error = std::max(accuracy.error, std::abs(x[i] - c.x[k][s]) / c.state_max[s]);
    }
  }
  const SolverCounters& n = simulation->solver().counters();
  accuracy.evaluations_per_solve = static_cast<double>(n.residual_evaluations) / static_cast<double>(n.solves);
  return accuracy;
}

std::string label(const Case& c) { return "K_s " + std::to_string(static_cast<long>(c.stiffness)) + " Omega " + std::to_string(c.rotor_speed).substr(0, 4); }

TEST(ReferenceStates, fileHoldsFourStiffnessesAndThreeSpeeds) {
  ASSERT_EQ(cases().size(), 10u);
  for (const Case& c : cases()) {
    EXPECT_EQ(c.t, (std::vector<double>{0.5, 1, 2, 5, 10}));
    ASSERT_EQ(c.x.size(), 5u);
    for (const auto& x : c.x) EXPECT_EQ(x.size(), 14u);
  }
  // phi_1(10) as printed in lag_rotor.md: the copy of the data is the one meant.
  EXPECT_DOUBLE_EQ(cases()[0].x[4][2], 5.652580697331982e-4);
  EXPECT_DOUBLE_EQ(cases()[3].x[4][2], 2.512391606873492e-3);
}

TEST(ReferenceStates, absoluteLagReachesThemAtStep1e4) {
  for (const Case& c : cases()) {
    const Accuracy a = run(c, "absolute_lag", 1e-4);
    ASSERT_TRUE(a.finished) << label(c);
    report("absolute_lag " + label(c), a.error);
    // Issue 2: <= 1e-7 up to 3e6. At 3e7 the step is h |lambda| = 0.32 of the fastest mode (3226 1/s), whose phase error
    // accumulates over 5000 periods; only the twist and its rate feel it. The bound is a sanity check.
    EXPECT_LE(a.error, c.stiffness <= 3e6 ? 1e-7 : 1e-2) << label(c);
  }
}

TEST(ReferenceStates, printedReachesThemAtStep1e4) {
  for (const Case& c : cases()) {
    const Accuracy a = run(c, "printed", 1e-4);
    ASSERT_TRUE(a.finished) << label(c);
    report("printed " + label(c), a.error);
    // Issue 2: 1e-8, 5e-6, 1e-3. The error of an oscillator that RK4 integrates grows as (h lambda)^4 lambda t, that is by
    // 10^2.5 per decade of K_s; at 3e7 that gives an error of order one in the fast states: finite and bounded is all
    // that can be asked.
    const double bound = c.stiffness < 1e5 ? 1e-8 : c.stiffness < 1e6 ? 5e-6 : c.stiffness < 1e7 ? 1e-3 : 3.0;
    EXPECT_LE(a.error, bound) << label(c);
  }
}

/// Observed order between h and h / 2, for steps at which the error is asymptotic but above round-off.
double observedOrder(const Case& c, const std::string& formulation, double h) {
  return std::log2(run(c, formulation, h).error / run(c, formulation, h / 2).error);
}

TEST(ReferenceStates, bothFormulationsConvergeWithOrderFour) {
  for (const std::size_t i : {0u, 1u, 2u}) {
    const Case& c = cases()[i];
    // h |lambda| <= 0.2 with |lambda| = 114, 326, 1021 1/s
    const double h = c.stiffness < 1e5 ? 2e-3 : c.stiffness < 1e6 ? 5e-4 : 2e-4;
    for (const char* formulation : {"absolute_lag", "printed"}) {
      const double order = observedOrder(c, formulation, h);
      report(std::string("order ") + formulation + " " + label(c), order);
      EXPECT_NEAR(order, 4.0, 0.1) << formulation << ", " << label(c);
    }
  }
}

TEST(ReferenceStates, paperToleranceRuleCostsNoAccuracyThatMatters) {
  const Case& c = cases()[0];
  for (const char* formulation : {"absolute_lag", "printed"}) {
    for (const double h : {1e-3, 1e-4}) {
      const Accuracy tight = run(c, formulation, h);
      const Accuracy paper = run(c, formulation, h, {"simulation.newton_tolerance=paper"});
      ASSERT_TRUE(paper.finished);
      const std::string name = std::string(formulation) + " h " + std::to_string(h);
      report("tolerance 1e-12 " + name, tight.error);
      report("tolerance rule  " + name, paper.error);
      report("evaluations per solve 1e-12 " + name, tight.evaluations_per_solve);
      report("evaluations per solve rule  " + name, paper.evaluations_per_solve);
      EXPECT_LE(paper.evaluations_per_solve, tight.evaluations_per_solve);
      // The rule's tolerance falls like h^4, as the method's error does, so it may cost a factor but no order: measured 6 at
      // most. The absolute-lag form has no loop, hence nothing to be lost.
      EXPECT_LE(paper.error, 10.0 * tight.error) << name;
      if (formulation == std::string("absolute_lag")) {
        EXPECT_EQ(paper.error, tight.error);
      }
    }
  }
}

}  // namespace
}  // namespace heerk_rotor
