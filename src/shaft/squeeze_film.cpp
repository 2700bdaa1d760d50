#include "heerk_rotor/shaft/squeeze_film.hpp"

#include <cmath>

namespace heerk_rotor {

constexpr double kPi = 3.14159265358979323846;

SqueezeFilm::SqueezeFilm(const Parameters& p)
    : k_(p.viscosity * p.radius * std::pow(p.length / p.clearance, 3)), full_(p.full) {}

SqueezeFilm::Force SqueezeFilm::force(double rho_x, double rho_y, double v_x, double v_y) const noexcept {
  const double speed = std::sqrt(v_x * v_x + v_y * v_y);
  if (speed == 0.0) return {0.0, 0.0};
  const double e2 = rho_x * rho_x + rho_y * rho_y;
  if (e2 > kLargestEccentricity * kLargestEccentricity) {
    const double shrink = kLargestEccentricity / std::sqrt(e2);
    rho_x *= shrink;
    rho_y *= shrink;
  }
  const double u_x = v_x / speed, u_y = v_y / speed;
  const double a = rho_x * u_x + rho_y * u_y, b = rho_y * u_x - rho_x * u_y;
  const double D = 1.0 - a * a - b * b, root = std::sqrt(D), inverse = 1.0 / (D * D);

  // Shares of S / D^(5/2), then what the half film has besides.
  const double S = (full_ ? kPi : std::atan2(root, -a)) * inverse / root;
  double along = S * (1.0 - b * b + 2.0 * a * a), across = S * 3.0 * a * b;
  if (!full_) {
    along += 3.0 * a * inverse;
    across += b * (2.0 + a * a / (1.0 - b * b)) * inverse;
  }
  const double size = -k_ * speed;
  return {size * (along * u_x - across * u_y), size * (along * u_y + across * u_x)};
}

}  // namespace heerk_rotor
