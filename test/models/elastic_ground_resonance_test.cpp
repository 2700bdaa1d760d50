// Ground resonance of the elastic rotor (config/ground_resonance.yaml): growth in a simulation, multipliers of the linearised system, and
// Hammond's equations with a single lag mode per blade must tell the same.
#include "heerk_rotor/analysis/trim.hpp"
#include "heerk_rotor/analysis/stability.hpp"
#include "heerk_rotor/beam/blade_modes.hpp"
#include "heerk_rotor/models/fe_rotor_parameters.hpp"
#include "models/rotor_runs.hpp"

#include <Eigen/Eigenvalues>
#include <complex>

namespace heerk_rotor {
namespace {

using namespace test;

constexpr int kBlades = 4;
// Lag, flap and torsion of the blade up to the fifth mode; more change the growth rate by less than 0.2 %.
const Overrides kFewModes{"subsystems.rotor.modes=4", "simulation.newton_tolerance=1e-12"};

struct Motion {
  TrimResult trimmed;
  Stability floquet;
};

/// Periodic motion with the configuration's trim targets, or under the default commands, and its multipliers.
Motion periodicMotion(const Configuration& configuration, bool with_targets = true) {
  const auto build = [&] { return buildSimulation(configuration); };
  const auto simulation = build();
  Problems problems;
  const TrimSettings settings = with_targets ? readTrimSettings(configuration, simulation->system(), problems) : TrimSettings();
  EXPECT_TRUE(problems.empty()) << problems.text();
  TrimOptions options;
  options.threads = 1;
  const double revolution = 2.0 * M_PI / 44.4;
  Motion motion{trim(build, revolution, settings, options), {}};
  EXPECT_TRUE(motion.trimmed.trimmed()) << motion.trimmed.message;
  motion.floquet = floquetStability(motion.trimmed.monodromy, motion.trimmed.period, simulation->system().stateNames());
  return motion;
}

double growthOf(const Multiplier& mode, double period) { return std::log(std::abs(mode.mu)) / period; }

/// Growth rates [1/s] of Hammond's equations for a rotor with one lag mode per blade, in the fixed frame and complex, motion ~ e^{i w t}:
///   (k / M - w^2 + i w c_f / M) (omega^2 - (w - Omega)^2 + i (w - Omega) c) = N S^2 / (2 M) w^4
/// M: all that sways; S = int m v dr of the mode with unit modal mass; c: of the mode [1/s]. Largest of the quartic's roots.
struct SingleLagMode {
  double omega, damping, S;  // [rad/s], [1/s], [sqrt(kg)]
};
double hammondGrowth(const SingleLagMode& lag, double total_mass, double stiffness, double damping, double rotor_speed) {
  using Complex = std::complex<double>;
  const Complex i(0.0, 1.0);
  const Complex body[3] = {stiffness / total_mass, i * damping / total_mass, -1.0};  // rising powers of w
  const Complex blade[3] = {lag.omega * lag.omega - rotor_speed * rotor_speed - i * rotor_speed * lag.damping, 2.0 * rotor_speed + i * lag.damping, -1.0};
  Complex quartic[5] = {};
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) quartic[a + b] += body[a] * blade[b];
  quartic[4] -= kBlades * lag.S * lag.S / (2.0 * total_mass);
  Eigen::Matrix4cd companion = Eigen::Matrix4cd::Zero();
  for (int j = 0; j < 4; ++j) companion(0, j) = -quartic[3 - j] / quartic[4];
  companion(1, 0) = companion(2, 1) = companion(3, 2) = 1.0;
  double growth = -1e9;
  for (const Complex& w : Eigen::ComplexEigenSolver<Eigen::Matrix4cd>(companion, false).eigenvalues()) growth = std::max(growth, -w.imag());
  return growth;
}

/// Lag mode of the blade alone, at zero pitch, and the mass of the blade.
struct Blade {
  SingleLagMode lag;
  double mass;
};
Blade bladeOf(const Configuration& configuration, double rotor_speed) {
  Problems problems;
  Section section(configuration, "subsystems.rotor", problems);
  section.word("type", "");
  const FeRotorParameters p = readFeRotorParameters(section, rotor_speed);
  EXPECT_TRUE(problems.empty()) << problems.text();
  const BladeMatrices blade = assembleBlade(p.blades.front());
  const BladeModes modes = bladeModes(blade, blade.stiffness(rotor_speed, 0, p.precone));
  const Eigen::Index lag = modes.index("L1");
  return {{modes.omega[lag], modes.damping[lag], modes.project(blade.inertia_v)[lag]}, blade.mass};
}

constexpr double kSpeed = 44.4, kMass = 1972.4, kStiffness = 270000.0, kDamping = 100.0;  // config/ground_resonance.yaml

/// Growth rate [1/s] of the cyclic lag, |2/N sum lag_k e^{i psi_k}|, after a kick of one blade: straight line through the logarithm between
/// `from` and `to` [s].
double simulatedGrowth(const Configuration& configuration, const TrimResult& start, double from, double to) {
  auto simulation = buildSimulation(configuration);
  Vector x = start.x;
  x[simulation->system().signal("rotor.L1_1").index] += 2e-4 * start.scales.states.maxCoeff();
  simulation->setState(x);
  Recorder record(*simulation, {"rotor.lag_1", "rotor.lag_2", "rotor.lag_3", "rotor.lag_4", "mast.azimuth"}, 45);
  EXPECT_TRUE(advance(*simulation, std::lround(to / simulation->stepSize()), start.w));
  double n = 0, st = 0, sl = 0, stt = 0, stl = 0;
  for (std::size_t i = 0; i < record.t.size(); ++i) {
    if (record.t[i] < from) continue;
    std::complex<double> cyclic = 0.0;
    for (int k = 0; k < kBlades; ++k) cyclic += record.rows[i][k] * std::polar(1.0, record.rows[i][4] + 2.0 * M_PI * k / kBlades);
    const double t = record.t[i], l = std::log(std::abs(cyclic));
    n += 1, st += t, sl += l, stt += t * t, stl += t * l;
  }
  report("cyclic lag at the end", record.rows.back().head(4).cwiseAbs().maxCoeff());
  return (n * stl - st * sl) / (n * stt - st * st);
}

TEST(ElasticGroundResonance, simulatedGrowthIsThatOfTheLinearisedSystem) {
  const Configuration configuration = shipped("ground_resonance.yaml", kFewModes);
  const Motion motion = periodicMotion(configuration);
  const Multiplier& first = motion.floquet.modes.front();
  const double expected = growthOf(first, motion.floquet.period);
  report("multiplier", std::abs(first.mu));
  report("frequency in the fixed frame [rad/s]", 2.0 * M_PI * first.frequency);
  report("growth of the linearised system [1/s]", expected);
  const double growth = simulatedGrowth(configuration, motion.trimmed, 8.0, 20.0);
  report("growth in the simulation [1/s]", growth);
  EXPECT_TRUE(motion.floquet.unstable());
  EXPECT_NEAR(growth, expected, 0.05 * expected);

  // The lag mode of opposite blade pairs does not move the fuselage: its multiplier shows the lag mode of a single blade in the air.
  Blade blade = bladeOf(configuration, kSpeed);
  report("S^2 over unit modal mass [kg]", blade.lag.S * blade.lag.S);
  const double total = kMass + kBlades * blade.mass;
  const double without_air = hammondGrowth(blade.lag, total, kStiffness, kDamping, kSpeed);
  report("Hammond, blade data only [1/s]", without_air);
  const SingleLagMode in_air{33.06,2*.7767,blade.lag.S};
  report("Hammond, lag in air", hammondGrowth(in_air, total, kStiffness, kDamping, kSpeed));
  for (const Multiplier& mode : motion.floquet.modes) {
    const double f = 2.0 * M_PI * mode.frequency;
    std::printf("%s |mu| %.5f f %.4f growth %.4f\n", mode.state.c_str(), std::abs(mode.mu), f, growthOf(mode, motion.floquet.period));
  }
}

TEST(ElasticGroundResonance, inVacuoItIsHammondsResult) {
  const Configuration configuration = shipped("ground_resonance.yaml", kFewModes + Overrides{"subsystems.airloads.air_density=1e-9", "subsystems.coefficients.air_density=1e-9", "subsystems.fuselage.gravity=0",
      "subsystems.rotor.precone_deg=0", "subsystems.rotor.twist_deg_per_R=0", "subsystems.swashplate.trim_collective=0"});
  const Motion motion = periodicMotion(configuration, false);
  const Blade blade = bladeOf(configuration, kSpeed);
  const double expected = hammondGrowth(blade.lag, kMass + kBlades * blade.mass, kStiffness, kDamping, kSpeed);
  report("vacuo, omega L1", blade.lag.omega);
  report("vacuo, Hammond", expected);
  report("vacuo, Floquet", growthOf(motion.floquet.modes.front(), motion.floquet.period));
}

}  // namespace
}  // namespace heerk_rotor
