// Ground resonance of the rotor on a rigid mast (HEERK paper, A.1; lag_rotor.md, section 6): growth rates measured in
// simulations against eigenvalues solved here.
#include "models/stability.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kLagFrequency = 2.0 * M_PI * 1.5, kFuselageFrequency = 2.0 * M_PI * 3.0;  // [rad/s]

/// config/lag_rotor.yaml without mast spring and with its frequencies read as Hz.
Overrides rigid(double rotor_speed) {
  return {"subsystems.mast={type: rigid_mast}", set("simulation.rotor_speed", rotor_speed), "simulation.azimuth_step_deg=1.0",
          set("subsystems.rotor.lag_frequency", kLagFrequency), set("subsystems.rotor.fuselage_frequency_x", kFuselageFrequency),
          set("subsystems.rotor.fuselage_frequency_y", kFuselageFrequency)};
}

double floquet(const Overrides& overrides, double rotor_speed) {
  auto simulation = buildSimulation(shipped("lag_rotor.yaml", overrides));
  return floquetGrowth(*simulation, rotor_speed);
}

/// Largest growth rate [1/s] by the characteristic equation in multiblade coordinates,
///   (omega_x^2 - w^2)(k - (w - Omega)^2) = 2 r_m r_b w^4,  motion ~ e^{i w t},
/// a quartic in w, solved by its companion matrix. Damping ratios `lag` and `fuselage` add i 2 zeta omega_b (w - Omega) to the
/// second factor and i 2 zeta omega_x w to the first.
double characteristicGrowth(double rotor_speed, double lag = 0.0, double fuselage = 0.0) {
  using Complex = std::complex<double>;
  using Polynomial = std::vector<Complex>;  // rising powers of w
  const auto times = [](const Polynomial& a, const Polynomial& b) {
    Polynomial product(a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
    return product;
  };
  const LagRotorConstants c((LagRotorParameters()));
  const double k = c.r_a2 * rotor_speed * rotor_speed + kLagFrequency * kLagFrequency;
  const Complex i(0.0, 1.0);
  const Polynomial body{kFuselageFrequency * kFuselageFrequency, 2.0 * fuselage * kFuselageFrequency * i, -1.0};
  const Complex damping = 2.0 * lag * kLagFrequency * i;
  const Polynomial blade{k - rotor_speed * rotor_speed - damping * rotor_speed, 2.0 * rotor_speed + damping, -1.0};
  Polynomial quartic = times(body, blade);
  quartic[4] -= 2.0 * c.r_mx * c.r_b;
  Eigen::Matrix4cd companion = Eigen::Matrix4cd::Zero();
  for (int j = 0; j < 4; ++j) companion(0, j) = -quartic[static_cast<std::size_t>(3 - j)] / quartic[4];
  companion(1, 0) = companion(2, 1) = companion(3, 2) = 1.0;
  double growth = -1e9;
  for (const Complex& w : Eigen::ComplexEigenSolver<Eigen::Matrix4cd>(companion, false).eigenvalues()) growth = std::max(growth, -w.imag());
  return growth;
}

TEST(GroundResonance, characteristicEquationGivesThePublishedZone) {
  EXPECT_NEAR(characteristicGrowth(29.97508), 1.1583096128, 1e-9);  // all digits of lag_rotor.md
  // At the edges the growth rate sets in like a square root: 1e-9 rad/s inside it is already 1e-5 1/s.
  for (const double outside : {27.3785179531 - 1e-9, 32.5894111404 + 1e-9}) EXPECT_LT(characteristicGrowth(outside), 1e-6);
  for (const double inside : {27.3785179531 + 1e-9, 32.5894111404 - 1e-9}) EXPECT_GT(characteristicGrowth(inside), 1e-6);
}

TEST(GroundResonance, floquetExponentsOfTheSimulationAreTheEigenvalues) {
  for (const double omega : {28.0, 29.97508, 32.0}) {
    // One degree of HEERK4 changes the amplitude of a mode by (h w)^6 / 144 per step: 1e-8 of the exponent.
    EXPECT_NEAR(floquet(rigid(omega), omega), characteristicGrowth(omega), 1e-7) << omega;
  }
  for (const double omega : {20.0, 27.3, 32.7, 41.0}) EXPECT_NEAR(floquet(rigid(omega), omega), 0.0, 1e-7) << omega;
}

/// Fuselage motion and cyclic lag in the fixed frame: there the isotropic rotor has constant coefficients.
struct FixedFrame {
  std::vector<double> t;
  std::vector<Vector> z;
};
FixedFrame simulateDisturbance(const Overrides& overrides, double duration, double sample_time) {
  auto simulation = buildSimulation(shipped("lag_rotor.yaml", overrides + Overrides{"subsystems.rotor.initial={lag_1: 0.01}"}));
  const auto every = static_cast<std::uint64_t>(std::lround(sample_time / simulation->stepSize()));
  Recorder record(*simulation, {"rotor.fuselage_x", "rotor.fuselage_y", "rotor.lag_1", "rotor.lag_2", "rotor.lag_3", "rotor.lag_4", "mast.azimuth"}, every);
  EXPECT_TRUE(advance(*simulation, std::lround(duration / simulation->stepSize())));
  FixedFrame motion;
  motion.t = record.t;
  for (const Vector& row : record.rows) {
    const double s = std::sin(row[6]), c = std::cos(row[6]), lag13 = row[2] - row[4], lag24 = row[3] - row[5];
    Vector z(4);
    z << row[0], row[1], 0.5 * (c * lag13 - s * lag24), 0.5 * (s * lag13 + c * lag24);
    motion.z.push_back(z);
  }
  return motion;
}

TEST(GroundResonance, simulatedDisturbanceGrowsAtTheRateOfTheEigenvalue) {
  for (const double omega : {28.5, 29.97508, 31.5}) {
    const double expected = characteristicGrowth(omega);
    // After 8 / sigma the growing mode exceeds the neutral ones by e^8, and its decaying twin by e^16.
    const FixedFrame motion = simulateDisturbance(rigid(omega), 14.0 / expected, 0.02);
    const double growth = growthRate(motion.t, motion.z, 8.0 / expected);
    report("growth at " + std::to_string(omega), growth);
    report("eigenvalue at " + std::to_string(omega), expected);
    EXPECT_NEAR(growth, expected, 0.02 * expected) << omega;  // issue 2
  }
}

TEST(GroundResonance, simulatedDisturbanceDoesNotGrowOutsideTheZone) {
  for (const double omega : {20.0, 26.5, 33.5, 41.0}) {
    const FixedFrame motion = simulateDisturbance(rigid(omega), 40.0, 0.02);
    const auto peak = [&](double from, double to) {
      double value = 0.0;
      for (std::size_t k = 0; k < motion.t.size(); ++k)
        if (motion.t[k] >= from && motion.t[k] < to) value = std::max(value, motion.z[k].norm());
      return value;
    };
    // Undamped beating: every 20 s window holds many beats, so its peak varies by some per cent only; the weakest growth
    // to be excluded, 0.05 1/s, would be a factor 2.7.
    EXPECT_LT(peak(20.0, 40.0), 1.1 * peak(0.0, 20.0)) << omega;
    EXPECT_GT(peak(20.0, 40.0), 0.5 * peak(0.0, 20.0)) << omega << ": nothing damps it either";
  }
}

TEST(GroundResonance, threePercentDampingNarrowsTheZone) {
  const LagRotorParameters p;
  const LagRotorConstants c(p);
  const double lag_damper = 2.0 * 0.03 * kLagFrequency * c.lag_inertia, fuselage_damping = 2.0 * 0.03 * kFuselageFrequency * c.mass_x;
  const auto damped = [&](double omega) {
    return rigid(omega) + Overrides{set("subsystems.rotor.lag_damper", lag_damper), set("subsystems.rotor.fuselage_damping_x", fuselage_damping),
                                    set("subsystems.rotor.fuselage_damping_y", fuselage_damping)};
  };
  const auto growth = [&](double omega) { return floquet(damped(omega), omega); };
  // The published edges, 4.376 and 5.218 Hz, come from a scan that needed some growth to see it: by the characteristic
  // equation growth sets in at 4.37371 and 5.22046 Hz, and the simulation must agree with the equation.
  for (const double hz : {4.3736, 5.2206}) EXPECT_LT(growth(2.0 * M_PI * hz), 0.0) << hz;
  for (const double hz : {4.3738, 4.376, 5.218, 5.2203}) EXPECT_GT(growth(2.0 * M_PI * hz), 0.0) << hz;
  // Common lag of all blades, and of opposite pairs, does not move the fuselage: these modes decay as single blades do.
  const double uncoupled = -0.03 * kLagFrequency;
  for (const double hz : {4.0, 4.3736, 4.6, 5.0, 5.2206, 6.5})
    EXPECT_NEAR(growth(2.0 * M_PI * hz), std::max(uncoupled, characteristicGrowth(2.0 * M_PI * hz, 0.03, 0.03)), 1e-7) << hz;
  double peak = 0.0;
  for (double omega = 29.0; omega <= 31.0; omega += 0.1) peak = std::max(peak, growth(omega));
  report("peak growth with 3 % dampers", peak);
  EXPECT_NEAR(peak, 0.754, 1e-3);  // three digits published
  // The simulated disturbance tells the same, dampers included.
  const FixedFrame motion = simulateDisturbance(damped(30.0), 25.0, 0.02);
  EXPECT_NEAR(growthRate(motion.t, motion.z, 12.0), growth(30.0), 0.02 * growth(30.0));
  // Outside the zone it decays.
  const FixedFrame calm = simulateDisturbance(damped(41.0), 20.0, 0.02);
  EXPECT_LT(calm.z.back().norm(), 0.05 * calm.z.front().norm());
}

TEST(GroundResonance, oneSofterBladeShiftsTheZoneAndOpensANarrowOne) {
  const auto growth = [&](double omega) {
    char list[160];
    std::snprintf(list, sizeof list, "subsystems.rotor.lag_frequency=[%.17g, %.17g, %.17g, %.17g]", std::sqrt(0.8) * kLagFrequency, kLagFrequency, kLagFrequency, kLagFrequency);
    return floquet(rigid(omega) + Overrides{list}, omega);
  };
  // Edges in lag_rotor.md: 26.93134, 32.47825 and 18.5322, 18.5614 rad/s; tested one or two units of the last digit away.
  // The growth rate sets in like a square root; 1e-4 1/s separates it from the integration error, 1e-7.
  for (const double outside : {26.93132, 32.47827, 18.5320, 18.5616}) EXPECT_LT(growth(outside), 1e-4) << outside;
  for (const double inside : {26.93136, 32.47823, 18.5324, 18.5612}) EXPECT_GT(growth(inside), 1e-4) << inside;
  double peak = 0.0, narrow = 0.0;
  for (double omega = 29.0; omega <= 30.5; omega += 0.05) peak = std::max(peak, growth(omega));
  for (double omega = 18.53; omega <= 18.565; omega += 0.001) narrow = std::max(narrow, growth(omega));
  report("peak growth, blade 1 stiffness x 0.8", peak);
  report("peak growth in the narrow zone", narrow);
  EXPECT_NEAR(peak, 1.125, 1e-3);
  EXPECT_NEAR(narrow, 0.0144, 0.02 * 0.0144);  // the published maximum is that of a coarser scan; 2 % as everywhere here
}

/// Hammond (1974) in SI units, with rotor speed in rpm; the masses m_x, m_y exclude the blades.
Overrides hammond(double rpm, const std::string& dampers) {
  constexpr double m_b = 94.9, s_b = 289.1, i_b = 1084.7, m_x = 8026.6, m_y = 3283.6, k = 1240481.8;
  const double b = s_b / m_b, omega = rpm * M_PI / 30.0;
  return {"subsystems.mast={type: rigid_mast}", set("simulation.rotor_speed", omega), "simulation.azimuth_step_deg=1.0",
          "subsystems.rotor={type: lag_rotor, hinge_offset: 0.3048, lag_damper: " + dampers + "}",
          set("subsystems.rotor.blade_length", b), set("subsystems.rotor.blade_mass", m_b), set("subsystems.rotor.blade_inertia", i_b - m_b * b * b),
          set("subsystems.rotor.fuselage_mass_x", m_x), set("subsystems.rotor.fuselage_mass_y", m_y), "subsystems.rotor.lag_frequency=0.0",
          set("subsystems.rotor.fuselage_frequency_x", std::sqrt(k / (m_x + 4.0 * m_b))), set("subsystems.rotor.fuselage_frequency_y", std::sqrt(k / (m_y + 4.0 * m_b))),
          "subsystems.rotor.fuselage_damping_x=51078.7", "subsystems.rotor.fuselage_damping_y=25539.35"};
}

double hammondGrowth(double rpm, const std::string& dampers) { return floquet(hammond(rpm, dampers), rpm * M_PI / 30.0); }

TEST(GroundResonance, hammondHelicopterWithAllDampersIsStable) {
  double least = -1e9;
  for (double rpm = 10.0; rpm <= 400.0; rpm += 10.0) {
    const double growth = hammondGrowth(rpm, "4067.5");
    EXPECT_LT(growth, 0.0) << rpm;
    if (rpm >= 200.0 && rpm <= 300.0) least = std::max(least, growth);
  }
  report("Hammond, least damped between 200 and 300 rpm", least);
  EXPECT_NEAR(least, -0.33, 0.01);  // two digits published
}

TEST(GroundResonance, hammondHelicopterWithOneDamperOutGrows) {
  const std::string one_out = "[0.0, 4067.5, 4067.5, 4067.5]";
  const double at250 = hammondGrowth(250.0, one_out);
  report("Hammond, one damper out, 250 rpm", at250);
  EXPECT_NEAR(at250, 0.322, 0.02 * 0.322);  // issue 2
  for (const double rpm : {209.0, 309.0}) EXPECT_LT(hammondGrowth(rpm, one_out), 0.0) << rpm;  // zone 211-307 rpm
  for (const double rpm : {213.0, 305.0}) EXPECT_GT(hammondGrowth(rpm, one_out), 0.0) << rpm;

  // The same from a simulated disturbance, seen once per revolution, where the periodic system is a constant map.
  auto simulation = buildSimulation(shipped("lag_rotor.yaml", hammond(250.0, one_out) + Overrides{"subsystems.rotor.initial={lag_1: 0.01}"}));
  Recorder record(*simulation, {"rotor.fuselage_x", "rotor.fuselage_y", "rotor.lag_1", "rotor.lag_2", "rotor.lag_3", "rotor.lag_4"}, 360);
  ASSERT_TRUE(advance(*simulation, 360 * 150));  // 36 s: e^11
  const double growth = growthRate(record.t, record.rows, 18.0);
  report("Hammond, one damper out, from the simulated disturbance", growth);
  EXPECT_NEAR(growth, 0.322, 0.02 * 0.322);
}

}  // namespace
}  // namespace heerk_rotor
