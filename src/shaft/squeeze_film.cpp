#include "heerk_rotor/shaft/squeeze_film.hpp"

#include <cmath>

#include "heerk_rotor/core/branch_free_math.hpp"

namespace heerk_rotor {

constexpr double kPi = 3.14159265358979323846;

SqueezeFilm::SqueezeFilm(const Parameters& p)
    : k_(p.viscosity * p.radius * std::pow(p.length / p.clearance, 3)), full_(p.full) {}

SqueezeFilm::Force SqueezeFilm::force(double rho_x, double rho_y, double v_x, double v_y) const noexcept {
  const double speed = std::sqrt(v_x * v_x + v_y * v_y);
  if (speed == 0.0) return {0.0, 0.0};
  double e2 = rho_x * rho_x + rho_y * rho_y;
  if (e2 > kLargestEccentricity * kLargestEccentricity) {
    const double shrink = kLargestEccentricity / std::sqrt(e2);
    rho_x *= shrink;
    rho_y *= shrink;
    e2 = kLargestEccentricity * kLargestEccentricity;
  }
  // Along and across the velocity a^2 + b^2 = e^2, so that what depends on e alone need not wait for the direction; S needs no direction of unit length.
  const double D = 1.0 - e2, root = std::sqrt(D), over_speed = 1.0 / speed;
  const double u_x = v_x * over_speed, u_y = v_y * over_speed;
  const double a = rho_x * u_x + rho_y * u_y, b = rho_y * u_x - rho_x * u_y, one_less_b2 = D + a * a;

  // Shares of S / D^(5/2), then what the half film has besides.
  const double S = (full_ ? kPi : arcTangent2(root * speed, -(rho_x * v_x + rho_y * v_y))) / root;
  double along = S * (one_less_b2 + 2.0 * a * a), across = S * 3.0 * a * b;
  if (!full_) {
    along += 3.0 * a;
    across += b * (2.0 + a * a / one_less_b2);
  }
  const double size = -k_ * speed / (D * D);
  return {size * (along * u_x - across * u_y), size * (along * u_y + across * u_x)};
}

}  // namespace heerk_rotor
