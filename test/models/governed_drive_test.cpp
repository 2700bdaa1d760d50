#include "heerk_rotor/models/governed_drive.hpp"

#include <cmath>

#include "heerk_rotor/models/elastic_mast.hpp"
#include "heerk_rotor/models/registry.hpp"
#include "heerk_rotor/models/rigid_mast.hpp"
#include "models/mast_rig.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kSpeed = 44.0, kInertia = 200.0, kHubInertia = 60.0, kTorque = 7000.0, kKp = 1500.0, kKi = 4000.0;
const MastLoad kHub{LagFormulation::kPrinted, kHubInertia, 0.0, 0.0};

GovernedDrive::Parameters parameters() {
  GovernedDrive::Parameters p;
  p.rotor_speed = kSpeed;
  p.inertia = kInertia;
  p.proportional_gain = kKp;
  p.integral_gain = kKi;
  p.engine_torque = kTorque;
  p.min_torque = 0.0;
  p.max_torque = 14000.0;
  p.min_speed = 20.0;
  p.max_speed = 50.0;
  return p;
}

/// Engine, rigid mast and a hub that takes `load`: one rigid inertia. The mount stands still.
std::unique_ptr<Simulation> rigidRig(const GovernedDrive::Parameters& p, double load, double h = 1e-3) {
  CouplingGraph graph;
  graph.add("drive", std::make_unique<GovernedDrive>(p));
  graph.add("mast", std::make_unique<RigidMast>(kSpeed, kHub, MastHub::kOwn));
  graph.add("load", std::make_unique<HubMoment>(-load));
  graph.connect("drive.drive", "mast.drive");
  graph.connect("mast.torque", "drive.mast_torque");
  graph.connect("load.moment", "mast.blade_reaction");
  return simulationOf(std::move(graph), h);
}

Vector speed(double value) { return Vector::Constant(1, value); }

/// Small-signal response of the rotor speed to a unit step of the command: I rate'' = -Kp rate' + Ki (1 - rate), rate'(0) = Kp / I.
double stepResponse(double t) {
  const double inertia = kInertia + kHubInertia, decay = 0.5 * kKp / inertia, wd = std::sqrt(kKi / inertia - decay * decay);
  return 1.0 - std::exp(-decay * t) * (std::cos(wd * t) - decay / wd * std::sin(wd * t));
}

TEST(GovernedDrive, smallSpeedStepFollowsTheClosedFormOfThePiGovernor) {
  // The rigid mast closes an algebraic loop (drive acceleration, mast torque), so this also tests that engine and hub turn as one inertia.
  auto simulation = rigidRig(parameters(), kTorque);
  const double step = 1e-3;
  for (int k = 1; k <= 40; ++k) {
    ASSERT_TRUE(advance(*simulation, 50, speed(kSpeed + step)));
    // The limit departs by (Kp step / 7000)^2 / 3 < 2e-8, HEERK4 at omega h = 0.004 by less.
    EXPECT_NEAR(look(*simulation, {"drive.drive_rate"}, speed(kSpeed + step))[0], step * stepResponse(0.05 * k), 1e-7 * step) << k;
  }
}

TEST(GovernedDrive, gainsAreAsGivenAlsoWhereTheTrimTorqueIsNearALimit) {
  GovernedDrive::Parameters p = parameters();
  p.engine_torque = 12000.0;
  auto simulation = rigidRig(p, p.engine_torque);
  const double step = 1e-5;
  ASSERT_TRUE(advance(*simulation, 300, speed(kSpeed + step)));
  // Second order of the limiter: tanh0 / (s_0 span) Kp step = 0.71 / (0.49 7000) 0.015 = 3e-6.
  EXPECT_NEAR(look(*simulation, {"drive.drive_rate"}, speed(kSpeed + step))[0], step * stepResponse(0.3), 1e-5 * step);
}

TEST(GovernedDrive, heldTorqueIsTheLoadAndTheSpeedReturnsExactly) {
  const double load = 9500.0;  // 2500 N m more than the engine gives at first
  auto simulation = rigidRig(parameters(), load);
  Recorder record(*simulation, {"drive.drive_rate"});
  ASSERT_TRUE(advance(*simulation, 20000, speed(kSpeed)));
  double droop = 0.0;
  for (const Vector& row : record.rows) droop = std::min(droop, row[0]);
  EXPECT_LT(droop, -0.3);  // the rotor slows down before the integral finds the load
  const Vector y = look(*simulation, {"drive.engine_torque", "drive.torque", "mast.torque", "drive.drive_rate"}, speed(kSpeed));
  EXPECT_NEAR(y[0], load, 1e-8 * load);   // e^{-2.9 t} after 20 s
  EXPECT_NEAR(y[1], -load, 1e-8 * load);  // the fuselage is turned against the rotor: nose right
  EXPECT_NEAR(y[2], -load, 1e-8 * load);  // which is what the mast of a kinematic drive would pass on
  EXPECT_NEAR(y[3], 0.0, 1e-9);
}

TEST(GovernedDrive, torqueKeepsItsLimitsAndTheIntegralDoesNotWindUp) {
  auto simulation = rigidRig(parameters(), kTorque);
  Recorder record(*simulation, {"drive.engine_torque", "drive.drive_rate"});
  const double step = 6.0;  // Kp e = 9000 N m: beyond the limit for a quarter of a second
  ASSERT_TRUE(advance(*simulation, 15000, speed(kSpeed + step)));
  double most = 0.0, peak = 0.0, linear_peak = 0.0;
  for (std::size_t k = 0; k < record.rows.size(); ++k) {
    EXPECT_GT(record.rows[k][0], 0.0);
    EXPECT_LT(record.rows[k][0], 14000.0);
    most = std::max(most, record.rows[k][0]);
    peak = std::max(peak, record.rows[k][1] / step);
    linear_peak = std::max(linear_peak, stepResponse(record.t[k]));
  }
  report("overshoot with torque limit", peak - 1.0);
  report("overshoot without limit", linear_peak - 1.0);
  EXPECT_GT(most, 12500.0);
  EXPECT_LE(peak, linear_peak) << "a wound-up integral would overshoot further than the unlimited governor";
  EXPECT_NEAR(record.rows.back()[1], step, 1e-6);
}

TEST(GovernedDrive, commandsBeyondTheRangeAreTakenAsItsEnds) {
  for (const auto& [command, expected] : {std::pair<double, double>{90.0, 50.0}, {-3.0, 20.0}}) {
    auto simulation = rigidRig(parameters(), 3000.0);
    ASSERT_TRUE(advance(*simulation, 30000, speed(command)));
    EXPECT_NEAR(look(*simulation, {"mast.rotor_speed"}, speed(command))[0], expected, 1e-6);
  }
}

TEST(GovernedDrive, withoutGovernorTheRotorRunsDownExponentially) {
  GovernedDrive::Parameters p = parameters();
  p.governor = false;
  p.engine_torque = 0.0;
  const double damping = 90.0;  // [N m s/rad]
  CouplingGraph graph;
  graph.add("drive", std::make_unique<GovernedDrive>(p));
  graph.add("load", std::make_unique<HubMoment>(-damping * kSpeed, damping));  // -damping (Omega + rate)
  graph.connect("load.moment", "drive.mast_torque");
  graph.connect("drive.drive", "load.drive");
  auto simulation = simulationOf(std::move(graph), 1e-2);
  EXPECT_EQ(simulation->system().commandSize(), 0) << "nothing to command";
  ASSERT_TRUE(advance(*simulation, 500));
  const double expected = kSpeed * std::exp(-damping / kInertia * 5.0);
  EXPECT_NEAR(kSpeed + look(*simulation, {"drive.drive_rate"})[0], expected, 1e-8 * kSpeed);  // (0.45 h)^4 / 120 per unit time
}

TEST(GovernedDrive, engineMastHubAndBodyKeepTheirAngularMomentum) {
  CouplingGraph graph;
  graph.add("drive", std::make_unique<GovernedDrive>(parameters()));
  graph.add("mast", std::make_unique<ElasticMast>(ElasticMast::Parameters{3e5, 40.0, kSpeed}, kHub, MastHub::kOwn), {{"twist", 0.01}});
  graph.add("body", std::make_unique<YawingBody>());
  graph.add("blades", std::make_unique<HubMoment>(0.0));
  graph.connect("drive.drive", "mast.drive");
  graph.connect("mast.torque", "drive.mast_torque");
  graph.connect("blades.moment", "mast.blade_reaction");
  graph.connect("drive.torque", "body.torque");
  for (const char* model : {"mast", "drive"}) {
    graph.connect("body.velocity", std::string(model) + ".mount_velocity");
    graph.connect("body.acceleration", std::string(model) + ".mount_acceleration");
  }
  auto simulation = simulationOf(std::move(graph), 1e-3);
  Recorder record(*simulation, {"mast.hub_angular_momentum", "drive.drive_angular_momentum", "body.yaw_rate"});
  ASSERT_TRUE(advance(*simulation, 3000, speed(40.0)));
  const auto total = [](const Vector& row) { return row[0] + row[1] + YawingBody::kInertia * row[2]; };
  double worst = 0.0, exchanged = 0.0;
  for (const Vector& row : record.rows) {
    worst = std::max(worst, std::abs(total(row) - total(record.rows[0])));
    exchanged = std::max(exchanged, YawingBody::kInertia * std::abs(row[2]));
  }
  report("momentum defect of engine, hub and body [kg m^2/s]", worst);
  EXPECT_GT(exchanged, 500.0);
  // The rate of the sum vanishes identically; between the exponential of the twist and the polynomials of the rest a difference of fourth
  // order remains, (omega h)^4 / 120 = 2e-7 of what the ringing mast exchanges (40 kg m^2/s), as in masts_test.cpp.
  EXPECT_LE(worst, 1e-6 * exchanged);
}

TEST(GovernedDrive, gyroscopicMomentIsThatOfItsInertia) {
  GovernedDrive drive(parameters());
  Vector u = Vector::Zero(14), y = Vector::Zero(2), x = (Vector(3) << 0.0, 0.5, 0.0).finished();
  u.segment(4, 3) << 0.2, -0.3, 0.1;
  drive.evalOutput(3, 0.0, in(x), in(u), view(y));
  EXPECT_NEAR(y[0], 0.3 * kInertia * 44.6, 1e-9);  // -q H
  EXPECT_NEAR(y[1], 0.2 * kInertia * 44.6, 1e-9);  // +p H
}

TEST(GovernedDrive, trimTorqueAtALimitIsAProblemOfTheConfiguration) {
  EXPECT_THROW(GovernedDrive([] { auto p = parameters(); p.engine_torque = p.max_torque; return p; }()), std::invalid_argument);
  for (const char* torque : {"14000.0", "0.0"}) {
    const Configuration configuration = Configuration::parse("simulation: {rotor_speed: 44.0, step: 1.0e-3}\nsubsystems:\n  drive: {type: governed_drive, max_torque: 14000.0, engine_torque: " +
                                                             std::string(torque) + "}\n", "drive");
    Problems problems;
    const SimulationSettings settings = readSimulationSettings(configuration, problems);
    Section section(configuration, "subsystems.drive", problems);
    section.word("type", "");
    for (const ModelType& type : modelTypes())
      if (type.name == "governed_drive") type.make(section, {configuration, settings, "drive", problems});
    ASSERT_EQ(problems.list().size(), 1u) << problems.text();
    EXPECT_EQ(problems.list()[0].key, "subsystems.drive.engine_torque");
  }
}

}  // namespace
}  // namespace heerk_rotor
