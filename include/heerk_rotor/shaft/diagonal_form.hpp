#pragma once
#include <complex>
#include <vector>

#include <Eigen/StdVector>

#include "heerk_rotor/shaft/shaft_types.hpp"

namespace heerk_rotor {

/// H = T block-diagonal(blocks) T^-1: a real matrix of even size brought to pairs of coordinates. Block i couples coordinates i and
/// m + i: [[a, b], [-b, a]] for the eigenvalues a +- i b, diag(a_1, a_2) for two real ones. Ascending in |eigenvalue|.
struct DiagonalForm {
  std::vector<std::complex<ShaftReal>> eigenvalues;  // (m) a + i b, b > 0; of two real ones a_1
  std::vector<Eigen::Matrix2d, Eigen::aligned_allocator<Eigen::Matrix2d>> blocks;  // (m) [1/s]
  ShaftMatrix T;        // (2m x 2m), complex pairs of columns have norm sqrt(2): orthogonal when H is skew
  ShaftMatrix inverse;  // T^-1
  double condition;     // |T|_F |T^-1|_F / 2m, 1 when orthogonal
};

/// By the QR algorithm in long double. Throws std::runtime_error when H has no useful diagonal form (two equal eigenvalues that share one
/// eigenvector, as at critical damping, or nearly so).
DiagonalForm diagonalForm(const ShaftMatrix& H);

}  // namespace heerk_rotor
