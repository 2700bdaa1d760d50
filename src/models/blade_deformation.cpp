#include "blade_deformation.hpp"

#include <algorithm>
#include <cstring>

namespace heerk_rotor {

template <int L>
BladeDeformation<L>::BladeDeformation(const FeRotorParameters& p) : c_(p, L) {
  const auto size = [](int n) { return static_cast<std::size_t>(n); };
  const auto read = [this](const std::vector<double>& values, std::size_t index) { return entry<L>(c_, values, index); };
  const std::size_t modes = size(c_.modes), modal = size(c_.modalSize()), nodal = size(c_.nodal_size);
  state_key_.resize(size(2 * c_.modes * c_.blades));
  for (auto* v : {&q_, &row_constant_x_, &row_constant_y_}) v->assign(modal, Pair{});
  for (auto* v : {&d_, &nodal_x_, &nodal_y_}) v->assign(nodal, Pair{});
  section_.assign(c_.shapes.size() * kShapeRows, Pair{});
  for (int kind = 0; kind < kDofKinds; ++kind) slot_[kind].assign(size(c_.rows(kind) * c_.slots[kind]), Vec{});
  for (const BladeCoefficients::LinePart& line : c_.lines) {
    if (line.slot < 0) continue;
    const int rows = kKindSize[line.kind];
    for (int i = 0; i < c_.rows(line.kind); ++i) slot_[line.kind][size((i / rows * c_.slots[line.kind] + line.slot) * rows + i % rows)] = read(line.values, size(i));
  }
  for (std::size_t m = 0; m < modes; ++m) {
    const auto row = [&](int which) { return read(c_.hub_rows, m * kHubRows + size(which)); };
    row_constant_x_[m] = joinLanes<L>(row(kRowX), row(kRowTurnX));
    row_constant_y_[m] = joinLanes<L>(row(kRowY), row(kRowZ));
  }
  row_x_ = row_constant_x_;
  row_y_ = row_constant_y_;
  for (int i = 0; i < kHubPairs; ++i) row_products_[i] = read(c_.hub_row_products, size(i));
}

template <int L>
bool BladeDeformation<L>::deform(const double* x, const double (&twist)[2], bool same_x) noexcept {
  const std::size_t bytes = state_key_.size() * sizeof(double);
  const bool same_twist = !c_.absolute || std::memcmp(twist, twist_key_, sizeof twist) == 0;
  if (state_valid_ && same_twist && (same_x || std::memcmp(x, state_key_.data(), bytes) == 0)) return false;
  std::memcpy(state_key_.data(), x, bytes);
  std::memcpy(twist_key_, twist, sizeof twist);
  state_valid_ = true;
  for (std::size_t i = 0; i < static_cast<std::size_t>(c_.modes); ++i) {
    const double* const q = x + c_.mode_order[i] * c_.blades;
    Vec value = loadLanes<L>(q, c_.blades), rate = loadLanes<L>(q + c_.modes * c_.blades, c_.blades);
    if (c_.absolute) {
      const Vec share = entry<L>(c_, c_.twist_share, i);
      value -= twist[0] * share;
      rate -= twist[1] * share;
    }
    q_[i] = joinLanes<L>(value, rate);
  }
  if (c_.offset) c_.copies == 1 ? deformImpl<true, true>() : deformImpl<false, true>();
  else c_.copies == 1 ? deformImpl<true, false>() : deformImpl<false, false>();
  return true;
}

template <int L>
template <bool equal, bool offset>
void BladeDeformation<L>::deformImpl() noexcept {
  toNodes<2 * L, L, equal>(c_, numbers(q_), numbers(d_));
  for (std::size_t j = 0; j < c_.shapes.size(); ++j) evaluateShape(c_, c_.shapes[j], d_.data(), section_.data() + kShapeRows * j);
  applyForms<equal>();
  applyLines<equal>();
  findMassMoments();

  // Hub rows of the deformed blade, and their products.
  toModes<2 * L, L, equal>(c_, numbers(nodal_x_), numbers(row_constant_x_), numbers(row_x_));
  if (offset) toModes<2 * L, L, equal>(c_, numbers(nodal_y_), numbers(row_constant_y_), numbers(row_y_));
  findRowProducts<equal, offset>();
}

/// rows'rows, where one of the two rows depends on the deformation.
template <int L>
template <bool equal, bool offset>
void BladeDeformation<L>::findRowProducts() noexcept {
  constexpr int kOther[4] = {kRowY, kRowZ, kRowTurnY, kRowTurnZ};
  Pair x_square{}, y_square{}, x_other[4] = {}, y_other[2] = {};
  Vec x_turn{}, y_z{};
  for (std::size_t m = 0; m < static_cast<std::size_t>(c_.modes); ++m) {
    const Pair x = row_x_[m];  // and turn x
    x_square += x * x;
    x_turn += firstOf<L>(x) * secondOf<L>(x);
#pragma GCC unroll 4
    for (int i = 0; i < 4; ++i) x_other[i] += x * repeatLanes<L>(hubRow<equal, offset>(kOther[i], m));
    if (!offset) continue;
    const Pair y = row_y_[m];  // and z
    y_square += y * y;
    y_z += firstOf<L>(y) * secondOf<L>(y);
#pragma GCC unroll 2
    for (int i = 0; i < 2; ++i) y_other[i] += y * repeatLanes<L>(hubRow<equal, offset>(kOther[2 + i], m));
  }
  row_products_[hubPair(kRowX, kRowX)] = firstOf<L>(x_square);
  row_products_[hubPair(kRowX, kRowTurnX)] = x_turn;
  row_products_[hubPair(kRowTurnX, kRowTurnX)] = secondOf<L>(x_square);
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) {
    const int other = kOther[i];
    row_products_[hubPair(kRowX, other)] = firstOf<L>(x_other[i]);
    row_products_[other < kRowTurnX ? hubPair(other, kRowTurnX) : hubPair(kRowTurnX, other)] = secondOf<L>(x_other[i]);
  }
  if (!offset) return;
  row_products_[hubPair(kRowY, kRowY)] = firstOf<L>(y_square);
  row_products_[hubPair(kRowY, kRowZ)] = y_z;
  row_products_[hubPair(kRowZ, kRowZ)] = secondOf<L>(y_square);
#pragma GCC unroll 2
  for (int i = 0; i < 2; ++i) {
    row_products_[hubPair(kRowY, kOther[2 + i])] = firstOf<L>(y_other[i]);
    row_products_[hubPair(kRowZ, kOther[2 + i])] = secondOf<L>(y_other[i]);
  }
}

/// Products of the forms with d and d', nodal and as sums.
template <int L>
template <bool equal>
void BladeDeformation<L>::applyForms() noexcept {
  for (int i = 0; i < kForms; ++i) form_[i] = form_rate_[i] = Vec{};
  rate_shortening_ = rate_offset_v_ = rate_offset_w_ = spin_momentum_ = Vec{};
  // Loads of hub accelerations that depend on the deformation, side by side: -T0 d and G d, likewise -E_v d and -E_w d.
  std::fill(nodal_x_.begin(), nodal_x_.end(), Pair{});
  if (c_.offset) std::fill(nodal_y_.begin(), nodal_y_.end(), Pair{});
  for (const BladeCoefficients::FormPart& part : c_.parts) {
    const bool two_rows = kKindSize[part.row] == 2, two_columns = kKindSize[part.column] == 2;
    if (part.rates) {
      if (two_rows) two_columns ? applyPart<equal, 2, 2, true>(part) : applyPart<equal, 2, 1, true>(part);
      else two_columns ? applyPart<equal, 1, 2, true>(part) : applyPart<equal, 1, 1, true>(part);
    } else {
      if (two_rows) two_columns ? applyPart<equal, 2, 2, false>(part) : applyPart<equal, 2, 1, false>(part);
      else two_columns ? applyPart<equal, 1, 2, false>(part) : applyPart<equal, 1, 1, false>(part);
    }
  }
}

template <int L>
template <bool equal, int rows, int columns, bool rates>
void BladeDeformation<L>::applyPart(const BladeCoefficients::FormPart& part) noexcept {
  // G blades at a time, so that all sums stay in registers; with rates, those of d and of d' side by side.
  constexpr int G = std::min(L, kRegisterLanes), stride = equal ? 1 : L;
  using Some = LaneVector<G>;
  using Sum = LaneVector<rates ? 2 * G : G>;
  const int node_slots = c_.slots[part.row] * rows * L;
  for (int g = 0; g < L; g += G) {
    const auto read = [g](const Pair& both) {
      const double* const at = reinterpret_cast<const double*>(&both) + g;
      if constexpr (!rates) return readLanes<G>(at);
      else if constexpr (L == G) return readLanes<2 * G>(at);
      else return joinLanes<G>(readLanes<G>(at), readLanes<G>(at + L));
    };
    const int first = c_.first_node, first_row = c_.kind_begin[part.row] + first * rows;
    const double* a = part.values.data() + first * 3 * columns * rows * stride + (equal ? 0 : g);
    const Pair* column = d_.data() + c_.kind_begin[part.column] + (first - 1) * columns;
    const Pair* row = d_.data() + first_row;
    double* slots = numbers(slot_[part.row]) + first * node_slots + g;
    const int hub_load = first_row * 2 * L + g;
    double* x = numbers(nodal_x_) + hub_load;
    double* y = numbers(nodal_y_) + hub_load;
    const int slot = part.slot, rate_slot = part.rate_slot;
    const double shortening = part.factor[kFormShortening], coriolis = part.factor[kFormCoriolis], offset_v = part.factor[kFormOffsetV], offset_w = part.factor[kFormOffsetW];
    const bool in_x = shortening != 0.0 || coriolis != 0.0, in_y = offset_v != 0.0 || offset_w != 0.0;
    const auto add = [](double factor, const Some& sum, double* to) { writeLanes<G>(readLanes<G>(to) + factor * sum, to); };
    Some d_A_d{}, rate_A_d{}, d_A_rate{}, rate_A_rate{};
    for (int node = first; node < c_.nodes; ++node, column += columns, slots += node_slots) {
      Sum sum[rows] = {};
#pragma GCC unroll 6
      for (int j = 0; j < 3 * columns; ++j, a += rows * stride) {
        const Sum value = read(column[j]);
#pragma GCC unroll 2
        for (int r = 0; r < rows; ++r) {
          if constexpr (!rates || equal) sum[r] += coefficient<equal, Sum>(a + r * stride) * value;
          else sum[r] += joinLanes<G>(readLanes<G>(a + r * stride), readLanes<G>(a + r * stride)) * value;
        }
      }
#pragma GCC unroll 2
      for (int r = 0; r < rows; ++r, ++row, x += 2 * L, y += 2 * L) {
        const double* const at = reinterpret_cast<const double*>(row) + g;
        const Some d = readLanes<G>(at), rate = readLanes<G>(at + L);
        Some A_d;
        if constexpr (rates) A_d = firstOf<G>(sum[r]);
        else A_d = sum[r];
        if (slot >= 0) writeLanes<G>(A_d, slots + (slot * rows + r) * L);
        d_A_d += d * A_d;
        rate_A_d += rate * A_d;
        if constexpr (rates) {
          const Some A_rate = secondOf<G>(sum[r]);
          d_A_rate += d * A_rate;
          rate_A_rate += rate * A_rate;
          if (rate_slot >= 0) writeLanes<G>(A_rate, slots + (rate_slot * rows + r) * L);
          if (in_x) {
            add(-shortening, A_d, x);
            add(coriolis, A_d, x + L);
          }
          if (in_y) {
            add(-offset_v, A_d, y);
            add(-offset_w, A_d, y + L);
          }
        }
      }
    }
    const auto addTo = [&](Vec& to, double factor, const Some& sum) { add(factor, sum, reinterpret_cast<double*>(&to) + g); };
    for (int i = 0; i < kForms; ++i) {
      if (part.factor[i] == 0.0) continue;
      addTo(form_[i], part.factor[i], d_A_d);
      addTo(form_rate_[i], part.factor[i], rate_A_d);
    }
    if (!rates) continue;
    addTo(rate_shortening_, shortening, rate_A_rate);
    addTo(rate_offset_v_, offset_v, rate_A_rate);
    addTo(rate_offset_w_, offset_w, rate_A_rate);
    addTo(spin_momentum_, -coriolis, d_A_rate);
  }
}

template <int L>
template <bool equal>
void BladeDeformation<L>::applyLines() noexcept {
  for (int line = 0; line < kLines; ++line) line_[line] = line_rate_[line] = Vec{};
  for (const BladeCoefficients::LinePart& part : c_.lines) {
    const Pair* const row = d_.data() + c_.kind_begin[part.kind];
    Vec sum{}, sum_rate{};
    for (int i = c_.first_node * kKindSize[part.kind]; i < c_.rows(part.kind); ++i) {
      const Vec value = entry<equal, L>(part.values, static_cast<std::size_t>(i));
      sum += value * firstOf<L>(row[i]);
      sum_rate += value * secondOf<L>(row[i]);
    }
    line_[part.line] += sum;
    line_rate_[part.line] += sum_rate;
  }
}

template <int L>
void BladeDeformation<L>::findMassMoments() noexcept {
  MassMoments& m = moments_;
  m.first = {rigid(1) + line_[kLineU] - 0.5 * form_[kFormShortening], rigid(2) + line_[kLineV] - 0.5 * form_[kFormOffsetV],
             rigid(3) + line_[kLineW] - 0.5 * form_[kFormOffsetW]};
  m.first_rate = {line_rate_[kLineU] - form_rate_[kFormShortening], line_rate_[kLineV] - form_rate_[kFormOffsetV],
                  line_rate_[kLineW] - form_rate_[kFormOffsetW]};
  m.deformation_momentum = {spin_momentum_ + line_rate_[kLineTwist], -line_rate_[kLineRW], line_rate_[kLineRV]};
  m.second.xx = rigid(4) + 2.0 * line_[kLineSpin] + form_[kFormSpin];
  m.second.yy = rigid(5) + 2.0 * (line_[kLineMean] - line_[kLineCosine]) - form_[kFormMean] + form_[kFormCosine];
  m.second.zz = rigid(6) + 2.0 * (line_[kLineMean] + line_[kLineCosine]) - form_[kFormMean] - form_[kFormCosine];
  m.second.xy = rigid(7) - line_[kLineRV];
  m.second.xz = rigid(8) - line_[kLineRW];
  m.second.yz = rigid(9) + 2.0 * line_[kLineSine] - form_[kFormSine];
  m.second_rate.xx = 2.0 * (line_rate_[kLineSpin] + form_rate_[kFormSpin]);
  m.second_rate.yy = 2.0 * (line_rate_[kLineMean] - line_rate_[kLineCosine] - form_rate_[kFormMean] + form_rate_[kFormCosine]);
  m.second_rate.zz = 2.0 * (line_rate_[kLineMean] + line_rate_[kLineCosine] - form_rate_[kFormMean] - form_rate_[kFormCosine]);
  m.second_rate.xy = -line_rate_[kLineRV];
  m.second_rate.xz = -line_rate_[kLineRW];
  m.second_rate.yz = 2.0 * (line_rate_[kLineSine] - form_rate_[kFormSine]);
}

template class BladeDeformation<4>;
template class BladeDeformation<8>;

}  // namespace heerk_rotor
