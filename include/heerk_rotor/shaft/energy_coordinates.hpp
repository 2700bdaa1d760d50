#pragma once
#include "heerk_rotor/shaft/shaft_matrices.hpp"

namespace heerk_rotor {

/// The rotating shaft as a first-order system in energy coordinates eta = (R'q, L'q'), K = R R', M = L L' (Cholesky):
///   eta' = H eta + (0, L^-1 F),  H = [[0, B], [-B', -L^-1 (C - omega G) L^-T]],  B = R'L^-T,  energy = |eta|^2 / 2.
/// H is skew but for the damping, so that its eigenvectors are nearly orthogonal and none of its eigenvalues suffers from the size
/// of another: neither K nor M is inverted, and entries are frequencies instead of their squares.
struct EnergyCoordinates {
  ShaftMatrix H;              // (2n x 2n) [1/s]
  ShaftMatrix from_physical;  // (2n x 2n) eta = from_physical (q, q') [sqrt(J) per m, rad, m/s, rad/s]
  ShaftMatrix to_physical;    // (2n x 2n) its inverse
  ShaftMatrix from_force;     // (2n x n) eta' = H eta + from_force F
};

/// At the speed omega [rad/s]. Throws std::invalid_argument when M or K is not positive definite (a node without inertia, a shaft that
/// its bearings do not hold).
EnergyCoordinates energyCoordinates(const ShaftMatrices& shaft, double omega);

}  // namespace heerk_rotor
