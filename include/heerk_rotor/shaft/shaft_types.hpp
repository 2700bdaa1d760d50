#pragma once
#include <Eigen/Core>

namespace heerk_rotor {

/// Shaft matrices are assembled and diagonalised in 80-bit long double: eigenvalues range over 4e2 .. 1e6 rad/s, and squared
/// they would cost the low ones their last digits.
using ShaftReal = long double;
using ShaftMatrix = Eigen::Matrix<ShaftReal, Eigen::Dynamic, Eigen::Dynamic>;
using ShaftVector = Eigen::Matrix<ShaftReal, Eigen::Dynamic, 1>;

/// Degrees of freedom of one node, in this order. Axes fixed in space: z along the shaft, x and y transverse; displacements
/// from the static position, tilts are rotation angles about x and y (without shear x' = tilt_y, y' = -tilt_x).
enum ShaftDof { kShaftX, kShaftY, kShaftTiltX, kShaftTiltY, kShaftNodeDofs };

}  // namespace heerk_rotor
