#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "heerk_rotor/analysis/monodromy.hpp"

namespace heerk_rotor {

/// Eigenvalues of a discrete map.
struct Stability {
  double period = 0.0;                // of the map [s]
  double spectral_radius = 0.0;
  std::vector<Multiplier> modes;      // by falling modulus

  /// Above 1 by more than what differences hide.
  bool unstable() const { return spectral_radius > 1.0 + 1e-9; }
};

/// The map of one step at model time 0, linearised at (x, w) by central differences of `scales` (stateScales): what the integrator
/// itself makes of the system with the coefficients of this azimuth. Where coefficients are periodic it is no verdict on the
/// motion; that is the revolution's (Floquet) multipliers. Throws std::runtime_error when a perturbed step fails.
Stability stepStability(const std::function<std::unique_ptr<Simulation>()>& build, const Vector& x, const Vector& w, const Vector& scales, unsigned threads = 0);

/// The map of one revolution [s] from (x, w), linearised likewise: Floquet multipliers where the motion is periodic, rest included;
/// from a start with a transient they tell what becomes of neighbouring motions over this revolution. Throws
/// std::invalid_argument when the step does not divide the revolution.
Stability revolutionStability(const std::function<std::unique_ptr<Simulation>()>& build, double revolution, const Vector& x, const Vector& w, const Vector& scales,
                              unsigned threads = 0);

/// Floquet multipliers from a monodromy matrix in any scales.
Stability floquetStability(const Matrix& monodromy, double period, const std::vector<std::string>& state_names);

}  // namespace heerk_rotor
