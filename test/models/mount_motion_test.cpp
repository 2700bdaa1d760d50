// How the fuselage moves without landing gear: closed forms and conserved quantities.
#include "models/mount_rig.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

TEST(MountMotion, torqueFreeSymmetricBodyPrecessesLikeTheClosedForm) {
  // I1 = I2: the figure axis turns about the fixed angular momentum H at |H| / I1, and the body about its axis at (I1 - I3) / I1 omega_3.
  const double I1 = 3.0, I3 = 5.0, duration = 2.0;
  const Vector3d rates(1.0, 0.5, 4.0);
  const auto error = [&](double h) {
    auto simulation = buildSimulation(loneMount("mode: free, gravity: 0.0, mass: 7.0, inertia: [3.0, 3.0, 5.0], heading_deg: 30.0, pitch_deg: -50.0, roll_deg: 20.0, "
                                                "initial: {rate_x: 1.0, rate_y: 0.5, rate_z: 4.0}", h));
    const Quaterniond start = quaternionOf(simulation->state().segment<4>(kOrientation));
    const Vector3d momentum = start * Vector3d(I1 * rates[0], I1 * rates[1], I3 * rates[2]);
    EXPECT_TRUE(advance(*simulation, std::lround(duration / h)));
    const Quaterniond expected = turn(momentum.norm() / I1 * duration, momentum.normalized()) * start * turn((I1 - I3) / I1 * rates[2] * duration, Vector3d::UnitZ());
    return angleBetween(expected, quaternionOf(simulation->state().segment<4>(kOrientation).normalized()));
  };
  const double coarse = error(1e-2), fine = error(5e-3), finest = error(5e-4);
  report("precession, h = 5e-3 [rad]", fine);
  report("precession, order", std::log2(coarse / fine));
  EXPECT_GT(std::log2(coarse / fine), 3.8);
  EXPECT_LE(finest, 1e-12);  // 2e-10 (h = 5e-3) / 10^4, and round-off
}

TEST(MountMotion, torqueFreeBodyKeepsEnergyAndAngularMomentum) {
  // Spin about the middle principal axis: the body turns over again and again. Products of inertia take part.
  const std::vector<std::string> names = xyz("angular_momentum") + xyz("momentum") + Overrides{"fuselage.fuselage_energy"};
  const auto drift = [&](double h) {
    auto simulation = buildSimulation(loneMount("mode: free, gravity: 0.0, mass: 10.0, inertia: [2.0, 3.0, 4.0], products_of_inertia: [0.2, -0.3, 0.1], "
                                                "initial: {rate_x: 0.01, rate_y: 5.0, velocity_x: 2.0, velocity_z: 1.0, position_y: 3.0}", h));
    const Vector before = look(*simulation, names);
    EXPECT_TRUE(advance(*simulation, std::lround(4.0 / h)));
    const Vector after = look(*simulation, names);
    EXPECT_GT(std::abs(after.head<3>().norm()), 1.0);
    return ((after - before).cwiseAbs().array() / (1.0 + before.cwiseAbs().array())).maxCoeff();
  };
  const double coarse = drift(4e-3), fine = drift(2e-3), finest = drift(2e-4);
  report("torque-free body, drift at h = 2e-3", fine);
  EXPECT_GT(coarse / fine, 14.0) << "fourth order";
  EXPECT_LE(finest, 1e-11);
}

TEST(MountMotion, tumblingBodyFallsLikeAPoint) {
  auto simulation = buildSimulation(loneMount("mode: free, inertia: [2.0, 3.0, 4.0], mass: 10.0, initial: {position_z: 100.0, velocity_x: 5.0, rate_x: 1.0, rate_y: 2.0, rate_z: -1.5}"));
  ASSERT_TRUE(advance(*simulation, 2000));
  const Vector y = look(*simulation, xyz("position") + Overrides{"fuselage.fuselage_energy"});
  EXPECT_NEAR(y[0], 10.0, 1e-9);
  EXPECT_NEAR(y[1], 0.0, 1e-9);
  EXPECT_NEAR(y[2], 100.0 - 0.5 * 9.80665 * 4.0, 1e-9);
  EXPECT_NEAR(y[3], 10.0 * 9.80665 * 100.0 + 5.0 * 25.0 + 0.5 * (2.0 + 3.0 * 4.0 + 4.0 * 2.25), 1e-6);
}

TEST(MountMotion, constantWrenchGivesUniformAcceleration) {
  auto simulation = buildSimulation(loneMount("mode: free, gravity: 0.0, mass: 10.0, inertia: [2.0, 3.0, 4.0]"));
  Vector w = simulation->system().defaultCommand();
  w.head<6>() << 0.0, 0.0, 30.0, 0.0, 0.0, 12.0;  // along and about z: the body's axis keeps its direction
  ASSERT_TRUE(advance(*simulation, 1500, w));
  const Vector y = look(*simulation, xyz("position") + wxyz("orientation") + xyz("rate"), w);
  EXPECT_NEAR(y[2], 0.5 * 3.0 * 2.25, 1e-11);
  EXPECT_NEAR(y[9], 3.0 * 1.5, 1e-11);
  const double half = 0.5 * 0.5 * 3.0 * 2.25;  // half of the angle
  // RK4 on a rotation at omega <= 4.5 rad/s: omega^5 h^4 t / 120 / 32.
  EXPECT_NEAR(y[3], std::cos(half), 1e-11);
  EXPECT_NEAR(y[6], std::sin(half), 1e-11);
}

TEST(MountMotion, quaternionReturnsToUnitLengthWithoutTurning) {
  const char* const parameters = "mode: free, inertia: [2.0, 3.0, 4.0], norm_feedback: 2.0, initial: {rate_x: 1.0, rate_y: 2.0, rate_z: -1.5}";
  auto clean = buildSimulation(loneMount(parameters)), drifted = buildSimulation(loneMount(parameters));
  Vector x = drifted->state();
  x.segment<4>(kOrientation) *= 1.2;
  drifted->setState(x);
  ASSERT_TRUE(advance(*clean, 500) && advance(*drifted, 500));
  // n = |q|: n' = k (1 - n^2) n, hence 1/n^2 - 1 decays with e^{-2 k t}.
  const double expected = 1.0 / std::sqrt(1.0 + (1.0 / 1.44 - 1.0) * std::exp(-2.0 * 2.0 * 0.5));
  EXPECT_NEAR(drifted->state().segment<4>(kOrientation).norm(), expected, 1e-11);
  EXPECT_LE(angleBetween(quaternionOf(look(*clean, wxyz("orientation"))), quaternionOf(look(*drifted, wxyz("orientation")))), 1e-11);
}

TEST(MountMotion, planarSupportOscillatesLikeTheClosedForm) {
  auto simulation = buildSimulation(loneMount("mode: spring2, mass_x: 10.0, mass_y: 20.0, stiffness: [1000.0, 500.0], damping: [20.0, 0.0], heading_deg: 90.0, "
                                              "initial: {position_x: 0.1, position_y_rate: 2.0}"));
  Vector w = simulation->system().defaultCommand();
  w[0] = 25.0;  // forward is +y of odom: static deflection 25 / 500
  ASSERT_TRUE(advance(*simulation, 1000, w));
  const double t = 1.0, decay = 1.0, wx = std::sqrt(100.0 - 1.0), wy = 5.0;
  EXPECT_NEAR(simulation->state()[0], 0.1 * std::exp(-decay * t) * (std::cos(wx * t) + decay / wx * std::sin(wx * t)), 1e-10);
  EXPECT_NEAR(simulation->state()[1], 0.05 * (1.0 - std::cos(wy * t)) + 2.0 / wy * std::sin(wy * t), 1e-10);
  // Forward velocity is that along y of odom.
  EXPECT_NEAR(look(*simulation, {"fuselage.velocity_x"}, w)[0], simulation->state()[3], 1e-15);
}

}  // namespace
}  // namespace heerk_rotor
