#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "heerk_rotor/integrate/phi_functions.hpp"
#include "propagator_kinds.hpp"

namespace heerk_rotor {
namespace {

/// One n x n matrix per distinct coefficient.
class MatrixPropagator final : public LinearPropagator {
 public:
  MatrixPropagator(RowPlan plan, const std::vector<Matrix>& matrices) : plan_(std::move(plan)), size_(matrices[0].rows()) {
    table_.setZero(lanes() * tiles() * size_ * static_cast<Index>(matrices.size()));
    double* to = table_.data();
    for (const Matrix& matrix : matrices)
      for (Index tile = 0; tile < tiles(); ++tile)
        for (Index j = 0; j < size_; ++j, to += lanes())
          for (Index i = tile * lanes(); i < std::min(size_, (tile + 1) * lanes()); ++i) to[i - tile * lanes()] = matrix(i, j);
  }

  void combine(int row, const double* x, const double* remainders, Index stride, double* result) const noexcept override {
    apply(plan_.rows[row], {x, remainders, stride}, result);
  }

  void propagate(int row, const double* x, double* result) const noexcept override { apply(plan_.stateOf(row), {x, nullptr, 0}, result); }

 private:
  void apply(RowPlan::Row range, const RowPlan::Columns& from, double* result) const noexcept {
    if (range.begin == range.end) {
      std::copy_n(from.x, size_, result);
      return;
    }
    switch (size_) {
      case 1: return combineSmall<1>(range, from, result);
      case 2: return combineSmall<2>(range, from, result);
      case 3: return combineSmall<3>(range, from, result);
      case 4: return combineSmall<4>(range, from, result);
      default: return combineTiles(range, from, result);
    }
  }

  static constexpr Index kSmall = 4;
  static constexpr int kTile = 16;  // rows of a tile: with four columns in flight eight AVX-512 sums, enough to hide the latency of a FMA

  Index lanes() const { return size_ <= kSmall ? size_ : kTile; }
  Index tiles() const { return size_ == 0 ? 0 : (size_ + lanes() - 1) / lanes(); }

  /// Everything in registers.
  template <int N>
  void combineSmall(RowPlan::Row range, const RowPlan::Columns& from, double* __restrict result) const noexcept {
    using Column = Eigen::Array<double, N, 1>;
    Column sum = Column::Zero();
    const RowPlan::Product* const end = plan_.products.data() + range.end;
    for (const RowPlan::Product* product = plan_.products.data() + range.begin; product != end; ++product) {
      // Columns number by number: models have written them so a moment ago.
      const double* const first = from.first(*product);
      const double* const second = from.second(*product);
      const double* const m = table_.data() + N * N * product->entry;
      if (second)
        for (int j = 0; j < N; ++j) sum += Eigen::Map<const Column>(m + N * j) * (first[j] + second[j]);
      else
        for (int j = 0; j < N; ++j) sum += Eigen::Map<const Column>(m + N * j) * first[j];
    }
    Eigen::Map<Column>{result} = sum;
  }

  /// Tile by tile: the table is read once, in order, and the sums stay in registers over all products of the row.
  void combineTiles(RowPlan::Row range, const RowPlan::Columns& from, double* __restrict result) const noexcept {
    using Lanes = Eigen::Array<double, kTile, 1>;
    for (Index tile = 0, row = 0; row < size_; ++tile, row += kTile) {
      Lanes sum[4] = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
      for (int p = range.begin; p < range.end; ++p) {
        const RowPlan::Product& product = plan_.products[p];
        const double* m = table_.data() + (product.entry * tiles() + tile) * size_ * kTile;
        const double* a = from.first(product);
        if (const double* b = from.second(product))
          accumulate(m, [a, b](Index j) { return a[j] + b[j]; }, sum);
        else
          accumulate(m, [a](Index j) { return a[j]; }, sum);
      }
      const Lanes total = (sum[0] + sum[1]) + (sum[2] + sum[3]);
      std::copy_n(total.data(), std::min<Index>(kTile, size_ - row), result + row);
    }
  }

  /// sum += m * column, four columns at a time into sums of their own.
  template <typename Column, typename Lanes>
  void accumulate(const double* m, const Column& column, Lanes* sum) const noexcept {
    using Load = Eigen::Map<const Lanes, Eigen::AlignedMax>;  // tiles are multiples of a cache line
    Index j = 0;
    for (; j + 4 <= size_; j += 4, m += 4 * kTile)
      for (int k = 0; k < 4; ++k) sum[k] += Load(m + k * kTile) * column(j + k);
    for (; j < size_; ++j, m += kTile) sum[0] += Load(m) * column(j);
  }

  RowPlan plan_;
  Index size_;
  Vector table_;  // [entry][tile][column][row in tile], last tile padded with zeros, aligned by Eigen
};

}  // namespace

std::unique_ptr<LinearPropagator> makeMatrixPropagator(RowPlan plan, const std::vector<Matrix>& matrices) {
  return std::make_unique<MatrixPropagator>(std::move(plan), matrices);
}

std::unique_ptr<LinearPropagator> makeDensePropagator(const DenseStiff& part, double h, const Tableau& tableau) {
  RowPlan plan(tableau);
  std::map<double, std::vector<Matrix>> phi;  // node -> phi_0(node h S) ..
  std::vector<Matrix> matrices;
  for (const RowPlan::Entry& entry : plan.entries) {
    Matrix sum = Matrix::Zero(part.S.rows(), part.S.cols());
    for (const PhiTerm& term : entry.terms) {
      std::vector<Matrix>& at_node = phi[term.node];
      if (at_node.empty()) at_node = phiFunctions(term.node * h * part.S, plan.highestK(term.node));
      sum += term.weight * at_node[term.k];
    }
    matrices.push_back(entry.times_h ? Matrix(h * sum) : sum);
  }
  return makeMatrixPropagator(std::move(plan), matrices);
}

}  // namespace heerk_rotor
