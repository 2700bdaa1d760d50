#include "heerk_rotor/integrate/phi_functions.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace heerk_rotor {
namespace {

using Real = long double;
using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// Degree of the Taylor polynomial of phi_kmax for scaled matrices (|z| <= 1): 1/21! = 2e-20, below the rounding of long double.
constexpr int kMatrixDegree = 20;
/// The same for scalars and oscillators, |z| <= 3: 3^32/32! = 7e-21, and more is free there.
constexpr int kScalarDegree = 40;

Real inverseFactorial(int n) {
  static const auto table = [] {
    std::array<Real, kScalarDegree + kMaxPhi + 1> t{};
    Real factorial = 1;
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (i > 0) factorial *= static_cast<Real>(i);
      t[i] = 1 / factorial;
    }
    return t;
  }();
  return table[n];
}

// ---------------------------------------------------------------------------------------------------------------- numbers

Real expMinusOne(Real z) { return std::expm1(z); }
std::complex<Real> expMinusOne(std::complex<Real> z) { return std::exp(z) - Real(1); }  // called with |z| > 2 only

/// Number: Real or std::complex<Real>.
template <typename Number>
Number phiNumber(int k, Number z) {
  if (k == 0) return std::exp(z);
  if (std::abs(z) <= 2) {
    Number sum = 0;
    for (int i = kScalarDegree; i >= 0; --i) sum = sum * z + inverseFactorial(i + k);
    return sum;
  }
  Number value = expMinusOne(z) / z;
  for (int j = 1; j < k; ++j) value = (value - inverseFactorial(j)) / z;
  return value;
}

// ---------------------------------------------------------------------------------------------------------------- matrices

Real norm1(const RealMatrix& A) { return A.cwiseAbs().colwise().sum().maxCoeff(); }

/// Number of halvings after which ||z^i|| <= 1 for all i >= 6, from the powers A .. A^4.
int halvings(const std::array<RealMatrix, 4>& power) {
  const Real d2 = std::sqrt(norm1(power[1]));
  const Real d3 = std::cbrt(norm1(power[2]));
  const Real d4 = std::sqrt(std::sqrt(norm1(power[3])));
  const Real alpha = std::min(std::max(d2, d3), std::max(d3, d4));
  return alpha > 1 ? static_cast<int>(std::ceil(std::log2(alpha))) : 0;
}

/// Taylor polynomial of phi_k by Paterson & Stockmeyer: blocks of four powers, Horner in z^4.
RealMatrix taylor(const std::array<RealMatrix, 4>& power, int k) {
  const Index n = power[0].rows();
  RealMatrix sum = inverseFactorial(kMatrixDegree + k) * RealMatrix::Identity(n, n);
  RealMatrix next(n, n);
  for (int i = kMatrixDegree - 4; i >= 0; i -= 4) {
    next.noalias() = sum * power[3];
    sum = next;
    for (int j = 1; j < 4; ++j) sum += inverseFactorial(i + j + k) * power[j - 1];
    sum.diagonal().array() += inverseFactorial(i + k);
  }
  return sum;
}

/// All phi_k of a matrix, k = 0..kmax, while it is doubled.
struct PhiSet {
  std::vector<RealMatrix> phi;  // phi[0] is e^z - I as long as `shifted`
  /// 1 + 1e-9 has lost nine digits of a slow state before the first squaring. Keeping e^z - I until every state has decayed (then, and
  /// only then, e^z itself is small) is the idea of precise integration (Zhong & Williams, Proc. IMechE C 208 (1994) 427).
  bool shifted = true;

  /// phi_k(2z) = 2^-k (phi_0(z) phi_k(z) + sum_{j=1..k} phi_j(z) / (k - j)!)
  void doubleArgument() {
    RealMatrix next(phi[0].rows(), phi[0].cols());
    for (int k = static_cast<int>(phi.size()) - 1; k >= 1; --k) {  // downwards: phi_j, j < k, must still belong to z
      next.noalias() = phi[0] * phi[k];
      if (shifted) next += phi[k];
      for (int j = 1; j <= k; ++j) next += inverseFactorial(k - j) * phi[j];
      phi[k] = std::ldexp(Real(1), -k) * next;
    }
    next.noalias() = phi[0] * phi[0];
    if (shifted) next += 2 * phi[0];
    phi[0].swap(next);
    if (shifted) {
      next = phi[0];
      next.diagonal().array() += 1;
      if (norm1(next) <= Real(0.5)) unshift();
    }
  }

  void unshift() {
    if (shifted) phi[0].diagonal().array() += 1;
    shifted = false;
  }
};

// -------------------------------------------------------------------------------------------------------------- oscillators

/// Coefficients of F0 I + F1 M, M^2 = rho I.
struct Pair {
  Real f0;
  Real f1;
};

/// One oscillator over one step, h N = -s I + M.
struct Oscillator {
  Real a;    // h omega
  Real s;    // h damping / 2
  Real rho;  // s^2 - a^2, without cancelling squares

  /// (F0, F1) -> (F0, F1) h N
  Pair timesN(Pair f) const { return {-s * f.f0 + rho * f.f1, f.f0 - s * f.f1}; }

  std::array<Pair, kMaxPhi + 1> byTaylor() const {
    std::array<Pair, kMaxPhi + 1> f;
    Pair sum = {0, 0};
    for (int i = kScalarDegree; i >= 0; --i) {
      sum = timesN(sum);
      sum.f0 += inverseFactorial(i + kMaxPhi);
    }
    f[kMaxPhi] = sum;
    for (int k = kMaxPhi - 1; k >= 0; --k) {
      f[k] = timesN(f[k + 1]);
      f[k].f0 += inverseFactorial(k);
    }
    return f;
  }

  /// (h N)^-1 = -(s I + M) / a^2 is exact here and harmless: max(a, s) > 1.5 and rho <= 1 leave a > 1.1.
  std::array<Pair, kMaxPhi + 1> byRecurrence() const {
    std::array<Pair, kMaxPhi + 1> f;
    const Real r = std::sqrt(std::abs(rho));
    const Real cosine = rho > 0 ? std::cosh(r) : std::cos(r);
    const Real sinc = r == 0 ? Real(1) : (rho > 0 ? std::sinh(r) : std::sin(r)) / r;
    const Real decay = std::exp(-s);
    f[0] = {decay * cosine, decay * sinc};
    for (int k = 0; k < kMaxPhi; ++k) {
      const Real g0 = f[k].f0 - inverseFactorial(k);
      const Real g1 = f[k].f1;
      f[k + 1] = {-(g0 * s + g1 * rho) / (a * a), -(g0 + g1 * s) / (a * a)};
    }
    return f;
  }
};

Eigen::Matrix2d rounded(Real qq, Real qv, Real vq, Real vv) {
  Eigen::Matrix2d m;
  m << static_cast<double>(qq), static_cast<double>(qv), static_cast<double>(vq), static_cast<double>(vv);
  return m;
}

}  // namespace

double phi(int k, double z) {
  if (k < 0 || k > kMaxPhi) throw std::invalid_argument("phi: k = " + std::to_string(k) + ", expected 0.." + std::to_string(kMaxPhi));
  return static_cast<double>(phiNumber<Real>(k, z));
}

std::complex<double> phi(int k, std::complex<double> z) {
  if (k < 0 || k > kMaxPhi) throw std::invalid_argument("phi: k = " + std::to_string(k) + ", expected 0.." + std::to_string(kMaxPhi));
  const std::complex<Real> value = phiNumber(k, std::complex<Real>(z.real(), z.imag()));
  return {static_cast<double>(value.real()), static_cast<double>(value.imag())};
}

Vector balancingScales(const Matrix& A) {
  constexpr int kMaxSweeps = 100;       // each sweep gains at least 5 % somewhere; FE matrices need about 10
  constexpr double kWorthwhile = 0.95;  // LAPACK dgebal's threshold
  const Index n = A.rows();
  Matrix B = A;
  Vector d = Vector::Ones(n);
  bool changed = true;
  for (int sweep = 0; changed && sweep < kMaxSweeps; ++sweep) {
    changed = false;
    for (Index i = 0; i < n; ++i) {
      const double column = B.col(i).stableNorm();
      const double row = B.row(i).stableNorm();
      if (column == 0.0 || row == 0.0) continue;
      // Scaling by f makes them column * f and row / f, equal at f = sqrt(row / column).
      const double f = std::exp2(std::round(0.5 * (std::log2(row) - std::log2(column))));
      if (column * f + row / f >= kWorthwhile * (column + row)) continue;
      B.col(i) *= f;
      B.row(i) /= f;
      d[i] *= f;
      changed = true;
    }
  }
  const auto norm = [](const Matrix& M) { return M.cwiseAbs().colwise().sum().maxCoeff(); };
  if (n > 0 && norm(B) < norm(A)) return d;
  return Vector::Ones(n);
}

std::vector<Matrix> phiFunctions(const Matrix& A, int kmax) {
  const Index n = A.rows();
  if (kmax < 0 || kmax > kMaxPhi)
    throw std::invalid_argument("phiFunctions: kmax = " + std::to_string(kmax) + ", expected 0.." + std::to_string(kMaxPhi));
  if (A.cols() != n)
    throw std::invalid_argument("phiFunctions: matrix is " + std::to_string(n) + " x " + std::to_string(A.cols()) + ", expected square");
  if (!A.allFinite()) throw std::invalid_argument("phiFunctions: the matrix has entries that are not finite");
  if (n == 0) return std::vector<Matrix>(kmax + 1, Matrix(0, 0));

  // Balance; multiplying by powers of two is exact.
  const Eigen::Matrix<Real, Eigen::Dynamic, 1> d = balancingScales(A).cast<Real>();
  std::array<RealMatrix, 4> power;
  power[0] = d.cwiseInverse().asDiagonal() * A.cast<Real>() * d.asDiagonal();
  power[1].noalias() = power[0] * power[0];
  power[2].noalias() = power[1] * power[0];
  power[3].noalias() = power[1] * power[1];

  // Scale, series for the highest phi, the others from it downwards, double up again.
  const int halved = halvings(power);
  for (int p = 0; p < 4; ++p) power[p] *= std::ldexp(Real(1), -halved * (p + 1));
  const int highest = std::max(kmax, 1);
  PhiSet set;
  set.phi.resize(highest + 1);
  set.phi[highest] = taylor(power, highest);
  for (int k = highest - 1; k >= 0; --k) {
    set.phi[k].noalias() = power[0] * set.phi[k + 1];
    if (k > 0) set.phi[k].diagonal().array() += inverseFactorial(k);
  }
  for (int i = 0; i < halved; ++i) set.doubleArgument();
  set.unshift();

  // Undo the balancing and round once.
  std::vector<Matrix> result(kmax + 1);
  for (int k = 0; k <= kmax; ++k) {
    result[k] = (d.asDiagonal() * set.phi[k] * d.cwiseInverse().asDiagonal()).cast<double>();
    if (!result[k].allFinite())
      throw std::overflow_error("phiFunctions: phi_" + std::to_string(k) + " overflows; has the matrix large positive eigenvalues?");
  }
  return result;
}

ModalPhi::ModalPhi(double omega, double damping, double h) {
  if (!(omega >= 0 && damping >= 0 && h > 0 && std::isfinite(omega) && std::isfinite(damping) && std::isfinite(h)))
    throw std::invalid_argument("ModalPhi: omega = " + std::to_string(omega) + " rad/s, damping = " + std::to_string(damping) +
                                " 1/s, h = " + std::to_string(h) + " s, expected omega, damping >= 0 and h > 0, all finite");
  const Real H = h;
  const Real a = H * omega;
  const Real s = H * damping / 2;
  const Oscillator oscillator = {a, s, (s - a) * (s + a)};
  const Real omega2 = Real(omega) * omega;

  const bool small = std::max(a, s) <= Real(1.5);
  if (small || oscillator.rho <= 1) {
    const std::array<Pair, kMaxPhi + 1> f = small ? oscillator.byTaylor() : oscillator.byRecurrence();
    for (int k = 0; k <= kMaxPhi; ++k)
      phi_[k] = rounded(f[k].f0 + f[k].f1 * s, f[k].f1 * H, -f[k].f1 * H * omega2, f[k].f0 - f[k].f1 * s);
    return;
  }

  // Two real roots at least 2 apart: phi_k = (phi_k(slow) (hN - fast) - phi_k(fast) (hN - slow)) / (slow - fast).
  const Real root = std::sqrt(oscillator.rho);
  const Real fast = -(s + root);
  const Real slow = a * (a / fast);
  for (int k = 0; k <= kMaxPhi; ++k) {
    const Real p_slow = phiNumber<Real>(k, slow);
    const Real p_fast = phiNumber<Real>(k, fast);
    const Real f1 = (p_slow - p_fast) / (2 * root);
    phi_[k] = rounded((slow * p_fast - fast * p_slow) / (2 * root), f1 * H, -f1 * H * omega2, (slow * p_slow - fast * p_fast) / (2 * root));
  }
}

}  // namespace heerk_rotor
