#include "heerk_rotor/aero/airfoil_table.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <Eigen/Core>

#include "block_interpolant.hpp"
#include "heerk_rotor/core/branch_free_math.hpp"

namespace heerk_rotor {
namespace {

/// (lift, drag, moment, unused) as one vector register.
using Quad = Eigen::Array4d;

// Inlined by force: a call per lane costs more than the work.
#define HEERK_INLINE __attribute__((always_inline)) inline

HEERK_INLINE Quad load(const double* node) noexcept { return Eigen::Map<const Quad, Eigen::Aligned32>(node); }

/// Between two columns of Mach that lie beside each other, `stride` doubles apart.
HEERK_INLINE Quad acrossMach(const double* node, int stride, double share) noexcept {
  const Quad low = load(node);
  return low + share * (load(node + stride) - low);
}

HEERK_INLINE Quad bilinear(const double* corner, int row, double s, double share) noexcept {
  const Quad left = acrossMach(corner, 4, share), right = acrossMach(corner + row, 4, share);
  return left + s * (right - left);
}

/// Cubic Hermite form in alpha; a node is a value and a slope.
HEERK_INLINE Quad cubic(const double* corner, int row, double s, double width, double share) noexcept {
  const Quad left = acrossMach(corner, 8, share), right = acrossMach(corner + row, 8, share);
  const Quad left_slope = acrossMach(corner + 4, 8, share), right_slope = acrossMach(corner + row + 4, 8, share);
  const double s2 = s * s, rise = s2 * (3.0 - 2.0 * s), s_1 = 1.0 - s;
  return left + rise * (right - left) + (width * s * s_1) * (s_1 * left_slope - s * right_slope);
}

std::vector<double> unite(std::vector<double> grid) {
  std::sort(grid.begin(), grid.end());
  grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
  return grid;
}

}  // namespace

AirfoilTable::AirfoilTable(const C81Deck& deck, TableInterpolation interpolation) : interpolation_(interpolation) { build({&deck}, {1.0}); }

AirfoilTable::AirfoilTable(const C81Deck& inner, const C81Deck& outer, double outer_share, TableInterpolation interpolation)
    : interpolation_(interpolation) {
  if (!(outer_share >= 0.0 && outer_share <= 1.0))
    throw std::invalid_argument("airfoil table: share of the outer airfoil = " + std::to_string(outer_share) + ", expected 0 to 1");
  build({&inner, &outer}, {1.0 - outer_share, outer_share});
}

void AirfoilTable::build(const std::vector<const C81Deck*>& decks, const std::vector<double>& shares) {
  struct Part {
    BlockInterpolant block;
    double share;
  };
  std::vector<Part> parts[3];
  std::vector<double> alphas, machs;
  for (std::size_t d = 0; d < decks.size(); ++d) {
    const C81Block* blocks[3] = {&decks[d]->lift, &decks[d]->drag, &decks[d]->moment};
    for (int b = 0; b < 3; ++b) {
      parts[b].push_back({BlockInterpolant(*blocks[b], interpolation_), shares[d]});
      for (double alpha : blocks[b]->alpha_deg) alphas.push_back(deckRadians(alpha));
      machs.insert(machs.end(), blocks[b]->mach.begin(), blocks[b]->mach.end());
      periodic_ = periodic_ || (blocks[b]->alpha_deg.front() == -180.0 && blocks[b]->alpha_deg.back() == 180.0);
    }
  }
  alphas = unite(alphas);
  machs = unite(machs);
  if (machs.size() == 1) machs.push_back(machs.front() + 1.0);  // a cell needs two ends; the values there are the same
  alpha_search_ = GridSearch(alphas);
  mach_search_ = GridSearch(machs);
  mach_count_ = static_cast<int>(machs.size());

  const bool slopes = interpolation_ == TableInterpolation::kMonotoneCubic;
  for (double alpha : alphas)
    for (double mach : machs) {
      double value[3] = {}, slope[3] = {};
      for (int b = 0; b < 3; ++b)
        for (const Part& part : parts[b]) {
          const BlockInterpolant::Sample sample = part.block.at(alpha, mach);
          value[b] += part.share * sample.value;
          slope[b] += part.share * sample.slope;
        }
      nodes_.push_back({value[0], value[1], value[2], 0.0});
      if (slopes) nodes_.push_back({slope[0], slope[1], slope[2], 0.0});
    }
}

template <int N>
void AirfoilTable::at(const Lanes<N>& alpha, const Lanes<N>& mach, Lanes<N>& lift, Lanes<N>& drag, Lanes<N>& moment) const noexcept {
  if (interpolation_ == TableInterpolation::kLinear)
    evaluate<N, TableInterpolation::kLinear>(alpha, mach, lift, drag, moment);
  else
    evaluate<N, TableInterpolation::kMonotoneCubic>(alpha, mach, lift, drag, moment);
}

template <int N, TableInterpolation interpolation>
void AirfoilTable::evaluate(const Lanes<N>& alpha, const Lanes<N>& mach, Lanes<N>& lift, Lanes<N>& drag, Lanes<N>& moment) const noexcept {
  Lanes<N> angle = alpha;
  if (periodic_)
    for (int k = 0; k < N; ++k) angle[k] = wrapAngle(alpha[k]);
  const GridSearch::Places<N> a = alpha_search_.find(angle), m = mach_search_.find(mach);
  constexpr int column = interpolation == TableInterpolation::kMonotoneCubic ? 8 : 4;
  const int row = column * mach_count_;
  const double* const first = &nodes_.front().lift;
  const auto coefficients = [&](int k) __attribute__((always_inline)) -> Quad {
    const double* const corner = first + a.cell[k] * row + m.cell[k] * column;
    if constexpr (interpolation == TableInterpolation::kMonotoneCubic)
      return cubic(corner, row, a.fraction[k], alpha_search_.width(a.cell[k]), m.fraction[k]);
    else
      return bilinear(corner, row, a.fraction[k], m.fraction[k]);
  };
  if constexpr (N % 4 == 0) {
    // Four lanes of quads are turned in registers: what reads the result as vectors need not wait for single stores.
    for (int k = 0; k < N; k += 4) {
      const Quad q0 = coefficients(k), q1 = coefficients(k + 1), q2 = coefficients(k + 2), q3 = coefficients(k + 3);
      Eigen::Map<Quad, Eigen::Aligned32>{&lift[k]} = Quad(q0[0], q1[0], q2[0], q3[0]);
      Eigen::Map<Quad, Eigen::Aligned32>{&drag[k]} = Quad(q0[1], q1[1], q2[1], q3[1]);
      Eigen::Map<Quad, Eigen::Aligned32>{&moment[k]} = Quad(q0[2], q1[2], q2[2], q3[2]);
    }
  } else {
    for (int k = 0; k < N; ++k) {
      const Quad c = coefficients(k);
      lift[k] = c[0];
      drag[k] = c[1];
      moment[k] = c[2];
    }
  }
}

AirfoilTable::Coefficients AirfoilTable::at(double alpha, double mach) const noexcept {
  Lanes<1> lift, drag, moment;
  at<1>({{alpha}}, {{mach}}, lift, drag, moment);
  return {lift[0], drag[0], moment[0]};
}

template void AirfoilTable::at<1>(const Lanes<1>&, const Lanes<1>&, Lanes<1>&, Lanes<1>&, Lanes<1>&) const noexcept;
template void AirfoilTable::at<4>(const Lanes<4>&, const Lanes<4>&, Lanes<4>&, Lanes<4>&, Lanes<4>&) const noexcept;
template void AirfoilTable::at<8>(const Lanes<8>&, const Lanes<8>&, Lanes<8>&, Lanes<8>&, Lanes<8>&) const noexcept;

}  // namespace heerk_rotor
