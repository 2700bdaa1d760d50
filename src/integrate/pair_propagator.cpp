#include <algorithm>
#include <array>
#include <complex>
#include <map>
#include <utility>
#include <vector>

#include "heerk_rotor/integrate/phi_functions.hpp"
#include "propagator_kinds.hpp"

namespace heerk_rotor {
namespace {

/// Many independent 2 x 2 blocks: states are all first coordinates, then all second ones.
class PairPropagator final : public LinearPropagator {
 public:
  /// blocks[entry][pair]; on_rates: remainders' first coordinates are zero.
  PairPropagator(RowPlan plan, const std::vector<std::vector<Eigen::Matrix2d>>& blocks, bool on_rates)
      : plan_(std::move(plan)), on_rates_(on_rates), pairs_(static_cast<Index>(blocks[0].size())), pitch_((pairs_ + kLine - 1) / kLine * kLine) {
    table_.setZero(4 * pitch_ * static_cast<Index>(blocks.size()));
    double* to = table_.data();
    for (const auto& entry : blocks)
      for (const auto& [row, column] : {std::pair(0, 0), std::pair(0, 1), std::pair(1, 0), std::pair(1, 1)}) {
        for (Index pair = 0; pair < pairs_; ++pair) to[pair] = entry[pair](row, column);
        to += pitch_;
      }
  }

  void combine(int row, const double* x, const double* remainders, Index stride, double* result) const noexcept override {
    if (on_rates_) apply<true>(plan_.rows[row], {x, remainders, stride}, result);
    else apply<false>(plan_.rows[row], {x, remainders, stride}, result);
  }

  void propagate(int row, const double* x, double* result) const noexcept override { apply<false>(plan_.stateOf(row), {x, nullptr, 0}, result); }

 private:
  template <bool on_rates>
  void apply(RowPlan::Row range, const RowPlan::Columns& from, double* result) const noexcept {
    if (range.begin == range.end) {
      std::copy_n(from.x, 2 * pairs_, result);
      return;
    }
    Index pair = 0;
    for (; pair + kLanes <= pairs_; pair += kLanes) combineLanes<kLanes, on_rates>(range, from, pair, result);
    for (; pair + 8 <= pairs_; pair += 8) combineLanes<8, on_rates>(range, from, pair, result);
    // What is left as one block that reaches back over finished pairs, which get the same values again.
    if (pairs_ - pair > 4 && pairs_ >= 8) return combineLanes<8, on_rates>(range, from, pairs_ - 8, result);
    for (; pair + 4 <= pairs_; pair += 4) combineLanes<4, on_rates>(range, from, pair, result);
    if (pairs_ - pair > 0 && pairs_ >= 4) return combineLanes<4, on_rates>(range, from, pairs_ - 4, result);
    for (; pair < pairs_; ++pair) combineLanes<1, on_rates>(range, from, pair, result);
  }

  static constexpr Index kLine = 8;  // doubles per cache line: a load must not straddle two
  static constexpr int kLanes = 16;  // two AVX-512 or four AVX registers per sum: enough independent chains to hide the latency

  /// N neighbouring pairs: the sums stay in registers over all products of the row.
  template <int N, bool on_rates>
  void combineLanes(RowPlan::Row range, const RowPlan::Columns& from, Index pair, double* __restrict result) const noexcept {
    using Lanes = Eigen::Array<double, N, 1>;
    using Load = Eigen::Map<const Lanes>;
    // The first product of a row propagates the state alone. Beginning with it instead of with zeros keeps the sums in registers.
    const double* c = table_.data() + 4 * pitch_ * plan_.products[range.begin].entry + pair;
    const double* x = from.first(plan_.products[range.begin]) + pair;
    Lanes q = Load(c) * Load(x) + Load(c + pitch_) * Load(x + pairs_);
    Lanes v = Load(c + 2 * pitch_) * Load(x) + Load(c + 3 * pitch_) * Load(x + pairs_);
    for (int p = range.begin + 1; p < range.end; ++p) {
      const RowPlan::Product& product = plan_.products[p];
      const double *a = from.first(product) + pair, *b = from.second(product);
      c = table_.data() + 4 * pitch_ * product.entry + pair;
      Lanes a_v = Load(a + pairs_);
      if (b) a_v += Load(b + pairs_ + pair);
      if constexpr (on_rates) {
        q += Load(c + pitch_) * a_v;
        v += Load(c + 3 * pitch_) * a_v;
        continue;
      }
      Lanes a_q = Load(a);
      if (b) a_q += Load(b + pair);
      q += Load(c) * a_q + Load(c + pitch_) * a_v;
      v += Load(c + 2 * pitch_) * a_q + Load(c + 3 * pitch_) * a_v;
    }
    Eigen::Map<Lanes>(result + pair) = q;
    Eigen::Map<Lanes>(result + pairs_ + pair) = v;
  }

  RowPlan plan_;
  bool on_rates_;
  Index pairs_;
  Index pitch_;   // pairs_ rounded up to whole cache lines
  Vector table_;  // [entry][qq, qv, vq, vv][pair, padded to pitch_], aligned by Eigen
};

/// Tabulates weight * phi_k(node h S) summed over the terms of each entry. `makePhi(pair, node)` returns the phi_k of one block: an object with [k].
template <typename MakePhi>
std::unique_ptr<LinearPropagator> fromPairs(Index pairs, double h, const Tableau& tableau, const MakePhi& makePhi, bool on_rates = false) {
  RowPlan plan(tableau);
  std::vector<std::vector<Eigen::Matrix2d>> blocks(plan.entries.size());
  for (Index i = 0; i < pairs; ++i) {
    std::map<double, decltype(makePhi(i, h))> phi;  // node -> phi_k(node h S) of this pair
    for (std::size_t e = 0; e < plan.entries.size(); ++e) {
      Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
      for (const PhiTerm& term : plan.entries[e].terms) {
        auto known = phi.find(term.node);
        if (known == phi.end()) known = phi.emplace(term.node, makePhi(i, term.node)).first;
        sum += term.weight * known->second[term.k];
      }
      if (plan.entries[e].times_h) sum *= h;
      blocks[e].push_back(sum);
    }
  }

  // A single pair is a 2 x 2 matrix, and that path has less to set up.
  if (pairs == 1) {
    std::vector<Matrix> matrices;
    for (const auto& entry : blocks) matrices.push_back(entry[0]);
    return makeMatrixPropagator(std::move(plan), matrices);
  }
  return std::make_unique<PairPropagator>(std::move(plan), blocks, on_rates);
}

/// phi_0 .. phi_4 of z B, B one block of a PairStiff.
std::array<Eigen::Matrix2d, kMaxPhi + 1> phiOfBlock(const Eigen::Matrix2d& block, double z) {
  std::array<Eigen::Matrix2d, kMaxPhi + 1> result;
  for (int k = 0; k <= kMaxPhi; ++k) {
    if (block(0, 1) == 0.0) {
      result[k] << phi(k, z * block(0, 0)), 0.0, 0.0, phi(k, z * block(1, 1));
    } else {
      const std::complex<double> value = phi(k, z * std::complex<double>(block(0, 0), block(0, 1)));
      result[k] << value.real(), value.imag(), -value.imag(), value.real();
    }
  }
  return result;
}

}  // namespace

std::unique_ptr<LinearPropagator> makeModalPropagator(const ModalStiff& part, double h, const Tableau& tableau) {
  return fromPairs(part.omega.size(), h, tableau, [&part, h](Index i, double node) { return ModalPhi(part.omega[i], part.damping[i], node * h); }, part.remainder_on_rates);
}

std::unique_ptr<LinearPropagator> makePairPropagator(const PairStiff& part, double h, const Tableau& tableau) {
  return fromPairs(static_cast<Index>(part.blocks.size()), h, tableau,
                   [&part, h](Index i, double node) { return phiOfBlock(part.blocks[static_cast<std::size_t>(i)], node * h); });
}

}  // namespace heerk_rotor
