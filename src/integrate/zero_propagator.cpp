#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "heerk_rotor/integrate/phi_functions.hpp"
#include "propagator_kinds.hpp"

namespace heerk_rotor {
namespace {

/// S = 0: phi_k = 1/k!, so a row is x plus a weighted sum of remainders, the classical Runge-Kutta method.
class ZeroPropagator final : public LinearPropagator {
 public:
  ZeroPropagator(Index size, double h, const Tableau& tableau) : size_(size) {
    for (int row = 0; row <= tableau.stages(); ++row) {
      const int begin = static_cast<int>(terms_.size());
      for (int column = 0; column < row; ++column) {
        const double weight = classicalWeight(tableau.rows[row][column]);
        if (weight != 0.0) terms_.push_back({h * weight, column});
      }
      rows_.push_back({begin, static_cast<int>(terms_.size())});
    }
  }

  void combine(int row, const double* x, const double* remainders, Index stride, double* result) const noexcept override {
    const Term* term = terms_.data() + rows_[row].begin;
    int left = rows_[row].end - rows_[row].begin;
    if (left == 0) {
      std::memcpy(result, x, sizeof(double) * static_cast<std::size_t>(size_));
      return;
    }
    // All terms of a row in one pass; five and more (no known method) in several.
    const double* base = x;
    while (left > 0) {
      const int now = left < 4 ? left : 4;
      switch (now) {
        case 1: add<1>(base, term, remainders, stride, result); break;
        case 2: add<2>(base, term, remainders, stride, result); break;
        case 3: add<3>(base, term, remainders, stride, result); break;
        default: add<4>(base, term, remainders, stride, result); break;
      }
      base = result;
      term += now;
      left -= now;
    }
  }

  void propagate(int, const double* x, double* result) const noexcept override { std::copy_n(x, size_, result); }

 private:
  struct Term {
    double weight;
    int column;
  };
  struct Row {
    int begin;
    int end;
  };

  /// Weights that cancel at z = 0 (a_41 of HEERK4 is phi_1 - 2 phi_2) are structural zeros of the classical method: 1e-14 of their parts is rounding.
  static double classicalWeight(const Coefficient& coefficient) {
    long double sum = 0, size = 0;
    for (const PhiTerm& term : coefficient) {
      const long double value = term.weight / std::tgamma(static_cast<long double>(term.k + 1));
      sum += value;
      size += std::abs(value);
    }
    return std::abs(sum) <= 1e-14L * size ? 0.0 : static_cast<double>(sum);
  }

  template <int N>
  void add(const double* base, const Term* term, const double* remainders, Index stride, double* result) const noexcept {
    double weight[N];
    const double* source[N];
    for (int t = 0; t < N; ++t) {
      weight[t] = term[t].weight;
      source[t] = remainders + term[t].column * stride;
    }
    // base == result is harmless: each piece is read before it is written.
    using Lanes = Eigen::Array<double, 4, 1>;
    Index i = 0;
    for (; i + 4 <= size_; i += 4) {
      Lanes sum = Eigen::Map<const Lanes>(base + i);
      for (int t = 0; t < N; ++t) sum += weight[t] * Eigen::Map<const Lanes>(source[t] + i);
      Eigen::Map<Lanes>(result + i) = sum;
    }
#pragma GCC unroll 1
    for (; i < size_; ++i) {
      double sum = base[i];
      for (int t = 0; t < N; ++t) sum += weight[t] * source[t][i];
      result[i] = sum;
    }
  }

  Index size_;
  std::vector<Term> terms_;
  std::vector<Row> rows_;  // (stages + 1)
};

}  // namespace

std::unique_ptr<LinearPropagator> makeZeroPropagator(Index size, double h, const Tableau& tableau) {
  return std::make_unique<ZeroPropagator>(size, h, tableau);
}

}  // namespace heerk_rotor
