#include "heerk_rotor/shaft/energy_coordinates.hpp"

#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>

namespace heerk_rotor {
namespace {

/// A free motion leaves round-off in the last pivot of K, of either sign: what is this much smaller than its diagonal entry is none.
bool positiveDefinite(const ShaftMatrix& A, const Eigen::LLT<ShaftMatrix>& factor) {
  constexpr ShaftReal kSmallestPivot = 1e-16L;  // 1000 times the round-off of long double; a soft bearing leaves 1e-6 and more
  if (factor.info() != Eigen::Success) return false;
  const ShaftMatrix& L = factor.matrixLLT();
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    if (!(L(i, i) * L(i, i) > kSmallestPivot * A(i, i))) return false;
  return true;
}

}  // namespace

EnergyCoordinates energyCoordinates(const ShaftMatrices& shaft, double omega) {
  const Eigen::Index n = shaft.size();
  const Eigen::LLT<ShaftMatrix> mass(shaft.M), stiffness(shaft.K);
  if (!positiveDefinite(shaft.M, mass)) throw std::invalid_argument("energyCoordinates: the mass matrix is not positive definite; expected mass and inertia > 0 at every node");
  if (!positiveDefinite(shaft.K, stiffness))
    throw std::invalid_argument("energyCoordinates: the stiffness matrix is not positive definite: the shaft can move freely; expected bearings that hold it at two nodes, in x and in y");

  const ShaftMatrix identity = ShaftMatrix::Identity(n, n);
  const ShaftMatrix L_inverse = mass.matrixL().solve(identity), R_inverse = stiffness.matrixL().solve(identity);
  const ShaftMatrix B = stiffness.matrixU() * L_inverse.transpose();

  EnergyCoordinates energy;
  energy.H.setZero(2 * n, 2 * n);
  energy.H.topRightCorner(n, n) = B;
  energy.H.bottomLeftCorner(n, n) = -B.transpose();
  energy.H.bottomRightCorner(n, n) = -L_inverse * (shaft.C - static_cast<ShaftReal>(omega) * shaft.G) * L_inverse.transpose();
  energy.from_physical.setZero(2 * n, 2 * n);
  energy.from_physical.topLeftCorner(n, n) = stiffness.matrixU();
  energy.from_physical.bottomRightCorner(n, n) = mass.matrixU();
  energy.to_physical.setZero(2 * n, 2 * n);
  energy.to_physical.topLeftCorner(n, n) = R_inverse.transpose();
  energy.to_physical.bottomRightCorner(n, n) = L_inverse.transpose();
  energy.from_force.setZero(2 * n, n);
  energy.from_force.bottomRows(n) = L_inverse;
  return energy;
}

}  // namespace heerk_rotor
