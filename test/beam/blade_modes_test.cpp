#include "heerk_rotor/beam/blade_modes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "blade_data.hpp"

namespace heerk_rotor {
namespace {

// ------------------------------------------------------------------------------------------------ quadruple reference
// Eigenvalues of L^-1 K L^-T by two-sided cyclic Jacobi in 113 bits: another algorithm in another precision.

__extension__ typedef __float128 Quad;
using QuadRows = std::vector<std::vector<Quad>>;

Quad squareRoot(Quad a) {
  Quad root = std::sqrt(static_cast<long double>(a));
  for (int i = 0; i < 3; ++i) root = (root + a / root) / 2;
  return root;
}

QuadRows choleskyFactor(const BeamMatrix& A) {
  const int n = static_cast<int>(A.rows());
  QuadRows L(n, std::vector<Quad>(n, Quad(0)));
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i) {
      Quad sum = A(i, j);
      for (int k = 0; k < j; ++k) sum -= L[i][k] * L[j][k];
      L[i][j] = i == j ? squareRoot(sum) : sum / L[j][j];
    }
  return L;
}

/// L^-1 applied to every column.
void solveLower(const QuadRows& L, QuadRows& B) {
  const int n = static_cast<int>(L.size());
  for (int column = 0; column < n; ++column)
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < i; ++k) B[i][column] -= L[i][k] * B[k][column];
      B[i][column] /= L[i][i];
    }
}

std::vector<long double> referenceFrequencies(const BeamMatrix& M, const BeamMatrix& K) {
  const int n = static_cast<int>(M.rows());
  const QuadRows L = choleskyFactor(M);
  QuadRows A(n, std::vector<Quad>(n));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) A[i][j] = K(i, j);
  for (int side = 0; side < 2; ++side) {
    solveLower(L, A);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < i; ++j) std::swap(A[i][j], A[j][i]);
  }
  for (int sweep = 0; sweep < 40; ++sweep) {
    bool turned = false;
    for (int p = 0; p < n; ++p)
      for (int q = p + 1; q < n; ++q) {
        const Quad off = (A[p][q] + A[q][p]) / 2, product = A[p][p] * A[q][q];
        if (off * off <= Quad(1e-60L) * (product < 0 ? -product : product)) continue;
        turned = true;
        const Quad zeta = (A[q][q] - A[p][p]) / (2 * off);
        const Quad t = (zeta >= 0 ? Quad(1) : Quad(-1)) / ((zeta < 0 ? -zeta : zeta) + squareRoot(1 + zeta * zeta));
        const Quad c = 1 / squareRoot(1 + t * t), s = c * t;
        for (int k = 0; k < n; ++k) {
          const Quad first = A[k][p];
          A[k][p] = c * first - s * A[k][q];
          A[k][q] = s * first + c * A[k][q];
        }
        for (int k = 0; k < n; ++k) {
          const Quad first = A[p][k];
          A[p][k] = c * first - s * A[q][k];
          A[q][k] = s * first + c * A[q][k];
        }
      }
    if (!turned) break;
  }
  std::vector<long double> omega;
  for (int i = 0; i < n; ++i) omega.push_back(static_cast<long double>(squareRoot(A[i][i])));
  std::sort(omega.begin(), omega.end());
  return omega;
}

TEST(BladeModes, frequenciesAreAccurateToTheRoundingOfTheResult) {
  for (const auto& [properties, speed] : {std::pair(bo105Blade(), kBo105Omega), std::pair(hart2Blade(), kHart2Omega)}) {
    const BladeMatrices blade = assembleBlade(properties);
    const BeamMatrix K = blade.stiffness(speed);
    const BladeModes modes = bladeModes(blade, K);
    const std::vector<long double> reference = referenceFrequencies(blade.M, K);
    for (Eigen::Index i = 0; i < modes.size(); ++i)
      EXPECT_LT(std::abs(static_cast<double>(modes.omega[i] / reference[i] - 1)), 2e-16) << "mode " << i;
  }
}

TEST(BladeModes, areMassNormalisedOrthogonalAndDiagonaliseK) {
  const BladeMatrices blade = assembleBlade(bo105Blade());
  const BeamMatrix K = blade.stiffness(kBo105Omega);
  const BladeModes modes = bladeModes(blade, K);
  const Eigen::Index n = modes.size();
  EXPECT_EQ(n, 50);
  EXPECT_LT((modes.project(blade.M) - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 1e-14);
  // Off-diagonal entries of V'KV over omega_i omega_j; the rounding of long double times omega_max / omega_min = 2e4.
  const Eigen::MatrixXd scaled = modes.omega.cwiseInverse().asDiagonal() * modes.project(K) * modes.omega.cwiseInverse().asDiagonal();
  EXPECT_LT((scaled - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 1e-13);
  for (Eigen::Index i = 1; i < n; ++i) EXPECT_LE(modes.omega[i - 1], modes.omega[i]);
}

TEST(BladeModes, dampingIsDiagonalWithoutHingeDampers) {
  const BladeMatrices blade = assembleBlade(bo105Blade());
  const BeamMatrix K = blade.stiffness(kBo105Omega);
  const BladeModes modes = bladeModes(blade, K, 10);
  const Eigen::MatrixXd C = modes.project(blade.damping(K));
  EXPECT_LT((C - Eigen::MatrixXd(modes.damping.asDiagonal())).cwiseAbs().maxCoeff(), 1e-12);
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(modes.damping[i], 0.5 + 1e-7 * modes.omega[i] * modes.omega[i], 1e-14 * modes.damping[i]);
}

TEST(BladeModes, signsAreFixedAndTruncationKeepsTheLowest) {
  const BladeProperties p = bo105Blade();
  const BladeMatrices blade = assembleBlade(p);
  const BeamMatrix K = blade.stiffness(kBo105Omega);
  const BladeModes all = bladeModes(blade, K);
  const BladeModes few = bladeModes(blade, K, 6);
  ASSERT_EQ(few.size(), 6);
  EXPECT_EQ(few.omega, all.omega.head(6));
  EXPECT_EQ(few.V, all.V.leftCols(6));
  EXPECT_EQ(few.name, (std::vector<std::string>{"L1", "F1", "F2", "T1", "L2", "F3"}));
  const Eigen::MatrixXd tip = all.rows(blade, 4.91);
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    const int row = all.kind[i] == ModeKind::kLag ? kRowV : all.kind[i] == ModeKind::kFlap ? kRowW : kRowTwist;
    EXPECT_GE(tip(row, i), 0) << all.name[i];
  }
  EXPECT_THROW(few.index("T2"), std::out_of_range);
}

TEST(BladeModes, modalStaticDeflectionIsThatOfTheBeam) {
  // Tip force P on a uniform cantilever at rest: w(R) = P R^3 / (3 EI), w'(R) = P R^2 / (2 EI); cubic elements are exact.
  const BladeMatrices blade = assembleBlade(uniformBlade(4));
  const BladeModes modes = bladeModes(blade, blade.stiffness(0));
  const Eigen::MatrixXd tip = modes.rows(blade, 1.0);
  const Eigen::VectorXd load = tip.row(kRowW).transpose() * 0.3;
  const Eigen::VectorXd q = load.cwiseQuotient(modes.omega.cwiseAbs2());
  EXPECT_NEAR(tip.row(kRowW) * q, 0.3 / 3, 1e-14);
  EXPECT_NEAR(tip.row(kRowSlopeW) * q, 0.3 / 2, 1e-14);
  EXPECT_NEAR(modes.rows(blade, 0.5).row(kRowW) * q, 0.3 * (0.5 * 0.25 - 0.125 / 6), 1e-14);
}

TEST(BladeModes, freeOrDivergentBladesAreRefusedWithAReason) {
  BladeProperties p = uniformBlade(3);
  p.root.lag_hinge = true;  // at radius 0 nothing holds the lag angle
  const BladeMatrices blade = assembleBlade(p);
  try {
    bladeModes(blade, blade.stiffness(1) - BeamReal(1e-12) * blade.M);  // rounding alone could make the zero eigenvalue positive
    FAIL() << "expected an exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("spring or an offset at every free hinge"), std::string::npos) << error.what();
  }
  const BladeMatrices good = assembleBlade(uniformBlade(3));
  EXPECT_THROW(bladeModes(good, good.stiffness(1), 99), std::invalid_argument);
  EXPECT_THROW(bladeModes(good, BeamMatrix::Identity(2, 2)), std::invalid_argument);
}

}  // namespace
}  // namespace heerk_rotor
