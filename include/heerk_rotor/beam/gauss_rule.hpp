#pragma once
#include <vector>

#include "heerk_rotor/beam/beam_types.hpp"

namespace heerk_rotor {

/// Nodes and weights of Gauss-Legendre quadrature on 0..1, exact to degree 2 points - 1.
struct GaussRule {
  std::vector<BeamReal> node, weight;
  explicit GaussRule(int points);
};

}  // namespace heerk_rotor
