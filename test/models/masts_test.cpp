// Masts that turn a hub of their own on a mount that moves (for rotors with elastic blades). Masts of the lag rotor: elastic_mast_test.cpp.
#include <random>

#include <Eigen/Geometry>

#include "heerk_rotor/models/elastic_mast.hpp"
#include "heerk_rotor/models/registry.hpp"
#include "heerk_rotor/models/rigid_mast.hpp"
#include "models/mast_rig.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kInertia = 60.0, kSpeed = 44.0, kStiffness = 3e5, kDamping = 40.0;
const MastLoad kHub{LagFormulation::kPrinted, kInertia, 0.0, 0.0};

ElasticMast elasticMast() { return ElasticMast({kStiffness, kDamping, kSpeed}, kHub, MastHub::kOwn); }
RigidMast rigidMast() { return RigidMast(kSpeed, kHub, MastHub::kOwn); }

template <class Model>
Vector output(Model& model, MastOutput port, const Vector& x, const Vector& u) {
  Vector y = Vector::Zero(model.outputs()[static_cast<std::size_t>(port)].size);
  model.evalOutput(port, 0.0, in(x), in(u), view(y));
  return y;
}

/// blade_reaction, drive (3), mount_velocity (6), mount_acceleration (6).
Vector inputs(double reaction, double drive_rate, double drive_acceleration, double p, double q, double r, double yaw_acceleration) {
  Vector u = Vector::Constant(16, 1e3);  // what must not matter is not zero
  u[0] = reaction;
  u.segment(1, 3) << 0.3, drive_rate, drive_acceleration;
  u.segment(7, 3) << p, q, r;
  u[15] = yaw_acceleration;
  return u;
}

TEST(MastWithOwnHub, hubAccelerationIsRelativeToTheYawingMount) {
  // Nothing turns the hub: it keeps its speed in space, and a mount that starts to yaw to the left sees it fall behind.
  ElasticMast mast = elasticMast();
  EXPECT_EQ(output(mast, kHubAcceleration, Vector::Zero(2), inputs(0, 0, 0, 0, 0, 0, 0.7))[0], -0.7);
  // I (alpha + r') = -K_s twist - c twist' + R by hand: (-900 - 2 + 1502) / 60 - 0.7 = 9.3.
  const Vector x = (Vector(2) << 3e-3, 0.05).finished();
  EXPECT_NEAR(output(mast, kHubAcceleration, x, inputs(1502, 0, 2.0, 0, 0, 0, 0.7))[0], 9.3, 1e-12);
  Vector xdot(2);
  mast.evalDerivatives(0.0, in(x), in(inputs(1502, 0, 2.0, 0, 0, 0, 0.7)), view(xdot));
  EXPECT_NEAR(xdot[1], 9.3 - 2.0, 1e-12);  // twist'' = alpha - drive''
}

TEST(MastWithOwnHub, rigidMastPassesOnTheReactionLessWhatAcceleratesTheHub) {
  RigidMast mast = rigidMast();
  EXPECT_EQ(output(mast, kTorque, Vector(), inputs(1500, 0, 2.0, 0, 0, 0, 0.5))[0], 1500 - kInertia * 2.5);
  EXPECT_EQ(output(mast, kHubAcceleration, Vector(), inputs(1500, 0, 2.0, 0, 0, 0, 0.5))[0], 2.0);
}

TEST(MastWithOwnHub, rollingRightTurnsTheMountNoseDown) {
  // Counter-clockwise hub, H up. Rolling right (p > 0: left side up, H tips to the right, -y) changes H by omega x H dt = (p,0,0) x (0,0,H) dt =
  // (0, -p H, 0) dt. The mount must supply that moment, so the hub acts on the mount with (0, +p H): nose down (y is left).
  ElasticMast mast = elasticMast();
  const double speed = kSpeed + 0.4 + 0.05 + 0.01;  // drive rate, twist rate, yaw rate: H counts the speed in space
  const Vector x = (Vector(2) << 3e-3, 0.05).finished();
  const Vector roll = output(mast, kGyroscopicMoment, x, inputs(0, 0.4, 0, 0.2, 0, 0.01, 0));
  EXPECT_EQ(roll[0], 0.0);
  EXPECT_NEAR(roll[1], 0.2 * kInertia * speed, 1e-12 * roll[1]);
  // Pitching nose down (q > 0) tips H forward, dH = (q H, 0, 0) dt; the reaction rolls the mount to the left.
  const Vector pitch = output(mast, kGyroscopicMoment, x, inputs(0, 0.4, 0, 0, 0.3, 0.01, 0));
  EXPECT_NEAR(pitch[0], -0.3 * kInertia * speed, -1e-12 * pitch[0]);
  EXPECT_EQ(pitch[1], 0.0);
  RigidMast rigid = rigidMast();
  EXPECT_NEAR(output(rigid, kGyroscopicMoment, Vector(), inputs(0, 0.4, 0, 0.2, 0, 0.01, 0))[1], 0.2 * kInertia * (kSpeed + 0.41), 1e-10);
}

TEST(MastWithOwnHub, gyroscopicMomentDoesNoWorkAndTurnsTheMomentumVector) {
  ElasticMast mast = elasticMast();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 100; ++k) {
    const Vector x = (Vector(2) << 1e-3 * unit(random), unit(random)).finished();
    const Vector u = inputs(0, unit(random), 0, unit(random), unit(random), unit(random), 0);
    const Vector moment = output(mast, kGyroscopicMoment, x, u);
    const double momentum = output(mast, kHubAngularMomentum, x, u)[0];
    EXPECT_NEAR(momentum, kInertia * (kSpeed + u[2] + x[1] + u[9]), 1e-12 * momentum);
    // p (-q H) + q (p H) = 0 to round-off of the products.
    EXPECT_NEAR(moment[0] * u[7] + moment[1] * u[8], 0.0, 1e-12);
    // The moment on the hub, -moment, is the rate of a vector of constant length fixed in the mount: omega x H.
    const Eigen::Vector3d rate = Eigen::Vector3d(u[7], u[8], u[9]).cross(Eigen::Vector3d(0, 0, momentum));
    EXPECT_NEAR(-moment[0], rate[0], 1e-9);
    EXPECT_NEAR(-moment[1], rate[1], 1e-9);
  }
}

TEST(MastWithOwnHub, stiffBlockIsTheFrequencyOfTheHubOnItsSpring) {
  const auto part = std::get<ModalStiff>(elasticMast().stiffPart());
  EXPECT_NEAR(part.omega[0], std::sqrt(kStiffness / kInertia), 1e-12);
  EXPECT_NEAR(part.damping[0], kDamping / kInertia, 1e-12);
}

TEST(MastWithOwnHub, freeBodyAndHubKeepTheirAngularMomentumWhileTheMastRings) {
  CouplingGraph graph;
  graph.add("mast", std::make_unique<ElasticMast>(elasticMast()), {{"twist", 0.01}, {"twist_rate", -0.3}});
  graph.add("body", std::make_unique<YawingBody>());
  graph.connect("mast.torque", "body.torque");
  graph.connect("body.velocity", "mast.mount_velocity");
  graph.connect("body.acceleration", "mast.mount_acceleration");
  graph.add("blades", std::make_unique<HubMoment>(0.0));
  graph.connect("blades.moment", "mast.blade_reaction");
  auto simulation = simulationOf(std::move(graph), 1e-3);
  Recorder record(*simulation, {"mast.hub_angular_momentum", "body.yaw_rate", "mast.twist"});
  ASSERT_TRUE(advance(*simulation, 2000));
  const auto total = [&](const Vector& row) { return row[0] + YawingBody::kInertia * row[1]; };
  double worst = 0.0, swing = 0.0;
  for (const Vector& row : record.rows) {
    worst = std::max(worst, std::abs(total(row) - total(record.rows[0])));
    swing = std::max(swing, std::abs(row[0] - record.rows[0][0]));
  }
  EXPECT_GT(swing, 10.0);
  // Momentum is linear in the states and its rate vanishes identically: only the exponential of the twist against the polynomial of the yaw
  // rate, of fourth order, leaves something: (omega h)^4 / 120 = 3e-7 at omega h = 0.076.
  report("momentum defect of hub and body [kg m^2/s]", worst);
  EXPECT_LE(worst, 1e-6 * swing);
  // And the twist rings at the frequency of two inertias against each other, omega^2 = K (1 / I + 1 / I_body).
  std::vector<double> crossing;
  for (std::size_t k = 1; k < record.rows.size(); ++k) {
    const double a = record.rows[k - 1][2], b = record.rows[k][2];
    if (a < 0.0 && b >= 0.0) crossing.push_back(record.t[k - 1] + 1e-3 * a / (a - b));
  }
  ASSERT_GT(crossing.size(), 10u);
  const double period = (crossing.back() - crossing.front()) / static_cast<double>(crossing.size() - 1);
  const double inverse = 1.0 / kInertia + 1.0 / YawingBody::kInertia, decay = 0.5 * kDamping * inverse;
  EXPECT_NEAR(2.0 * M_PI / period, std::sqrt(kStiffness * inverse - decay * decay), 1e-3);  // interpolated crossings: 1e-5 of 75 rad/s
}

TEST(MastWithOwnHub, hubInertiaIsRequiredBesideElasticBladesAndReportedByName) {
  for (const char* type : {"elastic_mast", "rigid_mast"}) {
    const Configuration configuration = Configuration::parse(
        "simulation: {rotor_speed: 41.0, step: 1.0e-3}\nsubsystems:\n  fe: {type: fe_rotor}\n  mast: {type: " + std::string(type) + "}\n", "mast");
    Problems problems;
    const SimulationSettings settings = readSimulationSettings(configuration, problems);
    Section section(configuration, "subsystems.mast", problems);
    section.word("type", "");
    for (const ModelType& registered : modelTypes())
      if (registered.name == type) registered.make(section, {configuration, settings, "mast", problems});
    ASSERT_EQ(problems.list().size(), 1u) << problems.text();
    EXPECT_NE(problems.text().find("hub_inertia"), std::string::npos) << problems.text();
  }
}

}  // namespace
}  // namespace heerk_rotor
