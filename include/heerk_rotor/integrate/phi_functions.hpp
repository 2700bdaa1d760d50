#pragma once
#include <array>
#include <complex>
#include <vector>

#include "heerk_rotor/core/types.hpp"

namespace heerk_rotor {

/// phi_0(z) = e^z, phi_k(z) = sum_i z^i / (i + k)!, so that z phi_{k+1}(z) = phi_k(z) - 1/k!.
/// (Hochbruck & Ostermann, Acta Numerica 19 (2010), section 2.1.) All of this runs at construction, never in the step, and
/// computes in 80-bit long double inside: what is lost there is lost in every step that uses the tables.

/// Largest k that the functions below provide.
constexpr int kMaxPhi = 4;

/// phi_k of a number, k = 0..kMaxPhi.
double phi(int k, double z);
std::complex<double> phi(int k, std::complex<double> z);

/// phi_0(A) .. phi_kmax(A) of a dense square matrix.
/// Method: balancing by powers of two; scaling chosen from ||A^p||^(1/p), p = 2, 3, 4 (Al-Mohy & Higham, SIAM J. Matrix Anal.
/// Appl. 31 (2009) 970); Taylor series of phi_kmax; phi_{k-1} = z phi_k + 1/(k-1)!; then all phi_k are doubled together (Skaflestad &
/// Wright, Appl. Numer. Math. 59 (2009) 783), with e^z - I in place of e^z. Squaring the exponential of the augmented matrix
/// [[A, I], [0, J]] forms the very same products, but there the norm, the balancing and hence the scaling mix A with J;
/// z^-1 (phi_k - 1/k!) is avoided because it divides rounding errors by z.
/// Measured against quadruple precision (test/integrate/phi_functions_test.cpp), worst relative Frobenius norm of phi_0..phi_4:
///   normal and dissipative matrices of norm 1e-3..1e3:                            6e-17 (the rounding of the result)
///   the same in units from 1e-8 to 1e8 (norm 1e18), in balanced coordinates:      3e-15
///   FE beam [[0, I], [-K, -C]], norm 1e12, spectral radius 6e5, h = 1e-6..1e-3:   1e-15 in (q, q'), 5e-15 in the energy norm
/// The last line is this function alone: rounding K's entries to double already moves its low frequencies by 1e-12, which only the
/// modal form avoids.
/// Cost: 7 + kmax + (kmax + 1) log2(||A||) long double products; about 0.15 s at n = 100 and h ||S|| = 600, growing with n^3.
/// Throws std::invalid_argument unless A is square and finite, std::overflow_error when a phi_k exceeds the range of double.
std::vector<Matrix> phiFunctions(const Matrix& A, int kmax);

/// Powers of two d with which A(i, j) d_j / d_i has rows and columns of similar 2-norm (James, Langou & Lowery, arXiv:1401.5766:
/// with the 2-norm and the diagonal included, a small coupling is not blown up). All ones when that would not reduce ||A||_1.
Vector balancingScales(const Matrix& A);

/// phi_0 .. phi_4 of h N, N = [[0, 1], [-omega^2, -damping]]: one oscillator q'' = -omega^2 q - damping q' in coordinates (q, q').
/// In energy coordinates (omega q, q') with a = h omega, s = h damping / 2, rho = (s - a)(s + a): h N is [[0, a], [-a, -2 s]]
/// = -s I + M, M^2 = rho I, so phi_k = F0 I + F1 M with scalars F0, F1. Three branches: Taylor series while a, s <= 1.5; cos, sin
/// (or cosh, sinh) with the exact recurrence while rho <= 1; separated real roots beyond, where nothing overflows however large s
/// is. Every damping from none to huge is covered, critical included, and so are omega = 0 and damping = 0.
/// Measured, energy norm, relative, against quadruple precision, a in 1e-12..6e3, zeta in 0..1e4, near-critical included:
/// worst 3e-15, where a is close to a multiple of 2 pi and phi_1 itself nearly vanishes.
class ModalPhi {
 public:
  /// omega >= 0 [rad/s], damping >= 0 [1/s], h > 0 [s].
  ModalPhi(double omega, double damping, double h);

  const Eigen::Matrix2d& operator[](int k) const { return phi_[k]; }

 private:
  std::array<Eigen::Matrix2d, kMaxPhi + 1> phi_;
};

}  // namespace heerk_rotor
