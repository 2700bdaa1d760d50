#include "heerk_rotor/tools/run_length.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "heerk_rotor/config/problems.hpp"

namespace heerk_rotor {
namespace {

SimulationSettings settingsWith(double speed, double duration) {
  SimulationSettings settings;
  settings.rotor_speed = speed;
  settings.duration = duration;
  return settings;
}

TEST(RunLength, isTheDurationOfTheConfigurationUnlessTheCommandLineSaysMore) {
  SimulateOptions options;
  const SimulationSettings settings = settingsWith(40.0, 2.0);
  EXPECT_EQ(runLength(options, settings, 1e-3).steps, 2000u);
  options.duration = 0.5;
  EXPECT_EQ(runLength(options, settings, 1e-3).steps, 500u);
  options.duration = 0.0;
  EXPECT_EQ(runLength(options, settings, 1e-3).steps, 0u);
}

TEST(RunLength, countsRevolutionsAtTheNominalSpeed) {
  SimulateOptions options;
  options.revolutions = 2.5;
  const SimulationSettings settings = settingsWith(41.0, 10.0);
  const double one_degree = std::acos(-1.0) / 180.0 / 41.0;
  EXPECT_EQ(runLength(options, settings, one_degree).steps, 900u);
  EXPECT_EQ(runLength(options, settings, one_degree).warning, "");
}

TEST(RunLength, roundOffOfTheQuotientIsNoReasonToWarn) {
  SimulateOptions options;
  options.duration = 1e5;
  const RunLength length = runLength(options, settingsWith(1.0, 1.0), 1e-4);  // 1e5 / 1e-4 = 999999999.99999988
  EXPECT_EQ(length.steps, 1000000000u);
  EXPECT_EQ(length.warning, "");
}

TEST(RunLength, warnsWhenTheDurationIsNoMultipleOfTheStep) {
  SimulateOptions options;
  options.duration = 1.0;
  const RunLength length = runLength(options, settingsWith(1.0, 1.0), 0.3);
  EXPECT_EQ(length.steps, 3u);
  EXPECT_NE(length.warning.find("running 3 steps, 0.9 s"), std::string::npos) << length.warning;
}

TEST(RunLength, refusesMoreStepsThanCanBeCounted) {
  SimulateOptions options;
  options.duration = 1e300;
  EXPECT_THROW(runLength(options, settingsWith(1.0, 1.0), 1e-3), ConfigurationError);
  options.duration = 1e308;  // the quotient overflows
  EXPECT_THROW(runLength(options, settingsWith(1.0, 1.0), 1e-3), ConfigurationError);
}

}  // namespace
}  // namespace heerk_rotor
