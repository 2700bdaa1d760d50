// Tables 1 to 4 of the HEERK paper and the table of the absolute-lag form (lag_rotor.md, sections 4 and 5), at
// Omega = 6.63 rad/s, omega_b = 1.5 and omega_x = omega_y = 3 rad/s, phi_1(0) = 0.01 rad, t = 0..10 s.
#include <map>

#include "models/stability.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kOneDegree = M_PI / 180.0 / 6.63;  // [s]
const double kStiffness[] = {3e4, 3e5, 3e6, 3e7, 3e8};
long stepsOf(double h) { return std::lround(std::floor(10.0 / h + 1e-9)); }

/// phi_1 at every n-th step; shorter when the run failed.
std::vector<double> lagOfBlade1(const Configuration& configuration, long steps, std::uint64_t every = 1) {
  auto simulation = buildSimulation(configuration);
  Recorder record(*simulation, {"rotor.lag_1"}, every);
  if (advance(*simulation, steps)) simulation->observe(simulation->system().defaultCommand());
  std::vector<double> lag;
  for (const Vector& row : record.rows) lag.push_back(row[0]);
  return lag;
}

Configuration coupled(double stiffness, double h, const std::string& method, const std::string& formulation) {
  return shipped("lag_rotor.yaml", {set("subsystems.mast.stiffness", stiffness), set("simulation.step", h), "simulation.integrator=" + method,
                                    "simulation.formulation=" + formulation});
}

/// S_mon by its name in the configuration; "exact" is the column of -M^-1 K at zero lag angles.
Configuration monolithic(double stiffness, double h, const std::string& linear_part) {
  return Configuration::parse("simulation: {integrator: HEERK4, rotor_speed: 6.63}\n"
                              "subsystems:\n  rotor: {type: monolithic_lag_rotor, linear_part: " + linear_part + ", initial: {lag_1: 0.01}}\n",
                              "monolithic", {set("subsystems.rotor.mast_stiffness", stiffness), set("simulation.step", h)});
}

/// The reference on the grid t_j = j h: the absolute-lag form with h / m. The reference states (reference_states_test)
/// vouch for it up to K_s = 3e7; beyond, halving its step must not matter, which is tested below.
const std::vector<double>& reference(double stiffness, double h, long m) {
  static std::map<std::tuple<double, double, long>, std::vector<double>> kept;
  std::vector<double>& lag = kept[{stiffness, h, m}];
  if (lag.empty()) lag = lagOfBlade1(coupled(stiffness, h / static_cast<double>(m), "HEERK4", "absolute_lag"), m * stepsOf(h), static_cast<std::uint64_t>(m));
  return lag;
}

/// sqrt(sum (phi - ref)^2 / sum ref^2); infinite for a run that failed. lag_rotor.md says that the sums run over the grid
/// points 1..N, but all its values come out with the initial instant in the denominator (1.8 % less at h = 0.1 s, 0.2 % at
/// 0.01 s), so it is included here.
double rms(const std::vector<double>& lag, const std::vector<double>& exact) {
  if (lag.size() != exact.size()) return HUGE_VAL;
  double error = 0.0, scale = 0.0;
  for (std::size_t j = 0; j < lag.size(); ++j) {
    error += (lag[j] - exact[j]) * (lag[j] - exact[j]);
    scale += exact[j] * exact[j];
  }
  return std::isfinite(error) ? std::sqrt(error / scale) : HUGE_VAL;
}

/// Small enough for a reference: error of the absolute-lag form at 5e-5 s is below 1e-11 at 3e4 and 1e-9 at 3e6.
long refinement(double h) { return std::max(1L, std::lround(h / 5e-5)); }

double printedError(double stiffness, double h, const std::string& method) {
  return rms(lagOfBlade1(coupled(stiffness, h, method, "printed"), stepsOf(h)), reference(stiffness, h, refinement(h)));
}

/// "n.c.": the run failed, or its error exceeds the solution.
bool converges(double error) { return error <= 1.0; }

TEST(PaperTables, table1ValuesAndRatios) {
  const double h[] = {1e-2, 1e-3, 1e-4};
  const double expected[2][3] = {{6.548e-2, 6.202e-5, 6.203e-9}, {5.099e-2, 3.103e-6, 3.077e-10}};
  const double paper[2][3] = {{1.5e-1, 1.4e-4, 1.4e-8}, {1.2e-1, 7.3e-6, 7.2e-10}};
  double found[2][3];
  for (int method = 0; method < 2; ++method)
    for (int i = 0; i < 3; ++i) {
      found[method][i] = printedError(3e4, h[i], method == 0 ? "HERK4" : "HEERK4");
      report(std::string("Table 1 ") + (method == 0 ? "HERK4" : "HEERK4") + " h " + std::to_string(h[i]), found[method][i]);
      // Four digits published. The last HEERK4 entry is 3e-12 rad, 1e-10 of the solution: there Newton's tolerance of 1e-12
      // and the reference's own error, 1e-12, show in the third digit.
      EXPECT_NEAR(found[method][i], expected[method][i], (found[method][i] < 1e-9 ? 2e-2 : 1e-3) * expected[method][i]);
    }
  // The paper's print is larger by one unexplained common factor; its ratios must come out within its two digits.
  for (int method = 0; method < 2; ++method)
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR((paper[method][i] / found[method][i]) / (paper[0][0] / found[0][0]), 1.0, 0.07) << method << ", " << h[i];
}

TEST(PaperTables, table2PatternOfConvergence) {
  const std::map<std::string, bool> fails{{"HERK4 30000 0.1", true}, {"HEERK4 30000 0.1", true}, {"HERK4 300000 0.1", true}, {"HEERK4 300000 0.1", true},
      {"HERK4 3000000 0.1", true}, {"HEERK4 3000000 0.1", true}, {"HERK4 300000 0.01", true}, {"HERK4 3000000 0.01", true}, {"HEERK4 3000000 0.01", true}};
  for (const double stiffness : {3e4, 3e5, 3e6})
    for (const char* method : {"HERK4", "HEERK4"})
      for (const char* h : {"0.1", "0.01", "0.001", "0.0001"}) {
        const std::string entry = std::string(method) + " " + std::to_string(static_cast<long>(stiffness)) + " " + h;
        const double error = printedError(stiffness, std::stod(h), method);
        report("Table 2 " + entry, error);
        EXPECT_EQ(converges(error), fails.count(entry) == 0) << entry << ": error " << error;
      }
}

TEST(PaperTables, herk4NeedsStep1e4AtTheStiffnessOfTable4) {
  EXPECT_FALSE(converges(printedError(3e7, 1e-3, "HERK4")));
  EXPECT_TRUE(converges(printedError(3e7, 1e-4, "HERK4")));
}

/// Largest modulus of the eigenvalues of the complete Jacobian at t = 0, x0.
double largestEigenvalue(const Configuration& configuration) {
  ReducedOde ode(configuration);
  // The equations are quadratic to cubic in states of 0.01: central differences with 1e-4 are exact to 1e-8 relative, and
  // round-off (accelerations of up to 1e5 1/s^2 per rad, times 1e-4) to 1e-11.
  return std::abs(eigenvalues(ode.jacobian(0.0, ode.system.initialState(), 1e-4)).front());
}

TEST(PaperTables, table3LargestEigenvalues) {
  const double expected[] = {113.91, 326.49, 1021.18, 3225.67, 10199.32};
  for (int i = 0; i < 5; ++i) {
    for (const char* formulation : {"printed", "absolute_lag"})
      EXPECT_NEAR(largestEigenvalue(coupled(kStiffness[i], 1e-3, "HEERK4", formulation)), expected[i], 0.0051) << formulation << ", " << kStiffness[i];
    EXPECT_NEAR(largestEigenvalue(monolithic(kStiffness[i], 1e-3, "zero")), expected[i], 0.0051) << "monolithic, " << kStiffness[i];
  }
}

TEST(PaperTables, table4HasNoCrossWithTheMonolithicLinearPart) {
  for (const double stiffness : kStiffness)
    for (const double h : {1e-1, 1e-2, 1e-3, 1e-4}) {
      const double error = rms(lagOfBlade1(monolithic(stiffness, h, "paper"), stepsOf(h)), reference(stiffness, h, refinement(h)));
      report("Table 4 K_s " + std::to_string(static_cast<long>(stiffness)) + " h " + std::to_string(h), error);
      EXPECT_TRUE(converges(error)) << stiffness << ", " << h << ": error " << error;
      // The paper's one cross; lag_rotor.md finds it bounded, error 3.9e-2 (two digits).
      if (stiffness == 3e8 && h == 1e-1) {
        EXPECT_NEAR(error, 3.9e-2, 0.05e-2);
      }
    }
}

TEST(PaperTables, absoluteLagTable) {
  struct Entry {
    double stiffness, tenth, degree;
  };
  const auto check = [](const std::string& what, const Entry& e, const auto& configuration) {
    for (const double h : {1e-1, kOneDegree}) {
      const double expected = h == 1e-1 ? e.tenth : e.degree;
      const double error = rms(lagOfBlade1(configuration(e.stiffness, h), stepsOf(h)), reference(e.stiffness, h, refinement(h)));
      report("Section 5, " + what + ", K_s " + std::to_string(static_cast<long>(e.stiffness)) + ", h " + std::to_string(h), error);
      if (expected == 0.0) {
        EXPECT_FALSE(converges(error)) << what << ", " << e.stiffness << ", " << h;
      } else {
        // Two digits published.
        EXPECT_NEAR(error, expected, 0.06 * expected) << what << ", " << e.stiffness << ", " << h;
      }
    }
  };
  for (const Entry& e : {Entry{3e4, 8.2e-3, 7.6e-8}, Entry{3e6, 2.3e-4, 4.2e-6}, Entry{3e8, 2.3e-4, 9.6e-7}})
    check("absolute lag", e, [](double stiffness, double h) { return coupled(stiffness, h, "HEERK4", "absolute_lag"); });
  for (const Entry& e : {Entry{3e4, 1.4e-1, 3.7e-5}, Entry{3e6, 9.7e-4, 2.2e-4}, Entry{3e8, 7.9e-5, 4.8e-6}})
    check("S_mon exact", e, [](double stiffness, double h) { return monolithic(stiffness, h, "exact"); });
  for (const Entry& e : {Entry{3e4, 0, 3.0e-3}, Entry{3e6, 0, 6.8e-4}, Entry{3e8, 0, 0}})
    check("HERK4", e, [](double stiffness, double h) { return coupled(stiffness, h, "HERK4", "printed"); });
  for (const Entry& e : {Entry{3e4, 0, 1.5e-4}, Entry{3e6, 0, 7.0e-4}, Entry{3e8, 0, 0}})
    check("printed", e, [](double stiffness, double h) { return coupled(stiffness, h, "HEERK4", "printed"); });
}

TEST(PaperTables, absoluteLagAtOneDegreeResolvesTheStiffestMast) {
  // Issue 2: within a factor 2 of 9.6e-7.
  const double error = rms(lagOfBlade1(coupled(3e8, kOneDegree, "HEERK4", "absolute_lag"), stepsOf(kOneDegree)), reference(3e8, kOneDegree, refinement(kOneDegree)));
  EXPECT_LE(error, 2.0 * 9.6e-7);
  EXPECT_GE(error, 0.5 * 9.6e-7);
}

TEST(PaperTables, referenceTrajectoriesEndAtThePublishedLagAngle) {
  // phi_1(10) of lag_rotor.md, quadruple precision.
  const double expected[] = {5.652580697331982e-4, 2.676074313534727e-3, 2.536578401834366e-3, 2.512391606873492e-3};
  for (int i = 0; i < 4; ++i) {
    const double found = reference(kStiffness[i], 1e-2, refinement(1e-2)).back();
    report("reference phi_1(10), deviation, K_s " + std::to_string(static_cast<long>(kStiffness[i])), found - expected[i]);
    EXPECT_NEAR(found, expected[i], 1e-13);  // measured 2e-14 at 3e7, where the step of 5e-5 s is h |lambda| = 0.16
  }
}

TEST(PaperTables, referenceTrajectoriesAreConverged) {
  for (const double stiffness : {3e4, 3e6, 3e8}) {
    const double change = rms(reference(stiffness, kOneDegree, refinement(kOneDegree)), reference(stiffness, kOneDegree, 2 * refinement(kOneDegree)));
    report("reference, K_s " + std::to_string(static_cast<long>(stiffness)) + ", change by halving", change);
    EXPECT_LE(change, 1e-8);  // the smallest error judged against these references is 7.6e-8 (3e4) and 9.6e-7 (3e8)
  }
}

}  // namespace
}  // namespace heerk_rotor
