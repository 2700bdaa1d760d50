#include "heerk_rotor/models/drive.hpp"

#include <cmath>

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

/// The controlled rotor with everything but the drive left alone; the rigid mast passes the drive's motion on unchanged.
std::unique_ptr<Simulation> rigidlyDriven(const Overrides& more = {}) {
  return buildSimulation(shipped("lag_rotor_controlled.yaml", Overrides{"subsystems.mast={type: rigid_mast}", "simulation.step=1.0e-3"} + more));
}

Vector speedCommand(const Simulation& simulation, double speed) {
  Vector w = simulation.system().defaultCommand();
  for (std::size_t i = 0; i < simulation.system().commandNames().size(); ++i)
    if (simulation.system().commandNames()[i] == "drive.speed") w[static_cast<Index>(i)] = speed;
  return w;
}

TEST(Drive, smallSpeedStepFollowsTheCriticallyDampedResponse) {
  auto simulation = rigidlyDriven();
  const double step = 0.01, wn = 2.0;
  const Vector w = speedCommand(*simulation, 41.0 + step);
  for (int k = 1; k <= 20; ++k) {
    ASSERT_TRUE(advance(*simulation, 100, w));
    const double t = 0.1 * k;
    // 1 - e^{-wn t}(1 + wn t) for zeta = 1. The smooth limit departs by (a / a_max)^2 / 3 = 5e-6 of the acceleration
    // wn^2 step t e^.. < 0.0074 rad/s^2.
    EXPECT_NEAR(look(*simulation, {"mast.rotor_speed"}, w)[0] - 41.0, step * (1.0 - std::exp(-wn * t) * (1.0 + wn * t)), 1e-5 * step) << t;
  }
}

TEST(Drive, largeSpeedStepIsLimitedInAccelerationAndArrives) {
  auto simulation = rigidlyDriven();
  const Vector w = speedCommand(*simulation, 30.0);
  Recorder record(*simulation, {"mast.rotor_speed", "drive.drive_acceleration", "mast.azimuth", "drive.drive_angle"});
  ASSERT_TRUE(advance(*simulation, 20000, w));
  double fastest = 0.0;
  for (const Vector& row : record.rows) fastest = std::max(fastest, std::abs(row[1]));
  EXPECT_LE(fastest, 2.0);
  EXPECT_GE(fastest, 1.99);
  EXPECT_NEAR(record.rows.back()[0], 30.0, 1e-6);  // e^{-2 t} after some 14 s without limit
  // Azimuth is the integral of the speed: Simpson over the record.
  double turned = 0.0;
  for (std::size_t k = 0; k + 2 < record.rows.size(); k += 2) turned += 1e-3 / 3.0 * (record.rows[k][0] + 4.0 * record.rows[k + 1][0] + record.rows[k + 2][0]);
  const std::size_t last = (record.rows.size() - 1) / 2 * 2;
  EXPECT_NEAR(record.rows[last][2] - record.rows[0][2], turned, 1e-7);
  EXPECT_NEAR(record.rows[last][2], 41.0 * record.t[last] + record.rows[last][3], 1e-9);
}

TEST(Drive, speedCommandsBeyondTheRangeAreTakenAsItsEnds) {
  for (const auto& [command, expected] : {std::pair<double, double>{100.0, 49.2}, {-5.0, 20.5}}) {
    auto simulation = rigidlyDriven({"subsystems.drive.max_acceleration=20.0"});
    const Vector w = speedCommand(*simulation, command);
    ASSERT_TRUE(advance(*simulation, 20000, w));
    EXPECT_NEAR(look(*simulation, {"mast.rotor_speed"}, w)[0], expected, 1e-6);
  }
}

TEST(Drive, elasticMastFollowsTheDrive) {
  auto simulation = buildSimulation(shipped("lag_rotor_controlled.yaml"));
  const Vector w = speedCommand(*simulation, 39.0);
  ASSERT_TRUE(advance(*simulation, std::lround(12.0 / simulation->stepSize()), w));
  const Vector y = look(*simulation, {"mast.rotor_speed", "mast.twist_rate"}, w);
  EXPECT_NEAR(y[0] - y[1], 39.0, 1e-6);  // hub speed = drive speed + twist rate
  EXPECT_NEAR(y[0], 39.0, 1e-3);         // and the mast mode, which nothing but the airloads damps, is small
}

TEST(Drive, withoutCommandKeepsTheNominalSpeedExactly) {
  auto simulation = rigidlyDriven();
  ASSERT_TRUE(advance(*simulation, 1000));
  EXPECT_EQ(look(*simulation, {"mast.rotor_speed"})[0], 41.0);
}

}  // namespace
}  // namespace heerk_rotor
