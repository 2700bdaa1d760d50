#pragma once
#include "heerk_rotor/beam/beam_types.hpp"

namespace heerk_rotor {

/// Degrees of freedom of one element: those of its left node, then those of its right node.
constexpr int kElementDofs = 2 * kNodeDofs;
using ElementVector = Eigen::Matrix<BeamReal, kElementDofs, 1>;
using ElementMatrix = Eigen::Matrix<BeamReal, kElementDofs, kElementDofs>;

/// Values and derivatives of the displacements inside one element, per degree of freedom.
struct ElementShapes {
  ElementVector v, slope_v, curvature_v;  // [m, -], [-, 1/m], ...
  ElementVector w, slope_w, curvature_w;
  ElementVector twist, twist_rate;

  /// At s = (x - left) / length in 0..1.
  ElementShapes(BeamReal s, BeamReal length);
};

}  // namespace heerk_rotor
