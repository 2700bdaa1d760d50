#include "heerk_rotor/config/simulation_settings.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

struct Reading {
  SimulationSettings settings;
  std::string problems;
};

Reading read(const std::string& simulation, const std::vector<std::string>& overrides = {}) {
  const Configuration configuration = Configuration::parse("simulation: " + simulation + "\n", "t.yaml", overrides);
  Problems problems;
  const SimulationSettings settings = readSimulationSettings(configuration, problems);
  return {settings, problems.text()};
}

TEST(SimulationSettings, haveTheDocumentedDefaults) {
  const Reading r = read("{rotor_speed: 44.4}");
  EXPECT_EQ(r.problems, "");
  EXPECT_EQ(r.settings.integrator, "HEERK4");
  EXPECT_EQ(r.settings.formulation, "absolute_lag");
  EXPECT_FALSE(r.settings.paper_tolerance);
  EXPECT_EQ(r.settings.newton_tolerance, 1e-10);
  EXPECT_EQ(r.settings.duration, 10.0);
  // One degree of azimuth; 4 roundings of 1.1e-16 each at most.
  EXPECT_NEAR(r.settings.step, M_PI / 180.0 / 44.4, 5e-16 * r.settings.step);
}

TEST(SimulationSettings, readEveryKey) {
  const Reading r = read("{integrator: HERK4, step: 1.0e-3, rotor_speed: 6.63, formulation: printed, newton_tolerance: 1e-12, duration: 2.5}");
  EXPECT_EQ(r.problems, "");
  EXPECT_EQ(r.settings.integrator, "HERK4");
  EXPECT_EQ(r.settings.step, 1e-3);
  EXPECT_EQ(r.settings.rotor_speed, 6.63);
  EXPECT_EQ(r.settings.formulation, "printed");
  EXPECT_EQ(r.settings.newton_tolerance, 1e-12);
  EXPECT_EQ(r.settings.duration, 2.5);
  EXPECT_DOUBLE_EQ(r.settings.revolution(), 2.0 * M_PI / 6.63);
}

TEST(SimulationSettings, turnDegreesOfAzimuthIntoSeconds) {
  const Reading r = read("{azimuth_step_deg: 360, rotor_speed: 3}");
  EXPECT_EQ(r.problems, "");
  EXPECT_DOUBLE_EQ(r.settings.step, r.settings.revolution());
}

TEST(SimulationSettings, takeTheSpeedInRevolutionsPerMinuteInstead) {
  const Reading r = read("{rotor_speed_rpm: 60}");
  EXPECT_EQ(r.problems, "");
  EXPECT_DOUBLE_EQ(r.settings.rotor_speed, 2.0 * M_PI);
}

TEST(SimulationSettings, knowThePapersToleranceRule) {
  EXPECT_TRUE(read("{rotor_speed: 1, newton_tolerance: paper}").settings.paper_tolerance);
  EXPECT_TRUE(read("{rotor_speed: 1, newton_tolerance: \"paper\"}").settings.paper_tolerance);
  EXPECT_FALSE(read("{rotor_speed: 1, newton_tolerance: 0.1}").settings.paper_tolerance);
}

TEST(SimulationSettings, letTheCommandLineReplaceTheStep) {
  const Reading r = read("{azimuth_step_deg: 2, rotor_speed: 1}", {"simulation.step=1e-4"});
  EXPECT_EQ(r.problems, "");
  EXPECT_EQ(r.settings.step, 1e-4);
}

struct BadSettings {
  const char* simulation;
  const char* problem;
};

class BadSettingsTest : public testing::TestWithParam<BadSettings> {};

TEST_P(BadSettingsTest, isTheOnlyProblemReported) { EXPECT_EQ(read(GetParam().simulation).problems, GetParam().problem); }

INSTANTIATE_TEST_SUITE_P(
    SimulationSettings, BadSettingsTest,
    testing::Values(
        BadSettings{"{}", "t.yaml:1: simulation.rotor_speed = (missing): expected a number > 0 [rad/s]"},
        BadSettings{"{rotor_speed: 0}", "t.yaml:1: simulation.rotor_speed = 0: expected a number > 0 [rad/s]"},
        BadSettings{"{rotor_speed_rpm: -4}", "t.yaml:1: simulation.rotor_speed_rpm = -4: expected a number > 0 [rpm]"},
        BadSettings{"{rotor_speed: 1, rotor_speed_rpm: 9}",
                    "t.yaml:1: simulation.rotor_speed = 1: expected either rotor_speed [rad/s] or rotor_speed_rpm, not both"},
        BadSettings{"{rotor_speed: 1e-320}", "t.yaml:1: simulation.rotor_speed = 1e-320: expected a speed at which the step is a positive, finite time"},
        BadSettings{"{rotor_speed: 1, step: 0}", "t.yaml:1: simulation.step = 0: expected a number > 0 [s]"},
        BadSettings{"{rotor_speed: 1, azimuth_step_deg: 361}", "t.yaml:1: simulation.azimuth_step_deg = 361: expected a number in (0, 360] [deg]"},
        BadSettings{"{rotor_speed: 1, formulation: printd}",
                    "t.yaml:1: simulation.formulation = printd: expected one of absolute_lag, printed (did you mean 'printed'?)"},
        BadSettings{"{rotor_speed: 1, newton_tolerance: 0.2}",
                    "t.yaml:1: simulation.newton_tolerance = 0.2: expected a number in (0, 0.1] [relative error of a loop], or the word paper"},
        BadSettings{"{rotor_speed: 1, newton_tolerance: papr}",
                    "t.yaml:1: simulation.newton_tolerance = papr: expected a number in (0, 0.1] [relative error of a loop], or the word paper"},
        BadSettings{"{rotor_speed: 1, newton_tolerance: [1e-3]}",
                    "t.yaml:1: simulation.newton_tolerance = [1e-3]: expected a number in (0, 0.1] [relative error of a loop], or the word paper"},
        BadSettings{"{rotor_speed: 1, duration: .inf}", "t.yaml:1: simulation.duration = .inf: expected a number > 0 [s]"},
        BadSettings{"{rotor_speed: 1, integrater: HERK4}", "t.yaml:1: simulation.integrater = HERK4: expected a known key (did you mean 'integrator'?)"}));

TEST(SimulationSettings, reportEverythingThatIsWrongAtOnce) {
  const Reading r = read("{rotor_speed: -1, duration: x, nonsense: 3}");
  EXPECT_NE(r.problems.find("rotor_speed = -1"), std::string::npos);
  EXPECT_NE(r.problems.find("duration = x"), std::string::npos);
  EXPECT_NE(r.problems.find("nonsense = 3"), std::string::npos);
}

TEST(SimulationSettings, missTheSpeedWhenTheSectionIsAbsent) {
  const Configuration configuration = Configuration::parse("\n\nsubsystems: {}\n", "t.yaml");
  Problems problems;
  readSimulationSettings(configuration, problems);
  EXPECT_EQ(problems.text(), "t.yaml:3: simulation.rotor_speed = (missing): expected a number > 0 [rad/s]");
}

}  // namespace
}  // namespace heerk_rotor
