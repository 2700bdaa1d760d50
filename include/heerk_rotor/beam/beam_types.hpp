#pragma once
#include <Eigen/Core>

namespace heerk_rotor {

/// Beam matrices are assembled and reduced in 80-bit long double: entries range over EI/l^3 .. EI/l, and rounding them to double
/// already moves the lowest frequencies by 1e-12.
using BeamReal = long double;
using BeamMatrix = Eigen::Matrix<BeamReal, Eigen::Dynamic, Eigen::Dynamic>;
using BeamVector = Eigen::Matrix<BeamReal, Eigen::Dynamic, 1>;

/// Degrees of freedom of one node, in this order. Pitched (feathering) axes: x outboard, y toward the leading edge, z up; v along
/// y, w along z, phi nose up; slopes are derivatives by x.
enum NodeDof { kDofV, kDofSlopeV, kDofW, kDofSlopeW, kDofTwist, kNodeDofs };

/// Rows of what is evaluated at a radius.
enum ShapeRow { kRowV, kRowW, kRowTwist, kRowSlopeV, kRowSlopeW, kShapeRows };

}  // namespace heerk_rotor
