#include "heerk_rotor/models/speed_ramp.hpp"

#include <cmath>

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

Vector driveAt(SpeedRamp& ramp, double t) {
  Vector y = Vector::Zero(3), none;
  ramp.evalOutput(0, t, in(none), in(none), view(y));
  return y;
}

TEST(SpeedRamp, angleRateAndAccelerationBelongTogether) {
  // Up and down, from and to speeds that are not nominal.
  for (const auto& [from, to] : {std::pair<double, double>{100.0, 700.0}, {700.0, 100.0}, {0.0, 400.0}}) {
    SpeedRamp ramp({400.0, from, to, 300.0, 0.25});
    const double end = 0.25 + std::abs(to - from) / 300.0, d = 1e-3;
    for (double t = 0.01; t < end + 1.0; t += 0.0137) {
      if (std::abs(t - 0.25) < 2.0 * d || std::abs(t - end) < 2.0 * d) continue;  // the acceleration jumps there
      const Vector y = driveAt(ramp, t), up = driveAt(ramp, t + d), down = driveAt(ramp, t - d);
      // Quadratic in t: central differences are exact but for round-off, 1e-16 of some 400 rad over 2 d.
      EXPECT_NEAR(y[1], (up[0] - down[0]) / (2.0 * d), 1e-9) << t;
      EXPECT_NEAR(y[2], (up[1] - down[1]) / (2.0 * d), 1e-9) << t;
    }
    EXPECT_EQ(driveAt(ramp, 0.0)[0], 0.0);
    EXPECT_EQ(driveAt(ramp, 0.1)[1], from - 400.0);
    EXPECT_EQ(driveAt(ramp, end + 1.0)[1], to - 400.0);
    EXPECT_EQ(driveAt(ramp, end + 1.0)[2], 0.0);
    EXPECT_EQ(driveAt(ramp, 0.3)[2], std::copysign(300.0, to - from));
    // Angle turned: mean speed on the ramp.
    EXPECT_NEAR(400.0 * (end + 1.0) + driveAt(ramp, end + 1.0)[0], from * 0.25 + 0.5 * (from + to) * (end - 0.25) + to, 1e-10);
  }
}

TEST(SpeedRamp, isContinuousAtBothEnds) {
  SpeedRamp ramp({400.0, 100.0, 700.0, 300.0, 0.25});
  for (const double t : {0.25, 2.25}) {
    const Vector before = driveAt(ramp, t - 1e-9), after = driveAt(ramp, t + 1e-9);
    EXPECT_NEAR(before[0], after[0], 1e-6);
    EXPECT_NEAR(before[1], after[1], 1e-6);
  }
}

TEST(SpeedRamp, constantNominalSpeedIsExactlyNoDeviation) {
  for (const Overrides& given : {Overrides{}, Overrides{"subsystems.drive.initial_speed_rpm=5000", "subsystems.drive.final_speed_rpm=5000"}}) {
    auto simulation = buildSimulation(shipped("dual_disc.yaml", given));
    ASSERT_TRUE(advance(*simulation, 1234));
    const Vector y = look(*simulation, {"drive.drive_angle", "drive.drive_rate", "drive.drive_acceleration"});
    EXPECT_EQ(y, Vector::Zero(3));
  }
}

TEST(SpeedRamp, rampWithoutAccelerationIsRefused) {
  try {
    buildSimulation(shipped("dual_disc.yaml", {"subsystems.drive.initial_speed_rpm=1000"}));
    FAIL() << "built";
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("subsystems.drive.acceleration_rpm_per_s"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace heerk_rotor
