#include "heerk_rotor/models/squeeze_film_damper.hpp"

#include <cmath>

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

SqueezeFilmDamper::Parameters parameters() { return {{1.6e-4, 0.011, 0.0675, 0.02, false}, 0.1, -0.2}; }

Vector evaluate(SqueezeFilmDamper& damper, Index port, const Vector& motion) {
  Vector y = Vector::Zero(damper.outputs()[static_cast<std::size_t>(port)].size), none;
  damper.evalOutput(port, 0.0, in(none), in(motion), view(y));
  return y;
}

TEST(SqueezeFilmDamper, countsTheEccentricityFromTheHousingCentre) {
  SqueezeFilmDamper damper(parameters());
  const SqueezeFilm film(parameters().film);
  Vector motion(4);
  motion << 3.2e-5, 6.4e-5, 0.02, -0.01;  // 0.2 and 0.4 of the clearance
  EXPECT_NEAR(evaluate(damper, 1, motion)[0], std::hypot(0.3, 0.2), 1e-15);
  const SqueezeFilm::Force expected = film.force(0.3, 0.2, 0.02, -0.01);
  EXPECT_NEAR(evaluate(damper, 0, motion)[0], expected.x, 1e-12 * std::abs(expected.x));
  EXPECT_NEAR(evaluate(damper, 0, motion)[1], expected.y, 1e-12 * std::abs(expected.y));
  EXPECT_EQ(evaluate(damper, 2, motion)[0], 0.0);
}

TEST(SqueezeFilmDamper, overlargeEccentricityIsLimitedAndReported) {
  SqueezeFilmDamper damper(parameters());
  Vector motion(4);
  motion << 1.0e-3, 0.0, 0.02, -0.01;
  EXPECT_EQ(evaluate(damper, 2, motion)[0], 1.0);
  EXPECT_GT(evaluate(damper, 1, motion)[0], 6.0);  // as it is, not limited
  EXPECT_TRUE(evaluate(damper, 0, motion).allFinite());

  // A hundred times the unbalance and hardly any oil (which otherwise stops the journal however near): the complete rotor touches, and says so.
  auto simulation = buildSimulation(shipped("dual_disc.yaml", {"subsystems.shaft.discs.unbalance=[2.6e-2, 2.23e-2]", "subsystems.film.viscosity=1.0e-8"}));
  Recorder record(*simulation, {"film.eccentricity_ratio", "film.film_clamped"});
  ASSERT_TRUE(advance(*simulation, 5000));
  long clamped = 0;
  for (const Vector& row : record.rows) {
    EXPECT_EQ(row[1] == 1.0, row[0] > 0.999);
    clamped += row[1] == 1.0;
  }
  EXPECT_GT(clamped, 0);
}

TEST(SqueezeFilmDamper, eccentricStaticPositionOutsideTheClearanceIsRefused) {
  EXPECT_THROW(buildSimulation(shipped("dual_disc.yaml", {"subsystems.film.static_eccentricity_x=0.8", "subsystems.film.static_eccentricity_y=0.8"})), ConfigurationError);
}

}  // namespace
}  // namespace heerk_rotor
