// Periodic shooting against long runs, Floquet multipliers against the eigenvalues of the linearised rotor.
#include "heerk_rotor/analysis/trim.hpp"

#include <cstring>

#include <Eigen/Eigenvalues>

#include "heerk_rotor/analysis/stability.hpp"
#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

TrimSettings settingsOf(const Configuration& configuration) {
  Problems problems;
  const TrimSettings settings = readTrimSettings(configuration, buildSystem(configuration), problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  return settings;
}

double revolutionOf(const Configuration& configuration) {
  Problems problems;
  return readSimulationSettings(configuration, problems).revolution();
}

TrimResult trimmed(const Configuration& configuration, const TrimOptions& options = {}) {
  return trim([&] { return buildSimulation(configuration); }, revolutionOf(configuration), settingsOf(configuration), options);
}

/// Cyclic pitch makes the steady motion a truly periodic one, with lag motion once per revolution.
const Overrides kForced = {"subsystems.swashplate.trim_longitudinal_cyclic=0.03", "simulation.newton_tolerance=1e-12"};
const Overrides kThrust = {"trim.controls=[swashplate.collective]", "trim.targets={rotor.hub_force_z: 20000}"};

TEST(Trim, findsThePeriodicMotionThatALongRunSettlesTo) {
  // Any drive angle goes with a periodic motion: held, it is that of the long run.
  const Configuration configuration = shipped("lag_rotor_controlled.yaml", kForced + Overrides{"trim.settle_revolutions=1", "trim.hold=[drive.angle]"});
  const TrimResult result = trimmed(configuration);
  ASSERT_TRUE(result.trimmed()) << result.message;
  EXPECT_LE(result.worst_periodicity, 1e-9);
  auto simulation = buildSimulation(configuration);
  // The slowest mode keeps 0.948 per revolution: 1e-14 of it is left after 600.
  ASSERT_TRUE(advance(*simulation, 600 * 360));
  const Vector difference = (result.x - simulation->state()).cwiseQuotient(result.scales.states);
  report("largest difference to the long run", difference.cwiseAbs().maxCoeff());
  // A periodicity residual r leaves an error of up to r / (1 - 0.948) = 20 r.
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 2e-8);
  const std::vector<std::string> names = simulation->system().stateNames();
  const auto lag_rate = std::find(names.begin(), names.end(), "rotor.absolute_lag_rate_1") - names.begin();
  EXPECT_GT(std::abs(result.x[lag_rate]), 1e-3) << "else nothing was periodic here";
}

TEST(Trim, convergesAtTheRateOfItsGradient) {
  const TrimResult result = trimmed(shipped("lag_rotor_controlled.yaml", kForced + kThrust + Overrides{"trim.tolerance=1e-10"}));
  ASSERT_TRUE(result.trimmed()) << result.message;
  EXPECT_NEAR(result.means[0], 20000.0, 1e-10 * 1e5) << "the scale may be the largest thrust of a revolution";
  EXPECT_LE(result.gradients, 4);
  for (std::size_t i = 2; i < result.history.size(); ++i) EXPECT_LT(result.history[i], 0.3 * result.history[i - 1]) << i;
}

TEST(Trim, doesNotDependOnTheNumberOfThreads) {
  const Configuration configuration = shipped("lag_rotor_controlled.yaml", kForced + kThrust);
  TrimOptions one, three;
  one.threads = 1;
  three.threads = 3;
  const TrimResult a = trimmed(configuration, one), b = trimmed(configuration, three);
  ASSERT_TRUE(a.trimmed());
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(std::memcmp(a.x.data(), b.x.data(), static_cast<std::size_t>(a.x.size()) * sizeof(double)), 0);
  EXPECT_EQ(std::memcmp(a.w.data(), b.w.data(), static_cast<std::size_t>(a.w.size()) * sizeof(double)), 0);
}

TEST(Trim, namesTheControlThatLimitsATarget) {
  const TrimResult result = trimmed(shipped("lag_rotor_controlled.yaml", {"trim.controls=[swashplate.collective]", "trim.targets={rotor.hub_force_z: 80000}"}));
  EXPECT_EQ(result.status, TrimResult::Status::kInfeasible);
  EXPECT_NE(result.message.find("rotor.hub_force_z"), std::string::npos) << result.message;
  EXPECT_NE(result.message.find("swashplate.collective is at its upper limit 0.349"), std::string::npos) << result.message;
  EXPECT_LE(result.worst_periodicity, 1e-9) << "what is reached is said of a periodic motion";
}

TEST(Trim, keepsHeldStates) {
  const TrimResult result = trimmed(shipped("lag_rotor_controlled.yaml", kForced + Overrides{"trim.hold=[drive.angle]", "subsystems.drive.initial={angle: 0.3}"}));
  ASSERT_TRUE(result.trimmed()) << result.message;
  EXPECT_EQ(result.x[0], 0.3);
}

TEST(Trim, refusesAStepThatDoesNotDivideTheRevolution) {
  const Configuration configuration = shipped("lag_rotor.yaml");  // 947.69 steps of 1 ms
  EXPECT_THROW(trimmed(configuration), std::invalid_argument);
}

/// Growth rates -Im w of (omega_x^2 - w^2)(k - (w - Omega)^2) = 2 r_m r_b w^4 (lag_rotor.md, section 6), by its companion matrix.
double characteristicGrowth(double rotor_speed, double lag_frequency, double fuselage_frequency) {
  const LagRotorConstants c((LagRotorParameters()));
  const double k = c.r_a2 * rotor_speed * rotor_speed + lag_frequency * lag_frequency, f = fuselage_frequency * fuselage_frequency;
  // (f - w^2)(k - O^2 + 2 O w - w^2) - 2 r w^4, rising powers.
  const double a = k - rotor_speed * rotor_speed, b = 2.0 * rotor_speed;
  const double p[5] = {f * a, f * b, -f - a, -b, 1.0 - 2.0 * c.r_mx * c.r_b};
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  for (int j = 0; j < 4; ++j) companion(0, j) = -p[3 - j] / p[4];
  companion(1, 0) = companion(2, 1) = companion(3, 2) = 1.0;
  return companion.eigenvalues().imag().cwiseAbs().maxCoeff();
}

TEST(Floquet, multipliersOfTheLagRotorAreTheEigenvaluesOfGroundResonance) {
  constexpr double kLag = 9.42477796076938, kFuselage = 18.8495559215388;
  for (const double omega : {28.0, 29.97508, 32.0}) {
    const Configuration configuration = shipped("lag_rotor.yaml",
        {"subsystems.mast={type: rigid_mast}", set("simulation.rotor_speed", omega), "simulation.azimuth_step_deg=1.0", "subsystems.rotor.initial={}",
         set("subsystems.rotor.lag_frequency", kLag), set("subsystems.rotor.fuselage_frequency_x", kFuselage), set("subsystems.rotor.fuselage_frequency_y", kFuselage)});
    const TrimResult result = trimmed(configuration);  // rest is the periodic motion; the monodromy matrix is about it
    ASSERT_TRUE(result.trimmed());
    const Stability floquet = floquetStability(result.monodromy, result.period, buildSystem(configuration).stateNames());
    EXPECT_TRUE(floquet.unstable());
    // The map is linear, so that one-sided differences of 1e-6 are good to the round-off 1e-16 / 1e-6 of a revolution.
    EXPECT_NEAR(std::log(floquet.spectral_radius) / result.period, characteristicGrowth(omega, kLag, kFuselage), 1e-6) << omega;
  }
}

TEST(TrimSettings, badSectionsAreProblemsWithTheirPlace) {
  const auto problemsOf = [](const Overrides& overrides) {
    const Configuration configuration = shipped("lag_rotor_controlled.yaml", overrides);
    Problems problems;
    readTrimSettings(configuration, buildSystem(configuration), problems);
    return problems.text();
  };
  const auto expect = [&](const Overrides& overrides, const std::string& part) {
    const std::string text = problemsOf(overrides);
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NE(text.find("--set trim."), std::string::npos) << text;
  };
  EXPECT_EQ(problemsOf(kThrust), "");
  expect({"trim.controls=[swashplate.colective]"}, "did you mean 'swashplate.collective'?");
  expect({"trim.controls=[swashplate.collective, swashplate.collective]"}, "each command once");
  expect({"trim.controls=[swashplate.collective]", "trim.targets={rotor.hub_force_w: 1}"}, "the name of a signal");
  expect({"trim.controls=[swashplate.collective]", "trim.targets={rotor.hub_force_z: much}"}, "a number [N]");
  expect({"trim.targets={rotor.hub_force_z: 20000}"}, "at most one target per control");
  expect({"trim.hold=[mast.twisst]"}, "did you mean 'mast.twist'?");
  expect({"trim.tolerance=0"}, "trim.tolerance = 0");
  expect({"trim.tolerence=3"}, "a known key (did you mean 'tolerance'?)");
}

TEST(TrimSettings, targetsMayBeSetOneByOne) {
  const Configuration configuration = shipped("lag_rotor_controlled.yaml", {"trim.controls=[swashplate.collective]", "trim.targets.rotor.hub_force_z=20000"});
  const TrimSettings settings = settingsOf(configuration);
  ASSERT_EQ(settings.targets.size(), 1u);
  EXPECT_EQ(settings.signals[0].name, "rotor.hub_force_z");
  EXPECT_EQ(settings.targets[0], 20000.0);
}

TEST(TrimSettings, keepTheirLineInTheFile) {
  const std::string text = "simulation: {rotor_speed: 1.0}\ntrim:\n  controls: [a.b]\n  targets:\n    rotor.thrust: x\n    rotor.torque: 2\nsubsystems: {}\n";
  const Configuration configuration = Configuration::parse(text, "f.yaml");
  EXPECT_EQ(configuration.where("trim.targets.rotor.thrust"), "f.yaml:5");
  EXPECT_EQ(configuration.where("trim.targets.rotor.torque"), "f.yaml:6");
  EXPECT_EQ(Configuration::parse(configuration.resolvedText(), "g").resolvedText(), configuration.resolvedText());
}

}  // namespace
}  // namespace heerk_rotor
