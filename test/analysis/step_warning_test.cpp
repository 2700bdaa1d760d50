#include "heerk_rotor/analysis/step_warning.hpp"

#include <gtest/gtest.h>

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kRevolution = 0.012;  // 5000 rpm [s]
const std::string kNoFilmInS = "subsystems.shaft.linearised_film_damping=0";

std::string warningOf(const std::string& file, const Overrides& overrides, std::uint64_t steps = 1000000, double revolution = kRevolution) {
  const Configuration configuration = shipped(file, overrides);
  const auto simulation = buildSimulation(configuration);
  return stepWarning(configuration, *simulation, simulation->system().defaultCommand(), revolution, steps);
}

Overrides with(const std::string& method, double step) { return {"simulation.integrator=" + method, set("simulation.step", step)}; }

TEST(StepWarning, silentWhereTheMethodIsRight) {
  EXPECT_EQ(warningOf("dual_disc.yaml", {}), "");
  EXPECT_EQ(warningOf("dual_disc.yaml", with("HEERK4", 1e-4)), "");
  EXPECT_EQ(warningOf("dual_disc.yaml", with("HEERK3", 9e-6)), "");
  EXPECT_EQ(warningOf("dual_disc.yaml", with("precise_2", 5e-6)), "");
  EXPECT_EQ(warningOf("dual_disc.yaml", with("precise_2", 8e-6) + Overrides{kNoFilmInS}), "");
  EXPECT_EQ(warningOf("dual_disc.yaml", with("Newmark", 1e-4)), "");  // A-stable
  EXPECT_EQ(warningOf("ground_resonance.yaml", {}, 1000000, 0.15), "");  // grows, but as the rotor does
}

TEST(StepWarning, namesTheWindowOfHeerk3AndThatDampingInSClosesIt) {
  const Overrides window = with("HEERK3", 1e-5) + Overrides{kNoFilmInS};
  const std::string warning = warningOf("dual_disc.yaml", window);
  EXPECT_NE(warning.find("HEERK3 is unstable with a step of 1e-05 s"), std::string::npos) << warning;
  EXPECT_NE(warning.find("up to 1.0012"), std::string::npos) << warning;  // the number that shows it
  EXPECT_NE(warning.find("shaft.mode_"), std::string::npos) << warning;
  EXPECT_EQ(warningOf("dual_disc.yaml", with("HEERK3", 1e-5)), "");
  EXPECT_EQ(warningOf("dual_disc.yaml", window, 1000), "") << "a check must not cost more than a short run";
}

TEST(StepWarning, namesTheLimitOfThePrecisePredictorAndOfAClassicalMethod) {
  EXPECT_NE(warningOf("dual_disc.yaml", with("precise_2", 8e-6)).find("precise_2 is unstable"), std::string::npos);
  EXPECT_NE(warningOf("dual_disc.yaml", with("precise_2", 1e-5) + Overrides{kNoFilmInS}).find("precise_2 is unstable"), std::string::npos);
  EXPECT_NE(warningOf("lag_rotor.yaml", {"simulation.integrator=HERK4", "subsystems.mast.stiffness=3e8"}).find("mast.twist"), std::string::npos);
}

}  // namespace
}  // namespace heerk_rotor
