#pragma once
#include "heerk_rotor/shaft/shaft_properties.hpp"
#include "heerk_rotor/shaft/shaft_types.hpp"

namespace heerk_rotor {

/// M q'' + (C - omega G) q' + K q = F of a shaft that turns with omega about +z, q in the order of ShaftDof, node by node.
/// G is minus the textbook's gyroscopic matrix (a disc's block is G[tilt_x, tilt_y] = -J_p, G[tilt_y, tilt_x] = +J_p), so that forward
/// whirl has the sense of omega. The driving torque follows the tangent of the shaft and bends it not: with omega' the
/// equation stays the same.
struct ShaftMatrices {
  ShaftMatrix M;  // (n x n) segments and discs [kg, kg m, kg m^2]
  ShaftMatrix C;  // (n x n) alpha M + beta K of the segments + bearings
  ShaftMatrix G;  // (n x n) skew, segments and discs [kg, kg m, kg m^2]
  ShaftMatrix K;  // (n x n) segments and bearings

  /// Unbalance forces are omega^2 (column 0 cos(psi) + column 1 sin(psi)) for constant speed, psi = azimuth of the rotor;
  /// in general Re and Im of (omega^2 - i omega') e^{i psi} take the place of omega^2 cos and omega^2 sin.
  ShaftMatrix unbalance;  // (n x 2) [kg m]

  Eigen::Index size() const { return M.rows(); }
};

/// Throws std::invalid_argument with all problems when the properties are not in order.
ShaftMatrices assembleShaft(const ShaftProperties& properties);

/// Row of a degree of freedom.
inline Eigen::Index shaftRow(int node, ShaftDof dof) { return static_cast<Eigen::Index>(kShaftNodeDofs) * node + dof; }

}  // namespace heerk_rotor
