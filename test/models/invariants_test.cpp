// What the lag rotor's equations conserve and how they transform: energy, equal blades, numbering of the blades.
#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

/// T2 - T0 + V of the quadratic Lagrangian in the frame that turns with Omega: constant where the support is isotropic and
/// undamped, because nothing then depends on time in that frame. Rigid mast; blades may differ in stiffness.
///   L = M/2 v^2 + S v . d/dt sum(phi_i e_t,i) + I_l/2 sum phi_i'^2 - S a Omega^2/2 sum phi_i^2 - V
double jacobiIntegral(const Vector& row, double azimuth, double rotor_speed, const LagRotorParameters& p) {
  const LagRotorConstants c(p);
  const double s = std::sin(azimuth), co = std::cos(azimuth), omega = rotor_speed;
  const auto turn = [&](double x, double y) { return Eigen::Vector2d(co * x + s * y, -s * x + co * y); };
  const auto across = [](const Eigen::Vector2d& v) { return Eigen::Vector2d(-v[1], v[0]); };
  const Eigen::Vector2d xi = turn(row[0], row[1]);
  const Eigen::Vector2d xi_rate = turn(row[7], row[8]) - omega * across(xi);
  const Eigen::Vector2d e[4] = {{0, 1}, {-1, 0}, {0, -1}, {1, 0}};  // e_t of the blades in that frame
  Eigen::Vector2d q(0, 0), q_rate(0, 0);
  double blades = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double lag = row[2 + i], rate = row[9 + i], frequency = p.lag_frequency[static_cast<std::size_t>(i)];
    q += lag * e[i];
    q_rate += rate * e[i];
    blades += 0.5 * c.lag_inertia * (rate * rate + frequency * frequency * lag * lag) + 0.5 * c.static_moment * p.hinge_offset * omega * omega * lag * lag;
  }
  const double t2 = 0.5 * c.mass_x * xi_rate.squaredNorm() + c.static_moment * xi_rate.dot(q_rate);
  const double t0 = 0.5 * c.mass_x * omega * omega * xi.squaredNorm() + c.static_moment * omega * omega * xi.dot(q);
  return t2 - t0 + blades + 0.5 * c.mass_x * p.fuselage_frequency_x * p.fuselage_frequency_x * xi.squaredNorm();
}

TEST(Invariants, undampedRotorOnRigidMastConservesItsJacobiIntegral) {
  LagRotorParameters p;
  p.lag_frequency = {1.5, 1.2, 1.7, 1.4};
  std::vector<std::string> names = paperState();
  names[6] = names[13] = "mast.twist";
  names.push_back("mast.azimuth");
  for (const double omega : {6.63, 2.0}) {
    double drift[2];
    for (const int k : {0, 1}) {
      auto simulation = buildSimulation(shipped("lag_rotor.yaml", {"subsystems.mast={type: rigid_mast}", set("simulation.rotor_speed", omega),
          k == 0 ? "simulation.step=2.0e-3" : "simulation.step=1.0e-3",
          "subsystems.rotor.lag_frequency=[1.5, 1.2, 1.7, 1.4]",
          "subsystems.rotor.initial={lag_1: 0.01, lag_3: -0.004, lag_rate_2: 0.02, fuselage_x: 0.002, fuselage_y_rate: -0.01}"}));
      Recorder record(*simulation, names, 50);
      ASSERT_TRUE(advance(*simulation, std::lround(30.0 / simulation->stepSize())));
      const double start = jacobiIntegral(record.rows[0], record.rows[0][14], omega, p);
      drift[k] = 0.0;
      for (const Vector& row : record.rows) drift[k] = std::max(drift[k], std::abs(jacobiIntegral(row, row[14], omega, p) / start - 1.0));
      report("relative energy drift in 30 s, Omega " + std::to_string(omega) + ", h " + std::to_string(simulation->stepSize()), drift[k]);
    }
    // HEERK4 dissipates (h w)^6 / 144 w t: 1e-9 at w = 10 rad/s and 1 ms, or whatever round-off leaves.
    EXPECT_LE(drift[1], 1e-8) << omega;
    EXPECT_LE(drift[1], std::max(drift[0] / 12.0, 1e-12)) << omega << ": what drifts is the integration, not the model";
  }
}

TEST(Invariants, equalBladesStayEqual) {
  for (const char* formulation : {"absolute_lag", "printed"}) {
    auto simulation = buildSimulation(shipped("lag_rotor_controlled.yaml", {std::string("simulation.formulation=") + formulation,
        "subsystems.rotor.initial={lag_1: -0.05, lag_2: -0.05, lag_3: -0.05, lag_4: -0.05}", "simulation.step=2.0e-4"}));
    Vector w = simulation->system().defaultCommand();
    const auto& commands = simulation->system().commandNames();
    w[std::find(commands.begin(), commands.end(), "swashplate.collective") - commands.begin()] = 0.2;
    Recorder record(*simulation, {"rotor.lag_1", "rotor.lag_2", "rotor.lag_3", "rotor.lag_4", "rotor.fuselage_x", "rotor.fuselage_y"});
    ASSERT_TRUE(advance(*simulation, 10000, w));
    double apart = 0.0, fuselage = 0.0, swing = 0.0;
    for (const Vector& row : record.rows) {
      apart = std::max(apart, row.head(4).maxCoeff() - row.head(4).minCoeff());
      fuselage = std::max(fuselage, row.tail(2).cwiseAbs().maxCoeff());
      swing = std::max(swing, std::abs(row[0] - record.rows[0][0]));
    }
    EXPECT_LE(apart, 1e-12) << formulation;
    EXPECT_LE(fuselage, 1e-12) << formulation << ": symmetric motion shakes nothing";
    EXPECT_GT(swing, 1e-3);
  }
}

/// Blade i of the first system is blade i + 1 of the second, whose hub stands a quarter turn back: the same machine.
TEST(Invariants, numberingOfTheBladesDoesNotMatter) {
  const Overrides common{"subsystems.rotor.fuselage_frequency_y=22.0", "simulation.step=2.0e-4", "subsystems.rotor.fuselage_damping_y=1000.0"};
  for (const char* formulation : {"absolute_lag", "printed"}) {
    const Overrides form{std::string("simulation.formulation=") + formulation, "simulation.newton_tolerance=1e-13"};
    auto first = buildSimulation(shipped("lag_rotor_controlled.yaml", common + form + Overrides{
        "subsystems.rotor.lag_frequency=[9.4, 9.0, 9.6, 9.2]", "subsystems.rotor.lag_damper=[250.0, 100.0, 0.0, 400.0]",
        "subsystems.rotor.initial={lag_1: -0.03, lag_2: -0.04, lag_3: -0.02, lag_4: -0.05, fuselage_x: 0.002}", "subsystems.swashplate.trim_longitudinal_cyclic=0.03"}));
    auto second = buildSimulation(shipped("lag_rotor_controlled.yaml", common + form + Overrides{
        "subsystems.rotor.lag_frequency=[9.2, 9.4, 9.0, 9.6]", "subsystems.rotor.lag_damper=[400.0, 250.0, 100.0, 0.0]",
        "subsystems.rotor.initial={lag_1: -0.05, lag_2: -0.03, lag_3: -0.04, lag_4: -0.02, fuselage_x: 0.002}", "subsystems.swashplate.trim_longitudinal_cyclic=0.03",
        "subsystems.drive.initial={angle: -1.5707963267948966}"}));
    ASSERT_TRUE(advance(*first, 5000) && advance(*second, 5000));
    const std::vector<std::string> names{"rotor.lag_1", "rotor.lag_2", "rotor.lag_3", "rotor.lag_4", "rotor.fuselage_x", "rotor.fuselage_y", "mast.twist", "airloads.thrust"};
    const Vector a = look(*first, names), b = look(*second, names);
    // One second apart they differ by round-off, amplified by kappa in the printed form.
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(a[i], b[(i + 1) % 4], 1e-11) << formulation << ", blade " << i + 1;
    for (int i = 4; i < 7; ++i) EXPECT_NEAR(a[i], b[i], 1e-11) << formulation << ", " << names[static_cast<std::size_t>(i)];
    EXPECT_NEAR(a[7], b[7], 1e-11 * std::abs(a[7])) << formulation;
    EXPECT_GT(std::abs(a[0] - a[1]), 1e-4) << "the blades must differ for this to say anything";
  }
}

TEST(Invariants, quarterTurnOfTheDisturbanceTurnsTheFuselageMotion) {
  auto first = buildSimulation(shipped("lag_rotor.yaml"));
  auto second = buildSimulation(shipped("lag_rotor.yaml", {"subsystems.rotor.initial={lag_2: 0.01}"}));
  ASSERT_TRUE(advance(*first, 5000) && advance(*second, 5000));
  const Vector a = look(*first, paperState()), b = look(*second, paperState());
  for (const Index half : {0, 7}) {
    // Blade 2 stands where blade 1 stands a quarter turn later: everything is turned by +90 degrees.
    EXPECT_NEAR(b[half], -a[half + 1], 1e-12);
    EXPECT_NEAR(b[half + 1], a[half], 1e-12);
    for (Index i = 0; i < 4; ++i) EXPECT_NEAR(a[half + 2 + i], b[half + 2 + (i + 1) % 4], 1e-12);
    EXPECT_NEAR(a[half + 6], b[half + 6], 1e-12);
  }
}

}  // namespace
}  // namespace heerk_rotor
