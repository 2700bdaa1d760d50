#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/beam/blade_elements.hpp"

namespace heerk_rotor {

/// Motion that holds most of a mode's kinetic energy.
enum class ModeKind { kLag, kFlap, kTorsion };

/// Undamped modes of the rotating blade, K V = M V diag(omega^2), ascending, V'MV = I. With C = alpha M + beta K each mode is one
/// oscillator q.. + damping q. + omega^2 q = F. Hinge dampers couple the modes and are not part of `damping`.
struct BladeModes {
  Eigen::VectorXd omega;        // (m) [rad/s]
  Eigen::VectorXd damping;      // (m) c = alpha + beta omega^2 [1/s]
  BeamMatrix V;                 // (n x m) displacements per modal coordinate
  std::vector<ModeKind> kind;   // (m)
  std::vector<std::string> name;  // (m) L1, F1, F2, T1, ... counted within each kind

  Eigen::Index size() const { return omega.size(); }

  /// Position of a mode by name; throws std::out_of_range when there is none.
  Eigen::Index index(const std::string& mode) const;

  /// N(r) V: displacements, twist and slopes at radius r per modal coordinate, (kShapeRows x m). Their transpose turns forces and
  /// moments (p_y, p_z, m_x, m_z, -m_y) there into modal loads. Throws std::invalid_argument for r outside the nodes.
  Eigen::MatrixXd rows(const BladeMatrices& blade, double r) const;

  /// V' A V and V' f.
  Eigen::MatrixXd project(const BeamMatrix& A) const;
  Eigen::VectorXd project(const BeamVector& f) const;
};

/// Solves the eigenproblem of M and K once. Method: with Cholesky factors M = L L', K = R R', omega are the singular values and L'V
/// the left singular vectors of L^-1 R, by one-sided Jacobi in long double. So neither K nor M is inverted, and the condition
/// that counts is omega_max / omega_min (2e4 for ten elements), not its square. Against quadruple precision every omega is right to
/// the rounding of double. Cost grows with n^3: 6 ms for 50 degrees of freedom, 3 s for 400.
/// Signs: the tip displacement of the mode's kind (v, w or twist) is positive.
/// `count`: lowest modes to keep, 0 for all. Throws std::invalid_argument when K is not positive definite (a lag hinge at radius 0
/// without spring; a divergent blade) or count is out of range.
BladeModes bladeModes(const BladeMatrices& blade, const BeamMatrix& K, int count = 0);

}  // namespace heerk_rotor
