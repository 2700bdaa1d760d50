#include <stdexcept>

#include <Eigen/Cholesky>

#include "shaft_form.hpp"

namespace heerk_rotor {

ShaftForm physicalShaftForm(const ShaftMatrices& shaft, double omega) {
  const Eigen::Index m = shaft.size();
  const Eigen::LLT<ShaftMatrix> mass(shaft.M);
  if (mass.info() != Eigen::Success) throw std::invalid_argument("the mass matrix of the shaft is not positive definite; expected mass and inertia > 0 at every node");
  // K need not be definite here: K = P'L D L'P, energy with the root of D.
  const Eigen::LDLT<ShaftMatrix> stiffness(shaft.K);

  ShaftForm form;
  form.observe.setIdentity(2 * m, 2 * m);
  form.force.setZero(2 * m, m);
  form.force.bottomRows(m) = mass.solve(ShaftMatrix::Identity(m, m)).cast<double>();
  form.energy.setZero(2 * m, 2 * m);
  const ShaftMatrix permutation = stiffness.transpositionsP() * ShaftMatrix::Identity(m, m);
  const ShaftMatrix mass_root = mass.matrixU(), unit_root = stiffness.matrixU();
  const ShaftMatrix stiffness_root = stiffness.vectorD().cwiseMax(ShaftReal(0)).cwiseSqrt().asDiagonal() * ShaftMatrix(unit_root * permutation);
  form.energy.topLeftCorner(m, m) = stiffness_root.cast<double>();
  form.energy.bottomRightCorner(m, m) = mass_root.cast<double>();
  form.start.setZero(2 * m);
  form.S = SecondOrderStiff{mass.solve(shaft.K).cast<double>(), mass.solve(shaft.C - static_cast<ShaftReal>(omega) * shaft.G).cast<double>()};

  const char* const dofs[] = {"x", "y", "tilt_x", "tilt_y"};
  for (const bool rate : {false, true})
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index dof = i % kShaftNodeDofs;
      const std::string unit = dof < kShaftTiltX ? "m" : "rad", what = dof < kShaftTiltX ? "displacement of the node from its static position along " : "tilt of the shaft at the node about ";
      form.states.push_back({"node_" + std::to_string(i / kShaftNodeDofs) + "_" + dofs[dof] + (rate ? "_rate" : ""), rate ? unit + "/s" : unit,
                             (rate ? "rate of the " : "") + what + (dof % 2 == 0 ? "x" : "y")});
    }
  return form;
}

}  // namespace heerk_rotor
