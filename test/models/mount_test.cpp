// The mount: kinematics of the hub, loads, frames and mirror image, bad parameters. Its motion: mount_motion_test.cpp.
#include "models/mount_rig.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

const char* const kGeneral =
    "mass: 50.0, inertia: [30.0, 50.0, 40.0], products_of_inertia: [1.0, 3.0, -2.0], hub_offset: [0.2, -0.1, 1.5], shaft_tilt_forward_deg: 5.0, "
    "gear_stiffness: [600, 700, 900, 800, 500, 400], gear_damping: [7, 6, 5, 4, 3, 2], gear_position: [0.3, 0.2, -1.2], heading_deg: 40.0, roll_deg: -7.0, pitch_deg: 11.0";

std::string general(const std::string& mode) { return std::string(kGeneral) + ", mode: " + mode; }

/// An arbitrary state, its quaternion not of unit length, and arbitrary loads.
void disturb(BareMount& mount) {
  for (Index i = 0; i < mount.x.size(); ++i) mount.x[i] += 0.3 * std::sin(1.0 + 2.0 * static_cast<double>(i));
  for (Index i = 0; i < mount.u.size(); ++i) mount.u[i] = 20.0 * std::cos(3.0 * static_cast<double>(i));
}

TEST(Mount, hubLoadsActAtTheHubInTiltedAxes) {
  BareMount mount("mode: free, gravity: 0.0, mass: 10.0, inertia: [2.0, 3.0, 4.0], hub_offset: [0.5, 0.0, 1.5], shaft_tilt_forward_deg: 30.0");
  mount.u[2] = 100.0;  // thrust
  mount.u[5] = 8.0;    // mast torque
  const double s = 0.5, c = std::sqrt(0.75);
  // Tilted forward, z_H = (s, 0, c): force (100 s, 0, 100 c); its moment (r x F)_y = 1.5 * 100 s - 0.5 * 100 c; torque along z_H.
  const Vector xdot = mount.derivatives();
  EXPECT_TRUE(xdot.segment<3>(kVelocity).isApprox(Vector3d(10.0 * s, 0.0, 10.0 * c), 1e-14));
  EXPECT_TRUE(xdot.segment<3>(kRates).isApprox(Vector3d(8.0 * s / 2.0, (150.0 * s - 50.0 * c) / 3.0, 8.0 * c / 4.0), 1e-14));
  EXPECT_TRUE(mount.output("hub_force").isApprox(Vector3d(0.0, 0.0, 100.0)));
  EXPECT_TRUE(mount.output("hub_moment").isApprox(Vector3d(0.0, 0.0, 8.0)));
  // Specific force at the hub: F/m + omega' x r = (10 s + q' 1.5, r' 0.5, 10 c - q' 0.5) in base_link, then turned by the tilt.
  const double q = (150.0 * s - 50.0 * c) / 3.0, r = 2.0 * c;
  const Vector3d base(10.0 * s + 1.5 * q, 0.5 * r - 1.5 * 8.0 * s / 2.0, 10.0 * c - 0.5 * q);
  const Vector3d hub(c * base[0] - s * base[2], base[1], s * base[0] + c * base[2]);
  EXPECT_TRUE(mount.output("mount_acceleration").head<3>().isApprox(hub, 1e-14));
}

TEST(Mount, weightIsSpecificForceUpwardSeenFromTheTiltedShaft) {
  for (const char* mode : {"rigid", "spring2"}) {
    BareMount mount(std::string("mode: ") + mode + ", shaft_tilt_forward_deg: 30.0");
    // Up is -sin 30 forward of the shaft that leans forward.
    EXPECT_TRUE(mount.output("mount_acceleration").head<3>().isApprox(9.80665 * Vector3d(-0.5, 0.0, std::sqrt(0.75)), 1e-14)) << mode;
    BareMount nose_down(std::string("mode: ") + mode + ", pitch_deg: 20.0, shaft_tilt_forward_deg: 10.0, heading_deg: 77.0");
    EXPECT_TRUE(nose_down.output("mount_acceleration").isApprox(mount.output("mount_acceleration"), 1e-14)) << mode;
    BareMount right_down(std::string("mode: ") + mode + ", roll_deg: 30.0");
    EXPECT_TRUE(right_down.output("mount_acceleration").head<3>().isApprox(9.80665 * Vector3d(0.0, 0.5, std::sqrt(0.75)), 1e-14)) << mode;
    EXPECT_TRUE(BareMount(std::string("gravity: 0.0, mode: ") + mode).output("mount_acceleration").isZero()) << mode;
  }
  // In free fall nothing is felt; on preloaded gear the support is.
  EXPECT_TRUE(BareMount("mode: free").output("mount_acceleration").isZero());
  EXPECT_NEAR(BareMount("mode: spring6").output("mount_acceleration")[2], 9.80665, 1e-14);
}

TEST(Mount, windIsTurnedFromOdomIntoHubLink) {
  BareMount mount("mode: rigid, heading_deg: 90.0, shaft_tilt_forward_deg: 30.0");
  mount.u.tail<3>() << 0.0, -20.0, 0.0;  // from ahead, as the nose points along +y of odom
  EXPECT_TRUE(mount.output("hub_wind").isApprox(20.0 * Vector3d(-std::sqrt(0.75), 0.0, -0.5), 1e-14));
  const CoupledSystem system = buildSystem(loneMount("mode: rigid, wind: [-32.9, 1.0, 2.0]"));
  ASSERT_EQ(system.commandNames().size(), 9u);
  EXPECT_EQ(system.commandNames()[6], "fuselage.wind_x");
  EXPECT_TRUE(system.defaultCommand().tail<3>().isApprox(Vector3d(-32.9, 1.0, 2.0)));
}

TEST(Mount, externalWrenchActsAtTheCentreOfGravityInBaseLink) {
  BareMount mount("mode: free, gravity: 0.0, mass: 10.0, inertia: [2.0, 3.0, 4.0], heading_deg: 90.0");
  mount.u.segment<6>(6) << 20.0, 30.0, 40.0, 2.0, 6.0, 12.0;
  EXPECT_TRUE(mount.derivatives().tail<6>().isApprox((Vector(6) << 2.0, 3.0, 4.0, 1.0, 2.0, 3.0).finished(), 1e-14));
  BareMount planar("mode: spring2, mass_x: 10.0, mass_y: 20.0, heading_deg: 90.0");
  planar.u.segment<3>(6) << 20.0, 30.0, 40.0;  // forward is +y of odom, left is -x
  EXPECT_TRUE(planar.derivatives().isApprox(Eigen::Vector4d(0.0, 0.0, -3.0, 1.0), 1e-14));
}

TEST(Mount, accelerationDependsOnTheLoadsLinearlyWithItsConstantJacobian) {
  for (const char* mode : {"spring2", "spring6", "free"})
    for (const char* rotation : {"ccw", "cw"}) {
      BareMount mount(general(mode) + ", rotation: " + rotation);
      disturb(mount);
      Matrix jacobian = Matrix::Zero(6, 15);
      ASSERT_TRUE(mount.system.subsystems()[0].model->outputJacobian(1, 0.0, in(mount.x), in(mount.u), Eigen::Map<Matrix>(jacobian.data(), 6, 15)));
      const Vector with = mount.output("mount_acceleration"), u = mount.u;
      mount.u.setZero();
      const Vector without = mount.output("mount_acceleration");
      // Linear: one difference of any size is exact to round-off.
      EXPECT_LE((with - without - jacobian * u).norm(), 1e-13 * with.norm()) << mode << " " << rotation;
      EXPECT_GT((with - without).norm(), 0.1);
    }
}

TEST(Mount, hubVelocityAndAccelerationAreTheDerivativesOfItsPositionAndOrientation) {
  const double h = 1e-3;
  auto simulation = buildSimulation(loneMount(general("free") + ", initial: {velocity_x: 3.0, velocity_z: -1.0, rate_x: 1.5, rate_y: -1.0, rate_z: 2.0}", h));
  Vector w = simulation->system().defaultCommand();
  w.head<6>() << 100.0, -60.0, 300.0, 20.0, 30.0, -25.0;
  const std::vector<std::string> names = xyz("hub_position") + wxyz("hub_orientation") + xyz("hub_velocity") + xyz("hub_rate") + xyz("hub_specific_force") + xyz("hub_angular_acceleration");
  Recorder record(*simulation, names);
  ASSERT_TRUE(advance(*simulation, 1000, w));
  double worst_velocity = 0.0, worst_rate = 0.0, worst_acceleration = 0.0, worst_angular = 0.0;
  for (std::size_t n = 2; n + 2 < record.rows.size(); n += 7) {
    const auto slope = [&](Index begin, Index size) {
      const auto at = [&](std::size_t m) -> Vector { return record.rows[m].segment(begin, size); };
      return Vector((8.0 * (at(n + 1) - at(n - 1)) - (at(n + 2) - at(n - 2))) / (12.0 * h));
    };
    const Vector& row = record.rows[n];
    const Quaterniond hub = quaternionOf(row.segment(3, 4));
    const Matrix3d to_hub = hub.toRotationMatrix().transpose();
    const Vector3d velocity = row.segment<3>(7), rate = row.segment<3>(10);
    worst_velocity = std::max(worst_velocity, (to_hub * slope(0, 3) - velocity).norm());
    worst_rate = std::max(worst_rate, (2.0 * (hub.conjugate() * quaternionOf(slope(3, 4))).vec() - rate).norm());
    // d/dt of components in turning axes, and the weight as specific force.
    const Vector3d acceleration = slope(7, 3) + rate.cross(velocity) + to_hub * Vector3d(0.0, 0.0, 9.80665);
    worst_acceleration = std::max(worst_acceleration, (acceleration - row.segment<3>(13)).norm());
    worst_angular = std::max(worst_angular, (slope(10, 3) - row.segment<3>(16)).norm());
  }
  report("hub velocity against differences [m/s]", worst_velocity);
  report("hub acceleration against differences [m/s^2]", worst_acceleration);
  // Differences: h^4 / 30 |d^5/dt^5|. Rates stay below 4 rad/s, the hub turns 1.5 m from the centre of gravity: 1e-12 / 30 * 4^5 * 1.5 m = 5e-11, and
  // four times that for the next derivative; round-off 1e-16 * 10 / h is 1e-12.
  EXPECT_LE(worst_velocity, 1e-10);
  EXPECT_LE(worst_rate, 1e-10);
  EXPECT_LE(worst_acceleration, 4e-10);
  EXPECT_LE(worst_angular, 4e-10);
}

/// A state and its mirror image at the x-z plane of odom.
Vector mirroredBodyState(const Vector& x) {
  Vector m = x;
  for (const int i : {kPosition + 1, kOrientation + 1, kOrientation + 3, kVelocity + 1, kRates + 0, kRates + 2}) m[i] = -m[i];
  return m;
}

TEST(Mount, clockwiseRotorIsTheMirrorImage) {
  const std::string mirrored_general =
      "mass: 50.0, inertia: [30.0, 50.0, 40.0], products_of_inertia: [-1.0, 3.0, 2.0], hub_offset: [0.2, 0.1, 1.5], shaft_tilt_forward_deg: 5.0, rotation: cw, "
      "gear_stiffness: [600, 700, 900, 800, 500, 400], gear_damping: [7, 6, 5, 4, 3, 2], gear_position: [0.3, -0.2, -1.2], heading_deg: -40.0, roll_deg: 7.0, pitch_deg: 11.0";
  for (const char* mode : {"free", "spring6", "rigid", "spring2"}) {
    BareMount ccw(general(mode)), cw(mirrored_general + ", mode: " + mode);
    disturb(ccw);
    cw.u = ccw.u;  // rotor loads: the same, since the rotor side is always in axes in which it turns counter-clockwise
    for (const Index i : {7, 9, 11, 13}) cw.u[i] = -cw.u[i];  // external force y, moment x and z, wind y: true axes
    const bool body = ccw.x.size() == kBodyStates;
    const auto mirrored = [&](const Vector& x) -> Vector {
      return body ? mirroredBodyState(x) : x.size() == 4 ? Vector(x.cwiseProduct(Eigen::Vector4d(1.0, -1.0, 1.0, -1.0))) : x;
    };
    EXPECT_LE((mirrored(BareMount(general(mode)).x) - cw.x).cwiseAbs().sum(), 1e-15) << "the given orientations are mirror images";
    cw.x = mirrored(ccw.x);
    const auto expectEqual = [&](const Vector& a, const Vector& b, const std::string& what) { EXPECT_LE((a - b).norm(), 1e-14 * std::max(1.0, a.norm())) << mode << " " << what; };
    if (ccw.x.size() > 0) expectEqual(mirrored(ccw.derivatives()), cw.derivatives(), "derivatives");
    // To the rotor nothing changes; the fuselage's true axes show the mirror image.
    for (const char* port : {"mount_velocity", "mount_acceleration", "hub_wind"}) expectEqual(ccw.output(port), cw.output(port), port);
    const Vector3d polar(1.0, -1.0, 1.0), axial = -polar;
    for (const char* port : {"hub_force", "hub_position", "fuselage_position", "fuselage_velocity", "fuselage_momentum"})
      expectEqual(polar.cwiseProduct(Vector3d(ccw.output(port))), cw.output(port), port);
    for (const char* port : {"hub_moment", "fuselage_rates", "fuselage_angular_momentum"}) expectEqual(axial.cwiseProduct(Vector3d(ccw.output(port))), cw.output(port), port);
    for (const char* port : {"fuselage_orientation", "hub_orientation"})
      expectEqual(Eigen::Vector4d(1.0, -1.0, 1.0, -1.0).cwiseProduct(Eigen::Vector4d(ccw.output(port))), cw.output(port), port);
    expectEqual(ccw.output("fuselage_energy"), cw.output("fuselage_energy"), "energy");
  }
}

TEST(Mount, oneWordSwapsTheModes) {
  // Parameters and initial values of all modes may stay in the file.
  const std::string everything = general("free") + ", damping: [1.0, 2.0], frequency: 12.0, wind: [1, 2, 3], initial: {position_x: 0.1, position_y_rate: 0.2, orientation_w: 2.0, rate_z: 0.3}";
  for (const char* mode : {"rigid", "spring2", "spring6", "free"})
    EXPECT_NO_THROW(buildSimulation(loneMount(everything, 1e-3, {std::string("subsystems.fuselage.mode=") + mode}))) << mode;
  BareMount mount(everything);
  EXPECT_NEAR(mount.x.segment<4>(kOrientation).norm(), 1.0, 1e-15) << "a given quaternion is made a unit quaternion";
}

TEST(Mount, badParametersAreReported) {
  const auto message = [](const std::string& parameters) -> std::string {
    try {
      buildSystem(loneMount(parameters));
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto expect = [&](const std::string& parameters, const std::string& part) { EXPECT_NE(message(parameters).find(part), std::string::npos) << message(parameters); };
  expect("mode: floating", "one of rigid, spring2, spring6, free");
  expect("mode: spring", "did you mean");
  expect("rotation: left", "one of ccw, cw");
  expect("mass: 0.0", "fuselage.mass = 0.0");
  expect("inertia: [1.0, 2.0]", "a list of 3 numbers [kg m^2]");
  expect("inertia: [1.0, 2.0, 3.1]", "none larger than the sum of the other two");
  expect("inertia: [1.0, -2.0, 2.0]", "fuselage.inertia.1 = -2.0");
  expect("products_of_inertia: [1500.0, 0.0, 4000.0]", "fuselage.products_of_inertia");
  expect("hub_offset: 1.5", "a list of 3 numbers [m]");
  expect("gear_stiffness: [1, 2, 3]", "a list of 6 numbers");
  expect("gear_damping: [1, 2, 3, 4, 5, -6]", "gear_damping.5");
  expect("gear_preload: false, gear_preload_mass: 3.0", "gear_preload_mass");
  expect("stiffness: 3.0, frequency: 2.0", "either frequency or stiffness");
  expect("mass: 3.0, mass_x: 2.0", "either mass, or mass_x and mass_y");
  expect("shaft_tilt_forward_deg: 100", "shaft_tilt_forward_deg");
  expect("gravity: -9.8", "fuselage.gravity");
  expect("wind: [1.0, .nan, 0.0]", "fuselage.wind.1");
  expect("pitch: 3.0", "did you mean 'pitch_deg'");
  expect("mode: free, initial: {orientation_w: 0.0}", "finite");
  expect("mode: free, initial: {position: 0.0}", "position_x");
}

}  // namespace
}  // namespace heerk_rotor
