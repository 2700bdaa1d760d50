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

// Products with V, tile by tile: the sums of a tile stay in registers, and a coefficient that has been read serves all registers that it concerns.

/// Arrays of `width` lanes, of L blades or of two quantities of L blades: lanes of a register, registers that share coefficients (both quantities), and
/// tiles worked on at once, so that there are enough sums that do not wait for each other.
template <int width, int L, bool equal>
struct TileRegisters {
  static constexpr int lanes = std::min(equal ? width : L, kRegisterLanes);
  static constexpr int sharing = width > L && lanes <= L ? 2 : 1;
  static constexpr int tiles = sharing == 2 ? 1 : 2;
  using Lanes = LaneVector<lanes>;
  template <int count>
  using Sums = Lanes[count * BladeCoefficients::kTile][sharing];
};

/// sums += coefficients times one value of either quantity, in `tiles` tiles; coefficients: of the first tile, `step` apart.
template <class Registers, int L, bool equal, int tiles, int step>
inline void addProducts(const double* coefficients, std::ptrdiff_t next_tile, const double* value, typename Registers::template Sums<tiles>& sums) noexcept {
  typename Registers::Lanes factor[Registers::sharing];
#pragma GCC unroll 2
  for (int s = 0; s < Registers::sharing; ++s) factor[s] = readLanes<Registers::lanes>(value + s * L);
#pragma GCC unroll 2
  for (int tile = 0; tile < tiles; ++tile)
#pragma GCC unroll 5
    for (int i = 0; i < BladeCoefficients::kTile; ++i) {
      const auto a = coefficient<equal, typename Registers::Lanes>(coefficients + tile * next_tile + i * step);
#pragma GCC unroll 2
      for (int s = 0; s < Registers::sharing; ++s) sums[tile * BladeCoefficients::kTile + i][s] += a * factor[s];
    }
}

/// nodal = V modal for the rows of `tiles` tiles.
template <int width, int L, bool equal, int tiles>
inline void tilesToNodes(const BladeCoefficients& c, int row_tile, const double* modal, double* nodal) noexcept {
  using Registers = TileRegisters<width, L, equal>;
  constexpr int B = BladeCoefficients::kTile, copies = equal ? 1 : L;
  const BladeCoefficients::TileRange modes = c.modes_of_rows[static_cast<std::size_t>(row_tile)].with(c.modes_of_rows[static_cast<std::size_t>(row_tile + tiles - 1)]);
  const int* const position = c.row_position.data() + row_tile * B;
  for (int lane = 0; lane < width / Registers::sharing; lane += Registers::lanes) {
    typename Registers::template Sums<tiles> sums = {};
    const double* V = c.tile(row_tile, modes.begin) + (equal ? 0 : lane);
    const double* q = modal + modes.begin * B * width + lane;
    for (int m = modes.begin * B; m < modes.end * B; ++m, V += B * copies, q += width) addProducts<Registers, L, equal, tiles, copies>(V, c.nextRowTile(), q, sums);
#pragma GCC unroll 10
    for (int r = 0; r < tiles * B; ++r)
#pragma GCC unroll 2
      for (int s = 0; s < Registers::sharing; ++s) writeLanes<Registers::lanes>(sums[r][s], nodal + position[r] * width + lane + s * L);
  }
}

/// modal = start + V' nodal for the modal entries of `tiles` tiles; start: a modal array, or null for zero.
template <int width, int L, bool equal, int tiles>
inline void tilesToModes(const BladeCoefficients& c, int mode_tile, const double* nodal, const double* start, double* modal) noexcept {
  using Registers = TileRegisters<width, L, equal>;
  constexpr int B = BladeCoefficients::kTile, copies = equal ? 1 : L;
  const BladeCoefficients::TileRange rows = c.rows_of_modes[static_cast<std::size_t>(mode_tile)].with(c.rows_of_modes[static_cast<std::size_t>(mode_tile + tiles - 1)]);
  const int first = mode_tile * B * width;
  for (int lane = 0; lane < width / Registers::sharing; lane += Registers::lanes) {
    typename Registers::template Sums<tiles> sums = {};
    if (start)
#pragma GCC unroll 10
      for (int m = 0; m < tiles * B; ++m)
#pragma GCC unroll 2
        for (int s = 0; s < Registers::sharing; ++s) sums[m][s] = readLanes<Registers::lanes>(start + first + m * width + lane + s * L);
    const double* V = c.tile(rows.begin, mode_tile) + (equal ? 0 : lane);
    const int* position = c.row_position.data() + rows.begin * B;
    for (int tile = rows.begin; tile < rows.end; ++tile, V += c.nextRowTile(), position += B)
#pragma GCC unroll 5
      for (int r = 0; r < B; ++r) addProducts<Registers, L, equal, tiles, B * copies>(V + r * copies, c.nextModeTile(), nodal + position[r] * width + lane, sums);
#pragma GCC unroll 10
    for (int m = 0; m < tiles * B; ++m)
#pragma GCC unroll 2
      for (int s = 0; s < Registers::sharing; ++s) writeLanes<Registers::lanes>(sums[m][s], modal + first + m * width + lane + s * L);
  }
}

/// nodal = V modal.
template <int width, int L, bool equal>
inline void toNodes(const BladeCoefficients& c, const double* modal, double* nodal) noexcept {
  constexpr int tiles = TileRegisters<width, L, equal>::tiles;
  int tile = 0;
  for (; tile + tiles <= c.row_tiles; tile += tiles) tilesToNodes<width, L, equal, tiles>(c, tile, modal, nodal);
  if (tile < c.row_tiles) tilesToNodes<width, L, equal, 1>(c, tile, modal, nodal);
}

/// modal = start + V' nodal; start: a modal array, or null for zero.
template <int width, int L, bool equal>
inline void toModes(const BladeCoefficients& c, const double* nodal, const double* start, double* modal) noexcept {
  constexpr int tiles = TileRegisters<width, L, equal>::tiles;
  int tile = 0;
  for (; tile + tiles <= c.mode_tiles; tile += tiles) tilesToModes<width, L, equal, tiles>(c, tile, nodal, start, modal);
  if (tile < c.mode_tiles) tilesToModes<width, L, equal, 1>(c, tile, nodal, start, modal);
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
