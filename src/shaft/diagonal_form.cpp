#include "heerk_rotor/shaft/diagonal_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace heerk_rotor {
namespace {

constexpr double kLargestCondition = 1e6;  // leaves ten digits to states and forces
constexpr double kResidual = 1e-14;        // |T B - H T| / (|H| |T|): 1e5 times the round-off of long double

/// Two columns of the solver's real eigenvectors that make one block.
struct Pair {
  Eigen::Index first, second;
  std::complex<ShaftReal> eigenvalue, other;
};

std::vector<Pair> pairsOf(const Eigen::EigenSolver<ShaftMatrix>& solver) {
  const auto& lambda = solver.eigenvalues();
  std::vector<Pair> pairs;
  std::vector<Eigen::Index> real;
  for (Eigen::Index i = 0; i < lambda.size(); ++i) {
    if (lambda[i].imag() == 0) {
      real.push_back(i);
    } else {
      pairs.push_back({i, i + 1, lambda[i], lambda[i + 1]});  // the one with b > 0 comes first
      ++i;
    }
  }
  std::sort(real.begin(), real.end(), [&](Eigen::Index a, Eigen::Index b) { return std::abs(lambda[a]) < std::abs(lambda[b]); });
  for (std::size_t i = 0; i + 1 < real.size(); i += 2) pairs.push_back({real[i], real[i + 1], lambda[real[i]], lambda[real[i + 1]]});
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return std::abs(a.eigenvalue) < std::abs(b.eigenvalue); });
  return pairs;
}

[[noreturn]] void fail(const char* what, double found, double expected) {
  std::ostringstream text;
  text << "diagonalForm: " << what << " is " << found << ", expected at most " << expected
       << ": two eigenvalues are (nearly) equal and share an eigenvector, as at critical damping";
  throw std::runtime_error(text.str());
}

}  // namespace

DiagonalForm diagonalForm(const ShaftMatrix& H) {
  const Eigen::Index n = H.rows(), m = n / 2;
  if (H.cols() != n || n != 2 * m) throw std::invalid_argument("diagonalForm: H is " + std::to_string(n) + " x " + std::to_string(H.cols()) + ", expected square and even");
  const Eigen::EigenSolver<ShaftMatrix> solver(H);
  if (solver.info() != Eigen::Success) throw std::runtime_error("diagonalForm: the QR algorithm did not converge");
  const ShaftMatrix vectors = solver.pseudoEigenvectors();

  DiagonalForm form;
  form.T.resize(n, n);
  ShaftMatrix B = ShaftMatrix::Zero(n, n);
  const std::vector<Pair> pairs = pairsOf(solver);
  for (Eigen::Index i = 0; i < m; ++i) {
    const Pair& pair = pairs[static_cast<std::size_t>(i)];
    const ShaftReal a = pair.eigenvalue.real(), b = pair.eigenvalue.imag();
    ShaftReal first = vectors.col(pair.first).norm(), second = vectors.col(pair.second).norm();
    if (b != 0) first = second = std::hypot(first, second) / std::sqrt(ShaftReal(2));
    form.T.col(i) = vectors.col(pair.first) / first;
    form.T.col(m + i) = vectors.col(pair.second) / second;
    B(i, i) = a;
    B(i, m + i) = b;
    B(m + i, i) = -b;
    B(m + i, m + i) = b != 0 ? a : pair.other.real();
    form.eigenvalues.push_back(pair.eigenvalue);
    Eigen::Matrix2d block;
    block << static_cast<double>(B(i, i)), static_cast<double>(B(i, m + i)), static_cast<double>(B(m + i, i)), static_cast<double>(B(m + i, m + i));
    form.blocks.push_back(block);
  }
  const Eigen::FullPivLU<ShaftMatrix> factor(form.T);
  form.inverse = factor.inverse();  // zeros where there is none
  form.condition = factor.isInvertible() ? static_cast<double>(form.T.norm() * form.inverse.norm()) / static_cast<double>(n) : std::numeric_limits<double>::infinity();
  if (!(form.condition <= kLargestCondition)) fail("the condition of the eigenvectors", form.condition, kLargestCondition);
  const double residual = static_cast<double>((form.T * B - H * form.T).norm() / (H.norm() * form.T.norm()));
  if (!(residual <= kResidual)) fail("the residual of the eigenvectors", residual, kResidual);
  return form;
}

}  // namespace heerk_rotor
