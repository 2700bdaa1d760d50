#include "heerk_rotor/integrate/precise_exponential.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include <Eigen/LU>

#include "heerk_rotor/integrate/phi_functions.hpp"

namespace heerk_rotor {
namespace {
constexpr int kDoublings = 20;  // N
constexpr int kPade = 4;        // p
}  // namespace

Matrix preciseExponential(const Matrix& H, double dt) {
  if (H.rows() != H.cols()) throw std::invalid_argument("preciseExponential: H is " + std::to_string(H.rows()) + " x " + std::to_string(H.cols()) + ", expected square");
  if (!H.allFinite() || !std::isfinite(dt)) throw std::invalid_argument("preciseExponential: H or dt is not finite");
  const Index n = H.rows();
  const Vector d = balancingScales(H);
  const Matrix Htau = d.cwiseInverse().asDiagonal() * H * d.asDiagonal() * std::ldexp(dt, -kDoublings);

  // Numerator and denominator without their I: coefficients (2p - k)! p! / ((2p)! k! (p - k)!), signs alternating in the denominator.
  Matrix N = Matrix::Zero(n, n), D = Matrix::Zero(n, n), power = Matrix::Identity(n, n);
  double coefficient = 1.0;
  for (int k = 1; k <= kPade; ++k) {
    coefficient *= static_cast<double>(kPade - k + 1) / static_cast<double>(k * (2 * kPade - k + 1));
    power = power * Htau;
    N += coefficient * power;
    D += (k % 2 == 0 ? coefficient : -coefficient) * power;
  }
  Matrix T = (Matrix::Identity(n, n) + D).partialPivLu().solve(N - D);
  for (int i = 0; i < kDoublings; ++i) T = 2.0 * T + T * T;
  T.diagonal().array() += 1.0;
  return d.asDiagonal() * T * d.cwiseInverse().asDiagonal();
}

}  // namespace heerk_rotor
