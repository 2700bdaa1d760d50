#include "heerk_rotor/beam/blade_modes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <Eigen/Cholesky>

namespace heerk_rotor {
namespace {

/// Singular values (norms of the rotated columns) and vectors of G by one-sided Jacobi (Hestenes): columns are turned pairwise until
/// all are orthogonal. Columns of very different norm keep their own relative accuracy (Demmel & Veselic, SIAM J. Matrix Anal. Appl.
/// 13 (1992) 1204), which bidiagonalisation would lose.
void orthogonaliseColumns(BeamMatrix& G) {
  constexpr int kMaxSweeps = 60;  // 8 to 12 are usual
  const BeamReal negligible = 4 * std::numeric_limits<BeamReal>::epsilon();
  const Eigen::Index n = G.cols();
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    bool turned = false;
    // Exact at the start of a sweep, so also in the last one, which turns nothing; updated inside, where they only steer.
    BeamVector square = G.colwise().squaredNorm();
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = i + 1; j < n; ++j) {
        const BeamReal a = square[i];
        const BeamReal b = square[j];
        const BeamReal product = G.col(i).dot(G.col(j));
        if (std::abs(product) <= negligible * std::sqrt(a * b)) continue;
        turned = true;
        const BeamReal zeta = (b - a) / (2 * product);
        const BeamReal t = (zeta >= 0 ? 1 : -1) / (std::abs(zeta) + std::sqrt(1 + zeta * zeta));
        const BeamReal c = 1 / std::sqrt(1 + t * t);
        const BeamReal s = c * t;
        square[i] = std::max(a - t * product, std::numeric_limits<BeamReal>::min());
        square[j] = b + t * product;
        for (Eigen::Index k = 0; k < G.rows(); ++k) {
          const BeamReal first = G(k, i);
          G(k, i) = c * first - s * G(k, j);
          G(k, j) = s * first + c * G(k, j);
        }
      }
    }
    if (!turned) return;
  }
  throw std::runtime_error("bladeModes: the eigenproblem did not converge; are the properties of very different magnitude?");
}

/// Node dofs that make up each ModeKind.
bool belongsTo(int node_dof, ModeKind kind) {
  switch (kind) {
    case ModeKind::kLag: return node_dof == kDofV || node_dof == kDofSlopeV;
    case ModeKind::kFlap: return node_dof == kDofW || node_dof == kDofSlopeW;
    case ModeKind::kTorsion: return node_dof == kDofTwist;
  }
  return false;
}

/// Kind with the largest share of v'Mv.
ModeKind kindOf(const BladeMatrices& blade, const BeamVector& mode) {
  std::array<BeamReal, 3> share{};
  const BeamVector momentum = blade.M * mode;
  for (std::size_t dof = 0; dof < blade.free_dof.size(); ++dof) {
    const int row = blade.free_dof[dof];
    if (row < 0) continue;
    for (ModeKind kind : {ModeKind::kLag, ModeKind::kFlap, ModeKind::kTorsion})
      if (belongsTo(dof % kNodeDofs, kind)) share[static_cast<int>(kind)] += mode[row] * momentum[row];
  }
  return static_cast<ModeKind>(std::max_element(share.begin(), share.end()) - share.begin());
}

void fixSign(const BladeMatrices& blade, ModeKind kind, Eigen::Ref<BeamVector> mode) {
  const NodeDof tip_dof = kind == ModeKind::kLag ? kDofV : kind == ModeKind::kFlap ? kDofW : kDofTwist;
  const int row = blade.free_dof[blade.free_dof.size() - kNodeDofs + tip_dof];
  if (mode[row] < 0) mode = -mode;
}

}  // namespace

BladeModes bladeModes(const BladeMatrices& blade, const BeamMatrix& K, int count) {
  const Eigen::Index n = blade.size();
  if (K.rows() != n || K.cols() != n)
    throw std::invalid_argument("bladeModes: K is " + std::to_string(K.rows()) + " x " + std::to_string(K.cols()) + ", expected " +
                                std::to_string(n) + " x " + std::to_string(n));
  if (count < 0 || count > n)
    throw std::invalid_argument("bladeModes: count = " + std::to_string(count) + ", expected 0 (all) or 1.." + std::to_string(n));

  const Eigen::LLT<BeamMatrix> mass(blade.M);
  if (mass.info() != Eigen::Success)
    throw std::invalid_argument("bladeModes: the mass matrix is not positive definite; expected mass and torsional inertia > 0");
  const Eigen::LLT<BeamMatrix> stiffness(K);
  if (stiffness.info() != Eigen::Success)
    throw std::invalid_argument(
        "bladeModes: the stiffness matrix is not positive definite: the blade has a free or divergent motion; expected a spring or an "
        "offset at every free hinge, and enough torsional stiffness");

  BeamMatrix G = stiffness.matrixL();
  mass.matrixL().solveInPlace(G);
  orthogonaliseColumns(G);

  // Ascending frequencies; L'V = unit columns.
  const BeamVector omega = G.colwise().norm();
  std::vector<Eigen::Index> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return omega[a] < omega[b]; });
  const Eigen::Index m = count == 0 ? n : count;

  BladeModes modes;
  modes.omega.resize(m);
  modes.damping.resize(m);
  modes.V.resize(n, m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const BeamReal w = omega[order[i]];
    modes.omega[i] = static_cast<double>(w);
    modes.damping[i] = static_cast<double>(blade.alpha + blade.beta * w * w);
    modes.V.col(i) = G.col(order[i]) / w;
  }
  mass.matrixU().solveInPlace(modes.V);

  std::array<int, 3> counted{};
  for (Eigen::Index i = 0; i < m; ++i) {
    const ModeKind kind = kindOf(blade, modes.V.col(i));
    fixSign(blade, kind, modes.V.col(i));
    modes.kind.push_back(kind);
    modes.name.push_back("LFT"[static_cast<int>(kind)] + std::to_string(++counted[static_cast<int>(kind)]));
  }
  return modes;
}

Eigen::Index BladeModes::index(const std::string& mode) const {
  const auto found = std::find(name.begin(), name.end(), mode);
  if (found == name.end())
    throw std::out_of_range("BladeModes: no mode '" + mode + "' among the " + std::to_string(name.size()) +
                            " lowest, expected L, F or T and a number");
  return found - name.begin();
}

Eigen::MatrixXd BladeModes::rows(const BladeMatrices& blade, double r) const { return (blade.shapeRows(r) * V).cast<double>(); }

Eigen::MatrixXd BladeModes::project(const BeamMatrix& A) const { return (V.transpose() * A * V).cast<double>(); }

Eigen::VectorXd BladeModes::project(const BeamVector& f) const { return (V.transpose() * f).cast<double>(); }

}  // namespace heerk_rotor
