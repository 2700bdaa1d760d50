#include "heerk_rotor/models/blade_azimuths.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "heerk_rotor/core/branch_free_math.hpp"

namespace heerk_rotor {
namespace {

constexpr double kTwoPi = 6.283185307179586476925;

/// cos(2 pi part / whole), by symmetry from the first eighth of the circle.
double cosineOfTurn(int part, int whole) {
  part = std::abs(part) % whole;
  if (2 * part > whole) part = whole - part;
  if (4 * part > whole) return -cosineOfTurn(whole - 2 * part, 2 * whole);
  if (4 * part == whole) return 0.0;
  if (6 * part == whole) return 0.5;
  return 8 * part <= whole ? std::cos(kTwoPi * part / whole) : std::sin(kTwoPi * (whole - 4 * part) / (4 * whole));
}

}  // namespace

BladeAzimuths::BladeAzimuths(int blades) : blades_(blades) {
  if (blades < 1 || blades > kMaxBlades) throw std::invalid_argument("blades: expected 1 to " + std::to_string(kMaxBlades) + ", got " + std::to_string(blades));
  for (int k = 0; k < blades; ++k) {
    cosine_[static_cast<std::size_t>(k)] = cosineOfTurn(k, blades);
    sine_[static_cast<std::size_t>(k)] = cosineOfTurn(4 * k - blades, 4 * blades);  // sin a = cos(a - a quarter turn)
  }
}

void BladeAzimuths::evaluate(double psi, double* cosine, double* sine) const noexcept {
  const auto [s, c] = sineCosine(psi);
  for (std::size_t k = 0; k < static_cast<std::size_t>(blades_); ++k) {
    cosine[k] = c * cosine_[k] - s * sine_[k];
    sine[k] = s * cosine_[k] + c * sine_[k];
  }
}

}  // namespace heerk_rotor
