#include "heerk_rotor/models/squeeze_film_damper.hpp"

#include <cmath>

#include "model_factories.hpp"

namespace heerk_rotor {
namespace {
enum Port_ { kForce, kEccentricity, kClamped };
}

std::vector<InputPort> SqueezeFilmDamper::inputs() const {
  return {{"journal_motion", 4, "m, m/s", "journal from its static position along x and y, and its velocity"}};
}

std::vector<OutputPort> SqueezeFilmDamper::outputs() const {
  return {{"film_force", 2, "N", "force of the film on the journal along x and y", {"journal_motion"}, 100.0, {"film_force_x", "film_force_y"}, true},
          {"eccentricity_ratio", 1, "-", "distance of the journal from the housing centre over the clearance", {"journal_motion"}, 1.0, {}, true},
          {"film_clamped", 1, "-", "1 while the eccentricity ratio exceeds 0.999, to which the force is limited", {"journal_motion"}, 1.0}};
}

void SqueezeFilmDamper::evalOutput(Index port, double, const In&, const In& u, Out y) noexcept {
  const double rho_x = p_.static_eccentricity_x + per_clearance_ * u[0];
  const double rho_y = p_.static_eccentricity_y + per_clearance_ * u[1];
  if (port == kForce) {
    const SqueezeFilm::Force force = film_.force(rho_x, rho_y, u[2], u[3]);
    y[0] = force.x;
    y[1] = force.y;
    return;
  }
  const double ratio = std::hypot(rho_x, rho_y);
  y[0] = port == kEccentricity ? ratio : ratio > SqueezeFilm::kLargestEccentricity ? 1.0 : 0.0;
}

Made makeSqueezeFilmDamper(Section& section, const BuildContext&) {
  SqueezeFilmDamper::Parameters p;
  p.film.clearance = section.requiredNumber("clearance", "m", positive());
  p.film.length = section.requiredNumber("length", "m", positive());
  p.film.radius = section.requiredNumber("radius", "m", positive());
  p.film.viscosity = section.requiredNumber("viscosity", "Pa s", nonNegative());
  p.film.full = section.word("film", "half", {"half", "full"}) == "full";
  p.static_eccentricity_x = section.number("static_eccentricity_x", p.static_eccentricity_x, "parts of the clearance", {-0.99, 0.99, false});
  p.static_eccentricity_y = section.number("static_eccentricity_y", p.static_eccentricity_y, "parts of the clearance", {-0.99, 0.99, false});
  if (std::hypot(p.static_eccentricity_x, p.static_eccentricity_y) >= SqueezeFilm::kLargestEccentricity)
    section.problem("static_eccentricity_y", "with static_eccentricity_x less than 0.999 from the housing centre");
  section.finish();
  return std::make_unique<SqueezeFilmDamper>(p);
}

}  // namespace heerk_rotor
