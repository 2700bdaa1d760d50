#include "heerk_rotor/analysis/limit_watch.hpp"

#include <gtest/gtest.h>

#include "../models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

std::vector<std::string> warningsAfter(const std::string& file, const Overrides& overrides, long steps) {
  auto simulation = buildSimulation(shipped(file, overrides));
  const LimitWatch watch(*simulation, 0.012);
  EXPECT_TRUE(advance(*simulation, steps)) << simulation->failure().cause;
  return watch.warnings();
}

TEST(LimitWatch, silentWhileTheJournalStaysInItsFilm) {
  EXPECT_TRUE(warningsAfter("dual_disc.yaml", {}, 2000).empty());
  EXPECT_TRUE(warningsAfter("lag_rotor.yaml", {}, 100).empty());  // nothing to watch
}

TEST(LimitWatch, tellsHowOftenAndHowFarTheJournalLeftTheFilm) {
  // A film of nearly no viscosity cannot hold an unbalance ten times as large. Beyond its limit it is too stiff for the shipped step.
  const std::vector<std::string> found =
      warningsAfter("dual_disc.yaml", {"subsystems.film.viscosity=2e-7", "subsystems.shaft.discs.unbalance=[2.6e-3, 2.23e-3]", "simulation.step=5e-6"}, 8000);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("film.film_clamped: the model's limit was reached at "), std::string::npos) << found[0];
  EXPECT_NE(found[0].find("of 1143 watched instants"), std::string::npos) << found[0];  // every seventh step: a degree is 33 us
  EXPECT_NE(found[0].find("largest eccentricity ratio "), std::string::npos) << found[0];
}

}  // namespace
}  // namespace heerk_rotor
