#include "heerk_rotor/beam/gauss_rule.hpp"

#include <cmath>

namespace heerk_rotor {

GaussRule::GaussRule(int points) : node(points), weight(points) {
  const BeamReal pi = std::acos(BeamReal(-1));
  for (int i = 0; i < points; ++i) {
    // Newton on the Legendre polynomial from the usual cosine guess; quadratic, so 100 sweeps are only a guard.
    BeamReal z = -std::cos(pi * (i + BeamReal(0.75)) / (points + BeamReal(0.5)));
    BeamReal slope = 0;
    for (int sweep = 0; sweep < 100; ++sweep) {
      BeamReal p = 1, before = 0;
      for (int k = 1; k <= points; ++k) {
        const BeamReal next = ((2 * k - 1) * z * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = points * (z * p - before) / (z * z - 1);
      const BeamReal step = p / slope;
      z -= step;
      if (std::abs(step) < BeamReal(1e-18)) break;
    }
    node[i] = (1 + z) / 2;
    weight[i] = 1 / ((1 - z * z) * slope * slope);
  }
}

}  // namespace heerk_rotor
