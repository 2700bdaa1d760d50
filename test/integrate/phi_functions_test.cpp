#include "heerk_rotor/integrate/phi_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace heerk_rotor {
namespace {

// ------------------------------------------------------------------------------------------------ quadruple reference
// Independent of the library: no balancing, no Paterson-Stockmeyer, plain Taylor series of every phi_k after many more halvings, and
// 113 bits, so that what its squarings lose (norm * 1e-34) is out of sight. Only + - * / are used: no libquadmath to link.

__extension__ typedef __float128 Quad;

struct QuadMatrix {
  int n;
  std::vector<Quad> entry;  // (n x n), column by column

  explicit QuadMatrix(int size) : n(size), entry(static_cast<std::size_t>(size) * size, Quad(0)) {}
  explicit QuadMatrix(const Matrix& A) : QuadMatrix(static_cast<int>(A.rows())) {
    for (std::size_t i = 0; i < entry.size(); ++i) entry[i] = A.data()[i];
  }
  Quad& operator()(int i, int j) { return entry[i + static_cast<std::size_t>(n) * j]; }
  Quad operator()(int i, int j) const { return entry[i + static_cast<std::size_t>(n) * j]; }
};

QuadMatrix operator*(const QuadMatrix& A, const QuadMatrix& B) {
  QuadMatrix C(A.n);
  for (int j = 0; j < A.n; ++j)
    for (int k = 0; k < A.n; ++k) {
      const Quad b = B(k, j);
      if (b == 0) continue;
      for (int i = 0; i < A.n; ++i) C(i, j) += A(i, k) * b;
    }
  return C;
}

double frobenius(const QuadMatrix& A) {
  Quad sum = 0;
  for (Quad a : A.entry) sum += a * a;
  return std::sqrt(static_cast<double>(sum));
}

Quad factorial(int n) { return n <= 1 ? Quad(1) : n * factorial(n - 1); }

/// phi_0(A) .. phi_4(A)
std::vector<QuadMatrix> reference(QuadMatrix A) {
  const int halved = std::max(0, static_cast<int>(std::ceil(std::log2(frobenius(A) + 1e-300))) + 4);
  Quad factor = 1;
  for (int i = 0; i < halved; ++i) factor /= 2;
  for (Quad& a : A.entry) a *= factor;

  // Norm <= 1/16 now: 16^-24 / 24! = 2e-53.
  std::vector<QuadMatrix> phi(kMaxPhi + 1, QuadMatrix(A.n));
  phi[kMaxPhi] = QuadMatrix(A.n);
  for (int i = 24; i >= 0; --i) {
    phi[kMaxPhi] = phi[kMaxPhi] * A;
    for (int r = 0; r < A.n; ++r) phi[kMaxPhi](r, r) += 1 / factorial(i + kMaxPhi);
  }
  for (int k = kMaxPhi - 1; k >= 0; --k) {
    phi[k] = A * phi[k + 1];
    for (int r = 0; r < A.n; ++r) phi[k](r, r) += 1 / factorial(k);
  }
  for (int doubled = 0; doubled < halved; ++doubled) {
    std::vector<QuadMatrix> next;
    Quad half = 1;
    for (int k = 0; k <= kMaxPhi; ++k, half /= 2) {
      next.push_back(phi[0] * phi[k]);
      for (int j = 1; j <= k; ++j)
        for (std::size_t i = 0; i < phi[j].entry.size(); ++i) next[k].entry[i] += phi[j].entry[i] / factorial(k - j);
      for (Quad& a : next[k].entry) a *= half;
    }
    phi = next;
  }
  return phi;
}

/// ||D (value - expected) D^-1||_F / ||D expected D^-1||_F, D = diag(weight).
double relativeError(const Matrix& value, const QuadMatrix& expected, const Vector& weight) {
  Quad error = 0, size = 0;
  for (int j = 0; j < expected.n; ++j)
    for (int i = 0; i < expected.n; ++i) {
      const Quad scale = Quad(weight[i]) / weight[j];
      const Quad e = (value(i, j) - expected(i, j)) * scale;
      error += e * e;
      size += expected(i, j) * expected(i, j) * scale * scale;
    }
  return std::sqrt(static_cast<double>(error / size));
}

double relativeError(const Matrix& value, const QuadMatrix& expected) {
  return relativeError(value, expected, Vector::Ones(expected.n));
}

/// Worst of phi_0 .. phi_4.
double worstError(const Matrix& A) {
  const std::vector<Matrix> value = phiFunctions(A, kMaxPhi);
  const std::vector<QuadMatrix> expected = reference(QuadMatrix(A));
  double worst = 0.0;
  for (int k = 0; k <= kMaxPhi; ++k) worst = std::max(worst, relativeError(value[k], expected[k]));
  return worst;
}

// ------------------------------------------------------------------------------------------------------- test matrices

Matrix randomOrthogonal(int n, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Matrix G(n, n);
  for (Index i = 0; i < G.size(); ++i) G.data()[i] = normal(random);
  return Eigen::HouseholderQR<Matrix>(G).householderQ();
}

/// Blocks [[-d, w], [-w, -d]], w and d log-uniform down to 1e-3 of `norm`, in a random orthogonal basis.
Matrix normalMatrix(int n, double norm, double damping, std::mt19937& random) {
  std::uniform_real_distribution<double> decade(-3.0, 0.0);
  Matrix A = Matrix::Zero(n, n);
  for (int i = 0; i < n; i += 2) {
    const double w = i == 0 ? norm : norm * std::pow(10.0, decade(random));
    const double d = damping * norm * std::pow(10.0, decade(random));
    A.block<2, 2>(i, i) << -d, w, -w, -d;
  }
  const Matrix Q = randomOrthogonal(n, random);
  return Q * A * Q.transpose();
}

/// A cantilever of `elements` Hermite elements (deflection [m], slope [rad]), 6.5 m long, scaled to a largest frequency of 6e5 1/s.
struct Beam {
  Matrix K;  // M^-1 K (n x n) [1/s^2], mixed units
  Matrix S;  // [[0, I], [-K, -beta K]] (2n x 2n)
  Matrix energy;  // upper triangular, |energy (q, q')|^2 = q' stiffness q + q'^T mass q' (2n x 2n)
};
Beam beam(int elements, double beta) {
  const int n = 2 * elements;
  const double l = 6.5 / elements;
  Eigen::Matrix4d k, m;
  k << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l, 2 * l * l, -6 * l, 4 * l * l;
  m << 156, 22 * l, 54, -13 * l, 22 * l, 4 * l * l, 13 * l, -3 * l * l, 54, 13 * l, 156, -22 * l, -13 * l, -3 * l * l, -22 * l, 4 * l * l;
  Matrix stiffness = Matrix::Zero(n + 2, n + 2), mass = stiffness;
  for (int e = 0; e < elements; ++e) {
    stiffness.block<4, 4>(2 * e, 2 * e) += k / (l * l * l);
    mass.block<4, 4>(2 * e, 2 * e) += m * (l / 420);
  }
  Matrix K = mass.bottomRightCorner(n, n).llt().solve(stiffness.bottomRightCorner(n, n));
  const double stretch = 3.6e11 / K.eigenvalues().cwiseAbs().maxCoeff();
  K *= stretch;
  Beam result = {K, Matrix::Zero(2 * n, 2 * n), Matrix::Zero(2 * n, 2 * n)};
  result.energy.topLeftCorner(n, n) = (stretch * stiffness.bottomRightCorner(n, n)).llt().matrixU();
  result.energy.bottomRightCorner(n, n) = mass.bottomRightCorner(n, n).llt().matrixU();
  result.S.topRightCorner(n, n).setIdentity();
  result.S.bottomLeftCorner(n, n) = -K;
  result.S.bottomRightCorner(n, n) = -beta * K;
  return result;
}

// --------------------------------------------------------------------------------------------------------------- numbers

TEST(ScalarPhi, equalsQuadrupleReferenceToRounding) {
  double worst = 0.0;
  for (double size : {0.0, 1e-300, 1e-12, 1e-3, 0.5, 1.0, 1.9999, 2.0, 2.0001, 3.0, 10.0, 50.0, 300.0, 700.0})
    for (double z : {size, -size}) {
      Matrix A(1, 1);
      A << z;
      const std::vector<QuadMatrix> expected = reference(QuadMatrix(A));
      for (int k = 0; k <= kMaxPhi; ++k) {
        Matrix value(1, 1);
        value << phi(k, z);
        worst = std::max(worst, relativeError(value, expected[k]));
      }
    }
  std::printf("scalar phi_0..phi_4, |z| <= 700: worst relative error %.1e\n", worst);
  EXPECT_LE(worst, 2 * std::numeric_limits<double>::epsilon());  // computed in long double, rounded once
}

TEST(ScalarPhi, tendsToOneOverKFactorialAtZeroAndToZeroAtMinusInfinity) {
  EXPECT_EQ(phi(0, 0.0), 1.0);
  EXPECT_EQ(phi(1, 0.0), 1.0);
  EXPECT_EQ(phi(2, 0.0), 0.5);
  EXPECT_EQ(phi(3, 0.0), 1.0 / 6);
  EXPECT_EQ(phi(4, 0.0), 1.0 / 24);
  EXPECT_EQ(phi(0, -1e300), 0.0);
  for (int k = 1; k <= kMaxPhi; ++k) EXPECT_NEAR(phi(k, -1e15) * 1e15 * std::tgamma(k), 1.0, 1e-14);  // 1/((k-1)! |z|) (1 + O(1/z))
}

TEST(ScalarPhi, refusesKOutOfRange) {
  EXPECT_THROW(phi(-1, 1.0), std::invalid_argument);
  EXPECT_THROW(phi(kMaxPhi + 1, 1.0), std::invalid_argument);
}

// -------------------------------------------------------------------------------------------------------------- matrices

TEST(PhiFunctions, normalMatricesUpToNorm1000AreGoodTo1em13) {
  std::mt19937 random(1);
  double worst = 0.0;
  for (double norm : {1e-3, 1.0, 30.0, 1000.0})
    for (double damping : {0.0, 0.01, 1.0}) worst = std::max(worst, worstError(normalMatrix(16, norm, damping, random)));
  std::printf("dense phi, normal matrices: worst relative error %.1e\n", worst);
  EXPECT_LE(worst, 1e-13);
}

TEST(PhiFunctions, dissipativeMatricesOfMixedEntriesAreGoodTo1em13) {
  // Symmetric negative definite plus a skew part that does not commute with it; eigenvalues over six decades.
  std::mt19937 random(2);
  std::uniform_real_distribution<double> decade(-6.0, 0.0);
  double worst = 0.0;
  for (double norm : {1.0, 30.0, 1000.0}) {
    const int n = 16;
    const Matrix Q = randomOrthogonal(n, random);
    Vector lambda(n);
    for (int i = 0; i < n; ++i) lambda[i] = -norm * std::pow(10.0, decade(random));
    const Matrix A = Q * lambda.asDiagonal() * Q.transpose() + 0.3 * normalMatrix(n, norm, 0.0, random);
    worst = std::max(worst, worstError(A));
  }
  std::printf("dense phi, dissipative non-normal matrices: worst relative error %.1e\n", worst);
  EXPECT_LE(worst, 1e-13);
}

TEST(PhiFunctions, mixedUnitsAreGoodTo1em13InBalancedCoordinates) {
  // The same oscillators with states in units from 1e-8 to 1e8: the norm rises to 1e18, balancing finds back.
  std::mt19937 random(3);
  double worst = 0.0;
  for (double norm : {1.0, 1000.0}) {
    const int n = 12;
    Matrix A = normalMatrix(n, norm, 0.01, random);
    Vector unit(n);
    for (int i = 0; i < n; ++i) unit[i] = std::pow(10.0, (i % 5) * 4.0 - 8.0);
    A = unit.asDiagonal() * A * unit.cwiseInverse().asDiagonal();
    const std::vector<Matrix> value = phiFunctions(A, kMaxPhi);
    const std::vector<QuadMatrix> expected = reference(QuadMatrix(A));
    for (int k = 0; k <= kMaxPhi; ++k) worst = std::max(worst, relativeError(value[k], expected[k], unit.cwiseInverse()));
  }
  std::printf("dense phi, mixed units: worst relative error %.1e\n", worst);
  EXPECT_LE(worst, 1e-13);
}

TEST(PhiFunctions, nilpotentAndTriangularMatricesAreExact) {
  // Nilpotent of index 3 with huge entries: phi_k = I/k! + A/(k+1)! + A^2/(k+2)!, no halving may spoil it.
  Matrix A = Matrix::Zero(3, 3);
  A(0, 1) = 1e8;
  A(1, 2) = -3e-5;
  const std::vector<Matrix> value = phiFunctions(A, kMaxPhi);
  for (int k = 0; k <= kMaxPhi; ++k) {
    const Matrix expected = Matrix::Identity(3, 3) / std::tgamma(k + 1) + A / std::tgamma(k + 2) + A * A / std::tgamma(k + 3);
    for (Index i = 0; i < A.size(); ++i) EXPECT_NEAR(value[k].data()[i], expected.data()[i], 1e-15 * std::abs(expected.data()[i]));
  }
  Matrix triangular(2, 2);
  triangular << -1.0, 1e6, 0.0, -2.0;
  EXPECT_LE(worstError(triangular), 1e-15);
}

TEST(PhiFunctions, beamMatrixOfNorm1e12KeepsTheMeasuredAccuracy) {
  for (double beta : {0.0, 1e-6}) {
    const Beam b = beam(8, beta);
    const auto inEnergy = [&](const Matrix& P) -> Matrix {  // energy P energy^-1
      return b.energy.transpose().triangularView<Eigen::Lower>().solve((b.energy * P).transpose()).transpose();
    };
    for (double h : {1e-3, 1.4e-4, 1e-6}) {
      const Matrix A = h * b.S;
      const std::vector<Matrix> value = phiFunctions(A, 3);
      const std::vector<QuadMatrix> expected = reference(QuadMatrix(A));
      const double norm = b.S.cwiseAbs().colwise().sum().maxCoeff();
      std::printf("dense phi, beam, ||S||_1 = %.1e, h = %.1e, beta = %.0e, error (q, q') | energy:", norm, h, beta);
      for (int k = 0; k <= 3; ++k) {
        const double plain = relativeError(value[k], expected[k]);
        Matrix difference(A.rows(), A.cols());
        for (Index i = 0; i < A.size(); ++i) difference.data()[i] = static_cast<double>(value[k].data()[i] - expected[k].entry[i]);
        const double energy = inEnergy(difference).norm() / inEnergy(value[k]).norm();
        std::printf("  phi_%d %.0e | %.0e", k, plain, energy);
        EXPECT_LE(plain, 5e-15) << "phi_" << k << ", h = " << h;    // measured 1e-15
        EXPECT_LE(energy, 2e-14) << "phi_" << k << ", h = " << h;   // measured 3e-15, built without FMA (other last bits in K) 5e-15
      }
      std::printf("\n");
    }
  }
}

TEST(PhiFunctions, fastDecayLeavesTheDigitsOfSlowStates) {
  // Thirty halvings: 1 - 3e-10 squared thirty times would cost the slow state nine digits.
  Matrix A(2, 2);
  A << -1e9, 1e3, 0.0, -1.0 / 3;
  const std::vector<Matrix> value = phiFunctions(A, kMaxPhi);
  const std::vector<QuadMatrix> expected = reference(QuadMatrix(A));
  for (int k = 0; k <= kMaxPhi; ++k) {
    EXPECT_NEAR(value[k](1, 1), static_cast<double>(expected[k](1, 1)), 1e-15) << "phi_" << k;
    EXPECT_LE(relativeError(value[k], expected[k]), 1e-15) << "phi_" << k;
  }
}

TEST(PhiFunctions, allStatesDecayedIsStillRelativelyExact) {
  // e^A = 1e-130: e^A - I alone would be -I and the rest noise.
  std::mt19937 random(5);
  Vector lambda(8);
  for (int i = 0; i < 8; ++i) lambda[i] = -300.0 - 20.0 * i;
  const Matrix Q = randomOrthogonal(8, random);
  EXPECT_LE(worstError(Q * lambda.asDiagonal() * Q.transpose()), 1e-13);
}

TEST(PhiFunctions, refuseWhatTheyCannotCompute) {
  EXPECT_THROW(phiFunctions(Matrix::Zero(2, 3), 1), std::invalid_argument);
  EXPECT_THROW(phiFunctions(Matrix::Constant(2, 2, std::nan("")), 1), std::invalid_argument);
  EXPECT_THROW(phiFunctions(Matrix::Identity(2, 2), kMaxPhi + 1), std::invalid_argument);
  EXPECT_THROW(phiFunctions(Matrix::Identity(2, 2) * 1e6, 1), std::overflow_error);
  EXPECT_EQ(phiFunctions(Matrix(0, 0), 2).size(), 3u);
}

TEST(Balancing, takesFiveDecadesOffABeamMatrixAndIsPowersOfTwo) {
  const Beam b = beam(8, 0.0);
  const Vector d = balancingScales(b.S);
  const Matrix balanced = d.cwiseInverse().asDiagonal() * b.S * d.asDiagonal();
  EXPECT_LE(balanced.cwiseAbs().colwise().sum().maxCoeff(), 1e-5 * b.S.cwiseAbs().colwise().sum().maxCoeff());
  int exponent;
  for (double scale : d) EXPECT_EQ(std::frexp(scale, &exponent), 0.5);
}

// ------------------------------------------------------------------------------------------------------------ oscillators

/// Energy-norm error of ModalPhi, worst k; the reference is the 2 x 2 block in energy coordinates built in quadruple precision.
double modalError(double omega, double damping, double h) {
  const ModalPhi value(omega, damping, h);
  QuadMatrix energy(2);
  energy(0, 1) = Quad(h) * omega;
  energy(1, 0) = -energy(0, 1);
  energy(1, 1) = -Quad(h) * damping;
  const std::vector<QuadMatrix> expected = reference(energy);
  double worst = 0.0;
  for (int k = 0; k <= kMaxPhi; ++k) {
    // To energy coordinates: (q, q') -> (omega q, q').
    QuadMatrix difference = expected[k];
    difference(0, 0) -= value[k](0, 0);
    difference(1, 0) -= value[k](1, 0) / Quad(omega);
    difference(0, 1) -= value[k](0, 1) * Quad(omega);
    difference(1, 1) -= value[k](1, 1);
    const double size = frobenius(expected[k]);
    // Below 1e-290 double has no digits left: the value must be that small, too.
    worst = std::max(worst, frobenius(difference) / std::max(size, 1e-290));
  }
  return worst;
}

TEST(ModalPhi, isGoodTo1em12InTheEnergyNormForAllFrequenciesAndDampings) {
  const double h = 1.0 / 2571;  // 360 steps per revolution at 44.9 rad/s: not a power of two
  double worst = 0.0, worst_a = 0.0, worst_zeta = 0.0;
  const auto probe = [&](double a, double zeta) {
    const double omega = a / h;
    const double error = modalError(omega, 2 * zeta * omega, h);
    EXPECT_LE(error, 1e-12) << "h omega = " << a << ", zeta = " << zeta;
    if (!(error <= worst)) worst = error, worst_a = a, worst_zeta = zeta;
  };
  std::vector<double> zetas = {0.0};
  for (double e = -8.0; e <= 4.0; e += 0.5) zetas.push_back(std::pow(10.0, e));
  for (double e = -12.0; e <= -1.0; e += 1.0)
    for (double sign : {1.0, -1.0}) zetas.push_back(1.0 + sign * std::pow(10.0, e));
  zetas.push_back(1.0);
  for (double e = -12.0; e <= std::log10(6e3) + 1e-9; e += (std::log10(6e3) + 12.0) / 60)
    for (double zeta : zetas) probe(std::pow(10.0, e), zeta);

  // Both sides of the branch limits: max(a, s) = 1.5 and rho = 1.
  for (double offset : {-1e-3, -1e-9, 0.0, 1e-9, 1e-3})
    for (double zeta : {0.1, 0.9, 1.0, 1.1, 2.0, 100.0}) {
      probe((1.5 + offset) / std::max(1.0, zeta), zeta);
      if (zeta > 1.0) probe((1.0 + offset) / std::sqrt(zeta * zeta - 1.0), zeta);
    }

  std::mt19937 random(4);
  std::uniform_real_distribution<double> frequency(-12.0, std::log10(6e3)), damping(-6.0, 4.0);
  for (int i = 0; i < 3000; ++i) probe(std::pow(10.0, frequency(random)), std::pow(10.0, damping(random)));
  std::printf("modal phi_0..phi_4: worst energy-norm error %.1e at h omega = %.3g, zeta = %.13g\n", worst, worst_a, worst_zeta);
}

TEST(ModalPhi, atZeroFrequencyIsTheFreeMassWithOrWithoutDamper) {
  for (double damping : {0.0, 1e-10, 1.0, 1e3, 1e9}) {
    const double h = 0.01;
    const ModalPhi value(0.0, damping, h);
    Matrix A(2, 2);
    A << 0.0, h, 0.0, -h * damping;
    const std::vector<QuadMatrix> expected = reference(QuadMatrix(A));
    for (int k = 0; k <= kMaxPhi; ++k)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)  // entry by entry: the position must not hide an error of the velocity
          EXPECT_NEAR(value[k](i, j), static_cast<double>(expected[k](i, j)), 1e-15 * std::abs(static_cast<double>(expected[k](i, j))) + 1e-300)
              << "phi_" << k << "(" << i << ", " << j << "), damping = " << damping;
  }
}

TEST(ModalPhi, tendsToZeroFrequencyWithoutAJump) {
  const ModalPhi zero(0.0, 0.3, 0.1), nearly(1e-9, 0.3, 0.1);
  for (int k = 0; k <= kMaxPhi; ++k) EXPECT_LE((zero[k] - nearly[k]).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(ModalPhi, staysFiniteWhenTheDampingIsHuge) {
  for (double damping : {1e6, 1e12, 1e100, 1e300})
    for (double omega : {0.0, 1e-3, 1.0, 1e5, 1e12}) {
      const ModalPhi value(omega, damping, 1e-2);
      for (int k = 0; k <= kMaxPhi; ++k) EXPECT_TRUE(value[k].allFinite()) << "omega = " << omega << ", damping = " << damping;
    }
}

TEST(ModalPhi, equalsTheDenseFunctionOfTheSameMatrix) {
  // Well scaled (omega near 1), so that norms in (q, q') mean something; 1e-14: two roundings to double of results good to 1e-15.
  for (double omega : {0.5, 1.0, 2.0})
    for (double zeta : {0.0, 0.3, 1.0, 3.0})
      for (double h : {0.1, 1.0, 10.0, 100.0}) {
        Matrix N(2, 2);
        N << 0.0, 1.0, -omega * omega, -2 * zeta * omega;
        const std::vector<Matrix> dense = phiFunctions(h * N, kMaxPhi);
        const ModalPhi modal(omega, 2 * zeta * omega, h);
        for (int k = 0; k <= kMaxPhi; ++k)
          EXPECT_LE((dense[k] - modal[k]).norm(), 1e-14 * dense[k].norm() + 1e-300) << "h = " << h << ", zeta = " << zeta;
      }
}

TEST(ModalPhi, refusesNegativeAndNonFiniteArguments) {
  EXPECT_THROW(ModalPhi(-1.0, 0.0, 0.1), std::invalid_argument);
  EXPECT_THROW(ModalPhi(1.0, -0.1, 0.1), std::invalid_argument);
  EXPECT_THROW(ModalPhi(1.0, 0.1, 0.0), std::invalid_argument);
  EXPECT_THROW(ModalPhi(std::nan(""), 0.1, 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace heerk_rotor
