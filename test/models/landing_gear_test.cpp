// The fuselage on its landing gear: rest, frequencies, work of springs and dampers, balances.
#include <Eigen/Eigenvalues>
#include <complex>

#include "models/mount_rig.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

TEST(LandingGear, fuselageRestsOnPreloadedGearAndSettlesOnUnloaded) {
  // On a slope, gear aside of the centre of gravity: the preload carries the weight and its moment.
  const std::string slope = "mode: spring6, roll_deg: 12.0, pitch_deg: -8.0, heading_deg: 130.0, gear_position: [0.4, -0.3, -1.1]";
  BareMount preloaded(slope);
  EXPECT_LE(preloaded.derivatives().norm(), 1e-12);
  EXPECT_NEAR(preloaded.output("fuselage_energy")[0], 0.0, 1e-9);
  EXPECT_GT(BareMount(slope + ", gear_preload: false").derivatives().norm(), 5.0);

  BareMount settled("mode: spring6, gear_preload: false, mass: 1000.0, gear_stiffness: [1e5, 1e5, 2e5, 1e6, 1e6, 1e6]");
  settled.x[kPosition + 2] = -1000.0 * 9.80665 / 2e5;
  EXPECT_LE(settled.derivatives().norm(), 1e-12);
  BareMount heavier("mode: spring6, gear_preload_mass: 1100.0, mass: 1000.0, gear_stiffness: [1e5, 1e5, 2e5, 1e6, 1e6, 1e6]");
  heavier.u[2] = -100.0 * 9.80665;  // a rotor of 100 kg makes up the weight
  EXPECT_LE(heavier.derivatives().norm(), 1e-12);
}

/// Undamped circular frequencies of M q'' + K q = 0, two coordinates.
std::vector<double> frequencies(const Eigen::Matrix2d& M, const Eigen::Matrix2d& K) {
  const Eigen::Vector2d squares = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d>(K, M).eigenvalues();
  return {std::sqrt(squares[0]), std::sqrt(squares[1])};
}

TEST(LandingGear, smallMotionOnTheGearHasTheClosedFormFrequencies) {
  const double m = 2000.0, Ix = 1400.0, Iy = 5000.0, Iz = 4100.0, h = 1.2, g = 9.80665;
  const double kx = 5e5, ky = 4e5, kz = 9e5, krx = 1.5e6, kry = 7e5, krz = 8e5;
  ReducedOde ode(loneMount("mode: spring6, heading_deg: 40.0, mass: 2000.0, inertia: [1400.0, 5000.0, 4100.0], gear_position: [0.0, 0.0, -1.2], "
                           "gear_stiffness: [5e5, 4e5, 9e5, 1.5e6, 7e5, 8e5], gear_damping: [0, 0, 0, 0, 0, 0], norm_feedback: 0.0"));
  std::vector<double> found;
  const Matrix jacobian = ode.jacobian(0.0, ode.system.initialState(), 1e-5);
  const Eigen::EigenSolver<Matrix> modes(jacobian, false);
  for (const std::complex<double>& value : modes.eigenvalues())
    if (value.imag() > 1.0) found.push_back(value.imag());
  std::sort(found.begin(), found.end());
  // Gear h below the centre of gravity: displacement of A is y + h roll, x - h pitch; the preloaded gear carries the weight from below, which
  // takes m g h from the stiffness against rotation (inverted pendulum).
  std::vector<double> expected{std::sqrt(kz / m), std::sqrt(krz / Iz)};
  const auto add = [&](double inertia, double k, double k_rotation, double lever) {
    Eigen::Matrix2d M, K;
    M << m, 0.0, 0.0, inertia;
    K << k, k * lever, k * lever, k_rotation + k * h * h - m * g * h;
    for (const double w : frequencies(M, K)) expected.push_back(w);
  };
  add(Ix, ky, krx, h);
  add(Iy, kx, kry, -h);
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(found.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(found[i], expected[i], 1e-7 * expected[i]);  // differences with a step of 1e-5: 1e-10 relative
}

TEST(LandingGear, defaultGearIsWellDampedAndClearOfTheRegressingLagMode) {
  // A soft in-plane rotor at 44.4 rad/s with a lag frequency of 0.67 per revolution has its regressing lag mode at 15 rad/s in the fixed frame.
  ReducedOde ode(loneMount("mode: spring6, norm_feedback: 0.0"));
  const Matrix jacobian = ode.jacobian(0.0, ode.system.initialState(), 1e-5);
  const Eigen::EigenSolver<Matrix> modes(jacobian, false);
  int oscillators = 0;
  for (const std::complex<double>& value : modes.eigenvalues()) {
    if (value.imag() <= 1.0) continue;
    ++oscillators;
    EXPECT_GT(std::abs(value), 25.0);
    EXPECT_GT(-value.real() / std::abs(value), 0.08);
  }
  EXPECT_EQ(oscillators, 6);
}

const char* const kTumblingOnSprings =
    "mode: spring6, mass: 10.0, inertia: [2.0, 3.0, 4.0], products_of_inertia: [0.2, -0.3, 0.1], gear_position: [0.2, 0.1, -0.5], heading_deg: 40.0, roll_deg: 10.0, "
    "gear_stiffness: [400, 500, 600, 60, 70, 80], initial: {position_x: 0.2, position_z: -0.3, rate_x: 5.0, rate_y: -4.0, rate_z: 7.0}";

TEST(LandingGear, undampedGearConservesEnergyInLargeMotion) {
  double largest = 0.0;
  const auto drift = [&](double h) {
    auto simulation = buildSimulation(loneMount(std::string(kTumblingOnSprings) + ", gear_damping: [0, 0, 0, 0, 0, 0]", h));
    const Quaterniond start = quaternionOf(simulation->state().segment<4>(kOrientation));
    const double before = look(*simulation, {"fuselage.fuselage_energy"})[0];
    Recorder record(*simulation, wxyz("orientation") + Overrides{"fuselage.fuselage_energy"});
    EXPECT_TRUE(advance(*simulation, std::lround(2.0 / h)));
    double worst = 0.0;
    for (const Vector& row : record.rows) {
      worst = std::max(worst, std::abs(row[4] - before));
      largest = std::max(largest, angleBetween(start, quaternionOf(row.head<4>())));
    }
    return worst / (0.5 * (2.0 * 25.0 + 3.0 * 16.0 + 4.0 * 49.0));  // of the kinetic energy at the start
  };
  const double coarse = drift(4e-3), fine = drift(2e-3), finest = drift(2e-4);
  report("energy of the sprung body, h = 2e-3", fine);
  report("energy of the sprung body, h = 2e-4", finest);
  EXPECT_GT(largest, 1.9) << "2 sin(angle / 2): beyond 140 degrees, where no small-angle spring would do";
  EXPECT_GT(coarse / fine, 14.0) << "fourth order";
  EXPECT_LE(finest, 1e-12);  // 5e-10 (h = 2e-3) / 10^4, and round-off
}

TEST(LandingGear, springsAreTheGradientOfTheirEnergyAndDampersDissipate) {
  // Along the motion dE/dt is the power of the dampers, for arbitrary velocity and rates: then every component of the gradient is right.
  for (const bool preload : {true, false}) {
    BareMount mount(std::string(kTumblingOnSprings) + ", gear_damping: [3, 2, 4, 5, 7, 6], norm_feedback: 0.0" + (preload ? "" : ", gear_preload: false"));
    for (int k = 0; k < 40; ++k) {
      for (Index i = 0; i < kBodyStates; ++i) mount.x[i] = std::sin(1.0 + 13.0 * k + 1.7 * static_cast<double>(i));
      const Vector x = mount.x, f = mount.derivatives();
      const auto energyAt = [&](double time) {
        mount.x = x + time * f;
        return mount.output("fuselage_energy")[0];
      };
      const double step = 1e-4;  // five-point differences: truncation (rate * step)^4 ~ 1e-13, round-off 1e-16 E / step ~ 1e-9
      const double power = (8.0 * (energyAt(step) - energyAt(-step)) - (energyAt(2.0 * step) - energyAt(-2.0 * step))) / (12.0 * step);
      mount.x = x;
      const Matrix3d R_OB = quaternionOf(x.segment<4>(kOrientation).normalized()).toRotationMatrix();
      const Matrix3d R_OU = (turn(M_PI * 40.0 / 180.0, Vector3d::UnitZ()) * turn(M_PI / 18.0, Vector3d::UnitX())).toRotationMatrix();
      const Vector3d rates = x.segment<3>(kRates), at_gear = R_OU.transpose() * R_OB * (Vector3d(x.segment<3>(kVelocity)) + rates.cross(Vector3d(0.2, 0.1, -0.5)));
      const double dissipation = Vector3d(3.0, 2.0, 4.0).dot(at_gear.cwiseAbs2()) + Vector3d(5.0, 7.0, 6.0).dot(rates.cwiseAbs2());
      EXPECT_NEAR(power, -dissipation, 1e-7) << k;
    }
  }
}

TEST(LandingGear, momentaChangeByTheSpringWrenchWeightAndLoads) {
  for (const char* mode : {"spring6", "spring2", "free"}) {
    const bool planar = mode == std::string("spring2");
    BareMount tested(std::string(kTumblingOnSprings).replace(6, 7, mode) + ", damping: [30.0, 20.0], stiffness: [300, 200], hub_offset: [0.1, 0.2, 0.9], shaft_tilt_forward_deg: 9.0");
    for (Index i = 0; i < tested.x.size(); ++i) tested.x[i] += 0.4 * std::sin(1.0 + 1.7 * static_cast<double>(i));
    for (Index i = 0; i < 6; ++i) tested.u[i] = 30.0 * std::cos(2.0 * static_cast<double>(i));
    const Vector x = tested.x, f = tested.derivatives();
    const auto slope = [&](const std::string& port) {
      const auto at = [&](double time) {
        tested.x = x + time * f;
        return tested.output(port);
      };
      const double step = 1e-4;
      const Vector result = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
      tested.x = x;
      return result;
    };
    // What arrives at the hub, by the outputs in true axes, moved to the origin of odom.
    const Quaterniond hub = quaternionOf(tested.output("hub_orientation"));
    const Vector3d force = hub * Vector3d(tested.output("hub_force")), hub_position = tested.output("hub_position"), position = tested.output("fuselage_position");
    const Vector3d moment = hub * Vector3d(tested.output("hub_moment")) + hub_position.cross(force), weight(0.0, 0.0, planar ? 0.0 : -98.0665);
    const Vector wrench = mode == std::string("free") ? Vector(Vector::Zero(6)) : tested.output("spring_wrench");
    const Vector3d linear = force + weight + Vector3d(wrench.head<3>()), angular = moment + position.cross(weight) + Vector3d(wrench.tail<3>());
    const Vector3d linear_slope = slope("fuselage_momentum"), angular_slope = slope("fuselage_angular_momentum");
    if (planar) {  // the guide takes the rest
      EXPECT_LE((linear_slope - linear).head<2>().norm(), 1e-8);
      continue;
    }
    EXPECT_LE((linear_slope - linear).norm(), 1e-7) << mode;
    EXPECT_LE((angular_slope - angular).norm(), 1e-7) << mode;
  }
}

}  // namespace
}  // namespace heerk_rotor
