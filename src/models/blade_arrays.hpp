#pragma once
#include <algorithm>
#include <vector>

#include "blade_coefficients.hpp"
#include "heerk_rotor/beam/beam_types.hpp"
#include "lane_vector.hpp"

namespace heerk_rotor {

// Nodal and modal arrays of BladeCoefficients with blades in lanes: from one to the other, and to the displacements at a section.

/// Displacements at one radius.
template <int L>
struct SectionMotion {
  LaneVector<L> v, w, twist, slope_v, slope_w;  // in B
};

/// The lanes of one coefficient: all the same, or each its own.
template <bool equal, class Lanes>
inline Lanes coefficient(const double* a) noexcept {
  constexpr int lanes = static_cast<int>(sizeof(Lanes) / sizeof(double));
  if constexpr (equal) return sameLanes<lanes>(*a);
  else return readLanes<lanes>(a);
}

/// The same of entry `index` of a table of coefficients.
template <bool equal, int L>
inline LaneVector<L> entry(const std::vector<double>& values, std::size_t index) noexcept {
  return coefficient<equal, LaneVector<L>>(values.data() + index * (equal ? 1 : L));
}
template <int L>
inline LaneVector<L> entry(const BladeCoefficients& c, const std::vector<double>& values, std::size_t index) noexcept {
  return c.copies == 1 ? entry<true, L>(values, index) : entry<false, L>(values, index);
}

/// How many of the `width` lanes of nodal and modal arrays are worked on at once.
template <int L, bool equal>
constexpr int registerLanes(int width) { return std::min(equal ? width : L, kRegisterLanes); }

/// nodal = V modal, in arrays of `width` lanes: a multiple of the L blades.
template <int width, int L, bool equal>
inline void toNodes(const BladeCoefficients& c, const double* modal, double* nodal) noexcept {
  constexpr int B = BladeCoefficients::kBlock, R = registerLanes<L, equal>(width), stride = equal ? 1 : L;
  for (const BladeCoefficients::ModeBlock& block : c.mode_blocks)
    for (int part = 0; part < width; part += R) {
      LaneVector<R> sum[B] = {};
      const double* a = block.V.data() + (equal ? 0 : part % L);
      const double* q = modal + block.first * width + part;
      for (int i = 0; i < block.count; ++i, q += width, a += B * stride)
        for (int r = 0; r < B; ++r) sum[r] += coefficient<equal, LaneVector<R>>(a + r * stride) * readLanes<R>(q);
#pragma GCC unroll 8
      for (int r = 0; r < B; ++r) writeLanes<R>(sum[r], nodal + block.position[r] * width + part);
    }
}

/// modal += V' nodal.
template <int width, int L, bool equal>
inline void addToModes(const BladeCoefficients& c, const double* nodal, double* modal) noexcept {
  constexpr int B = BladeCoefficients::kBlock, R = registerLanes<L, equal>(width), stride = equal ? 1 : L;
  for (const BladeCoefficients::ModeBlock& block : c.mode_blocks)
    for (int part = 0; part < width; part += R) {
      LaneVector<R> f[B];
#pragma GCC unroll 8
      for (int r = 0; r < B; ++r) f[r] = readLanes<R>(nodal + block.position[r] * width + part);
      const double* a = block.V.data() + (equal ? 0 : part % L);
      double* q = modal + block.first * width + part;
      for (int i = 0; i < block.count; ++i, q += width, a += B * stride) {
        LaneVector<R> even = readLanes<R>(q), odd{};  // two shorter chains of additions
        for (int r = 0; r < B; r += 2) {
          even += coefficient<equal, LaneVector<R>>(a + r * stride) * f[r];
          odd += coefficient<equal, LaneVector<R>>(a + (r + 1) * stride) * f[r + 1];
        }
        writeLanes<R>(even + odd, q);
      }
    }
}

/// The displacements at a section from nodal ones; values: LaneVector of any width.
template <class Lanes>
inline void evaluateShape(const BladeCoefficients& c, const BladeCoefficients::SectionShape& shape, const Lanes* d, Lanes* values) noexcept {
  const Lanes* const v = d + c.kind_begin[kLagDofs] + 2 * shape.node;
  const Lanes* const w = d + c.kind_begin[kFlapDofs] + 2 * shape.node;
  const Lanes* const twist = d + c.kind_begin[kTwistDofs] + shape.node;
  const auto cubic = [](const double (&f)[4], const Lanes* at) { return f[0] * at[0] + f[1] * at[1] + f[2] * at[2] + f[3] * at[3]; };
  values[kRowV] = cubic(shape.v, v);
  values[kRowW] = cubic(shape.v, w);
  values[kRowTwist] = shape.twist[0] * twist[0] + shape.twist[1] * twist[1];
  values[kRowSlopeV] = cubic(shape.slope, v);
  values[kRowSlopeW] = cubic(shape.slope, w);
}

/// The numbers of an array of lanes one after the other.
template <class Lanes>
inline const double* numbers(const std::vector<Lanes>& lanes) noexcept { return reinterpret_cast<const double*>(lanes.data()); }
template <class Lanes>
inline double* numbers(std::vector<Lanes>& lanes) noexcept { return reinterpret_cast<double*>(lanes.data()); }

}  // namespace heerk_rotor
