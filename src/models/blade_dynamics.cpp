#include "blade_dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "heerk_rotor/beam/beam_types.hpp"

namespace heerk_rotor {

template <int L>
Lanes3<L> BladeAxes<L>::toBlade(const Lanes3<L>& v) const noexcept {
  const LaneVector<L> up = precone_cosine * v.z - precone_sine * v.x;
  return {precone_cosine * v.x + precone_sine * v.z, pitch_cosine * v.y + pitch_sine * up, pitch_cosine * up - pitch_sine * v.y};
}

template <int L>
Lanes3<L> BladeAxes<L>::fromBlade(const Lanes3<L>& v) const noexcept {
  const LaneVector<L> up = pitch_sine * v.y + pitch_cosine * v.z;
  return {precone_cosine * v.x - precone_sine * up, pitch_cosine * v.y - pitch_sine * v.z, precone_sine * v.x + precone_cosine * up};
}

template <int L>
Lanes3<L> BladeAxes<L>::fromHub(const double* v) const noexcept {
  return {-(cosine * v[0] + sine * v[1]), sine * v[0] - cosine * v[1], sameLanes<L>(v[2])};
}

template <int L>
Lanes3<L> BladeAxes<L>::toHub(const Lanes3<L>& v) const noexcept {
  return {sine * v.y - cosine * v.x, -(sine * v.x + cosine * v.y), v.z};
}

template <int L>
Lanes3<L> BladeAxes<L>::omegaOfBlade() const noexcept {
  Lanes3<L> w = toBlade(omega);
  w.x += pitch_rate;
  return w;
}

namespace {

/// The lanes of one coefficient: all the same, or each its own.
template <bool equal, class Lanes>
Lanes coefficient(const double* a) noexcept {
  constexpr int lanes = static_cast<int>(sizeof(Lanes) / sizeof(double));
  if constexpr (equal) return sameLanes<lanes>(*a);
  else return readLanes<lanes>(a);
}

/// How many of the `width` lanes of nodal and modal arrays are worked on at once.
template <int L, bool equal>
constexpr int registerLanes(int width) { return std::min(equal ? width : L, kRegisterLanes); }

/// nodal = V modal, in arrays of `width` lanes: a multiple of the L blades.
template <int width, int L, bool equal>
void toNodes(const BladeCoefficients& c, const double* modal, double* nodal) noexcept {
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
void addToModes(const BladeCoefficients& c, const double* nodal, double* modal) noexcept {
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
void evaluateShape(const BladeCoefficients& c, const BladeCoefficients::SectionShape& shape, const Lanes* d, Lanes* values) noexcept {
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

template <class Lanes>
const double* numbers(const std::vector<Lanes>& lanes) noexcept { return reinterpret_cast<const double*>(lanes.data()); }
template <class Lanes>
double* numbers(std::vector<Lanes>& lanes) noexcept { return reinterpret_cast<double*>(lanes.data()); }

}  // namespace

template <int L>
BladeDynamics<L>::BladeDynamics(const FeRotorParameters& p)
    : c_(p, L), root_lead_(p.blades.front().root_lead) {
  const auto size = [](int n) { return static_cast<std::size_t>(n); };
  const std::size_t modes = size(c_.modes), nodal = size(c_.nodal_size);
  state_key_.resize(size(2 * c_.modes * c_.blades));
  q_.assign(modes, Pair{});
  for (auto* v : {&modal_load_, &remainder_, &q_acceleration_}) v->assign(modes, Vec{});
  for (auto* v : {&d_, &nodal_x_, &nodal_y_}) v->assign(nodal, Pair{});
  for (auto* v : {&nodal_load_, &d_acceleration_}) v->assign(nodal, Vec{});
  section_.assign(c_.shapes.size() * kShapeRows, Pair{});
  for (int kind = 0; kind < kDofKinds; ++kind) slot_[kind].assign(size(c_.rows(kind) * c_.slots[kind]), Vec{});
  for (const BladeCoefficients::LinePart& line : c_.lines) {
    if (line.slot < 0) continue;
    const int rows = kKindSize[line.kind];
    for (int i = 0; i < c_.rows(line.kind); ++i) slot_[line.kind][size((i / rows * c_.slots[line.kind] + line.slot) * rows + i % rows)] = read(line.values, size(i));
  }
  for (std::size_t m = 0; m < modes; ++m) {
    const auto row = [&](int which) { return read(c_.hub_rows, m * kHubRows + size(which)); };
    row_constant_x_.push_back(joinLanes<L>(row(kRowX), row(kRowTurnX)));
    row_constant_y_.push_back(joinLanes<L>(row(kRowY), row(kRowZ)));
  }
  row_x_ = row_constant_x_;
  row_y_ = row_constant_y_;
  for (int i = 0; i < kHubPairs; ++i) row_products_[i] = read(c_.hub_row_products, size(i));
  load_key_.resize(size(4 * c_.sections * c_.blades));
  acceleration_key_.resize(sizeof(HubAcceleration<L>) / sizeof(double));
}

template <int L>
template <bool equal>
LaneVector<L> BladeDynamics<L>::at(const std::vector<double>& values, std::size_t index) noexcept {
  return coefficient<equal, Vec>(values.data() + index * (equal ? 1 : L));
}

template <int L>
void BladeDynamics<L>::deform(const double* x) noexcept {
  const std::size_t bytes = state_key_.size() * sizeof(double);
  if (state_valid_ && std::memcmp(x, state_key_.data(), bytes) == 0) return;
  std::memcpy(state_key_.data(), x, bytes);
  state_valid_ = true;
  load_valid_ = acceleration_valid_ = false;
  for (std::size_t i = 0; i < q_.size(); ++i) {
    const double* const q = x + c_.mode_order[i] * c_.blades;
    q_[i] = joinLanes<L>(loadLanes<L>(q, c_.blades), loadLanes<L>(q + c_.modes * c_.blades, c_.blades));
  }
  if (c_.offset) c_.copies == 1 ? deformImpl<true, true>() : deformImpl<false, true>();
  else c_.copies == 1 ? deformImpl<true, false>() : deformImpl<false, false>();
}

template <int L>
template <bool equal, bool offset>
void BladeDynamics<L>::deformImpl() noexcept {
  toNodes<2 * L, L, equal>(c_, numbers(q_), numbers(d_));
  for (std::size_t j = 0; j < c_.shapes.size(); ++j) evaluateShape(c_, c_.shapes[j], d_.data(), section_.data() + kShapeRows * j);
  applyForms<equal>();
  applyLines<equal>();
  findMassMoments();

  // Hub rows of the deformed blade, and their products.
  row_x_ = row_constant_x_;
  addToModes<2 * L, L, equal>(c_, numbers(nodal_x_), numbers(row_x_));
  if (offset) {
    row_y_ = row_constant_y_;
    addToModes<2 * L, L, equal>(c_, numbers(nodal_y_), numbers(row_y_));
  }
  findRowProducts<equal, offset>();
}

/// rows'rows, where one of the two rows depends on the deformation.
template <int L>
template <bool equal, bool offset>
void BladeDynamics<L>::findRowProducts() noexcept {
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

template <int L>
template <bool equal, bool offset>
LaneVector<L> BladeDynamics<L>::hubRow(int row, std::size_t mode) const noexcept {
  if (row == kRowX) return firstOf<L>(row_x_[mode]);
  if (row == kRowTurnX) return secondOf<L>(row_x_[mode]);
  if (offset && row == kRowY) return firstOf<L>(row_y_[mode]);
  if (offset && row == kRowZ) return secondOf<L>(row_y_[mode]);
  return at<equal>(c_.hub_rows, mode * kHubRows + static_cast<std::size_t>(row));
}

/// Products of the forms with d and d', nodal and as sums.
template <int L>
template <bool equal>
void BladeDynamics<L>::applyForms() noexcept {
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
void BladeDynamics<L>::applyPart(const BladeCoefficients::FormPart& part) noexcept {
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
void BladeDynamics<L>::applyLines() noexcept {
  for (int line = 0; line < kLines; ++line) line_[line] = line_rate_[line] = Vec{};
  for (const BladeCoefficients::LinePart& part : c_.lines) {
    const Pair* const row = d_.data() + c_.kind_begin[part.kind];
    Vec sum{}, sum_rate{};
    for (int i = c_.first_node * kKindSize[part.kind]; i < c_.rows(part.kind); ++i) {
      const Vec value = at<equal>(part.values, static_cast<std::size_t>(i));
      sum += value * firstOf<L>(row[i]);
      sum_rate += value * secondOf<L>(row[i]);
    }
    line_[part.line] += sum;
    line_rate_[part.line] += sum_rate;
  }
}

template <int L>
void BladeDynamics<L>::load(const BladeAxes<L>& axes, std::uint64_t version, const double* loads) noexcept {
  const std::size_t bytes = load_key_.size() * sizeof(double);
  if (load_valid_ && axes_version_ == version && std::memcmp(load_key_.data(), loads, bytes) == 0) return;
  std::memcpy(load_key_.data(), loads, bytes);
  axes_version_ = version;
  load_valid_ = true;
  acceleration_valid_ = false;
  c_.copies == 1 ? loadImpl<true>(axes, loads) : loadImpl<false>(axes, loads);
}

/// Nodal loads of one kind.
template <int L>
template <int rows>
void BladeDynamics<L>::sumOverSlots(int kind, const Vec* factor) noexcept {
  const Vec* slot = slot_[kind].data() + c_.first_node * c_.slots[kind] * rows;
  Vec* f = nodal_load_.data() + c_.kind_begin[kind] + c_.first_node * rows;
  for (int node = c_.first_node; node < c_.nodes; ++node, f += rows) {
    Vec sum[rows] = {};
    for (int i = 0; i < c_.slots[kind]; ++i, slot += rows)
      for (int r = 0; r < rows; ++r) sum[r] += factor[i] * slot[r];
    for (int r = 0; r < rows; ++r) f[r] = sum[r];
  }
}

template <int L>
template <bool equal>
void BladeDynamics<L>::loadImpl(const BladeAxes<L>& axes, const double* loads) noexcept {
  const Vec3 w = axes.omegaOfBlade();
  const Vec xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  const Vec mean = yy + zz, cosine = zz - yy, sine = 2.0 * w.y * w.z;
  const Vec on_line[kLoadLines] = {mean, cosine, sine, xx, -(w.x * w.y), -(w.x * w.z)};
  // S contains the stiffness at nominal speed, at zero pitch and with the root lead's centripetal acceleration.
  const Vec on_form[kForms] = {c_.nominal_mean - mean, c_.nominal_mean - cosine, -sine, xx - c_.nominal_spin, Vec{}, Vec{}, sameLanes<L>(c_.nominal_lead_v), Vec{}};
  const Vec coriolis = -2.0 * w.x;

  for (int kind = 0; kind < kDofKinds; ++kind) {
    Vec factor[kLines + 2 * kDofKinds * kForms];  // [slot], at most every line, and every form with each kind of column
    for (const BladeCoefficients::LinePart& line : c_.lines) if (line.kind == kind && line.slot >= 0) factor[line.slot] = on_line[line.line];
    for (const BladeCoefficients::FormPart& part : c_.parts) {
      if (part.row != kind) continue;
      if (part.slot >= 0) {
        Vec sum{};
        for (BladeForm form : {kFormMean, kFormCosine, kFormSine, kFormSpin, kFormOffsetV}) sum += part.factor[form] * on_form[form];
        factor[part.slot] = sum;
      }
      if (part.rate_slot >= 0) factor[part.rate_slot] = part.factor[kFormCoriolis] * coriolis;
    }
    kKindSize[kind] == 2 ? sumOverSlots<2>(kind, factor) : sumOverSlots<1>(kind, factor);
  }
  int hinge = 0;
  for (NodeDof slope : {kDofSlopeV, kDofSlopeW}) nodal_load_[root(slope)] -= at<equal>(c_.hinge_damping, static_cast<std::size_t>(hinge++)) * secondOf<L>(d_[root(slope)]);

  // Airloads: on the nodes by the shape functions, and their resultant.
  const int n = c_.blades;
  air_force_ = air_moment_ = Vec3{};
  for (int j = 0; j < c_.sections; ++j) {
    const BladeCoefficients::SectionShape& shape = c_.shapes[static_cast<std::size_t>(j)];
    const double* section = loads + 4 * j * n;
    const Vec3 force = axes.toBlade({loadLanes<L>(section, n), loadLanes<L>(section + n, n), loadLanes<L>(section + 2 * n, n)});
    const Vec moment = loadLanes<L>(section + 3 * n, n);
    Vec* const on_v = nodal_load_.data() + c_.kind_begin[kLagDofs] + 2 * shape.node;
    Vec* const on_w = nodal_load_.data() + c_.kind_begin[kFlapDofs] + 2 * shape.node;
    Vec* const on_twist = nodal_load_.data() + c_.kind_begin[kTwistDofs] + shape.node;
    for (int i = 0; i < 4; ++i) {
      on_v[i] += shape.v[i] * force.y;
      on_w[i] += shape.v[i] * force.z;
    }
    for (int i = 0; i < 2; ++i) on_twist[i] += shape.twist[i] * moment;
    const SectionMotion<L> at_section = displacement(j);
    air_force_ = air_force_ + force;
    air_moment_ = air_moment_ + cross(Vec3{sameLanes<L>(shape.radius), at_section.v, at_section.w}, force);
    air_moment_.x += moment;
  }
  std::fill(modal_load_.begin(), modal_load_.end(), Vec{});
  addToModes<L, L, equal>(c_, numbers(nodal_load_), numbers(modal_load_));
  c_.offset ? loadOnHub<equal, true>() : loadOnHub<equal, false>();

  // Force and moment that the hub exerts on the blade, less the airloads, without the hub's accelerations.
  const MassMoments& m = moments_;
  hub_force_ = hub_force_ + sameLanes<L>(2.0) * cross(w, m.first_rate) + cross(w, cross(w, m.first)) - Vec3{rate_shortening_, rate_offset_v_, rate_offset_w_} - air_force_;
  hub_moment_ = hub_moment_ + m.second_rate * w + cross(w, m.second * w + m.deformation_momentum) - air_moment_;
  const Vec3 w_R = axes.toBlade(axes.omega);
  turning_y_ = axes.pitch_rate * w_R.z;  // w_R x (theta' e_x)
  turning_z_ = -(axes.pitch_rate * w_R.y);
}

/// What the modes' own accelerations carry of force and moment: rows'Q' of the class comment.
template <int L>
template <bool equal, bool offset>
void BladeDynamics<L>::loadOnHub() noexcept {
  Vec sum[kHubRows] = {};
  for (std::size_t m = 0; m < static_cast<std::size_t>(c_.modes); ++m) {
    const Vec acceleration = modal_load_[m] - at<equal>(c_.stiffness, m) * firstOf<L>(q_[m]) - at<equal>(c_.mode_damping, m) * secondOf<L>(q_[m]);
    for (int i = 0; i < kHubRows; ++i) sum[i] += hubRow<equal, offset>(i, m) * acceleration;
  }
  hub_force_ = {sum[kRowX], sum[kRowY], sum[kRowZ]};
  hub_moment_ = {sum[kRowTurnX], sum[kRowTurnY], sum[kRowTurnZ]};
}

template <int L>
void BladeDynamics<L>::accelerate(const BladeAxes<L>& axes, const HubAcceleration<L>& hub) noexcept {
  if (acceleration_valid_ && std::memcmp(acceleration_key_.data(), &hub, sizeof hub) == 0) return;
  std::memcpy(acceleration_key_.data(), &hub, sizeof hub);
  acceleration_valid_ = true;
  remainder_valid_ = d_acceleration_valid_ = false;
  accelerateImpl(axes, hub);
}

template <int L>
void BladeDynamics<L>::accelerateImpl(const BladeAxes<L>& axes, const HubAcceleration<L>& hub) noexcept {
  // The origin of B is the root lead ahead of the hub centre; B turns with the pitch as well.
  const Vec3 lead{Vec{}, sameLanes<L>(root_lead_), Vec{}};
  Vec3 origin = hub.linear;
  if (root_lead_ != 0.0) origin = origin + cross(hub.angular, lead) + cross(axes.omega, cross(axes.omega, lead));
  const Vec3 a = axes.toBlade(origin);
  Vec3 alpha = axes.toBlade(hub.angular);
  alpha = {alpha.x + hub.pitch, alpha.y + turning_y_, alpha.z + turning_z_};
  const Vec A[kHubRows] = {a.x, a.y, a.z, alpha.x, alpha.y, alpha.z};
  std::copy(A, A + kHubRows, acceleration_);

  // The blade as a rigid body, less what its modes yield.
  const Vec3 force = hub_force_ + rigid(0) * a + cross(alpha, moments_.first), moment = hub_moment_ + moments_.second * alpha + cross(moments_.first, a);
  Vec load[kHubRows] = {force.x, force.y, force.z, moment.x, moment.y, moment.z};
  for (int i = 0; i < kHubRows; ++i)
    for (int j = 0; j < kHubRows; ++j) load[i] -= row_products_[i < j ? hubPair(i, j) : hubPair(j, i)] * A[j];
  root_force_ = axes.fromBlade({-load[kRowX], -load[kRowY], -load[kRowZ]});
  root_moment_ = axes.fromBlade({-load[kRowTurnX], -load[kRowTurnY], -load[kRowTurnZ]});
  if (root_lead_ != 0.0) root_moment_ = root_moment_ + cross(lead, root_force_);
}

template <int L>
const LaneVector<L>* BladeDynamics<L>::remainder() noexcept {
  if (!remainder_valid_) {
    if (c_.offset) c_.copies == 1 ? remainderImpl<true, true>() : remainderImpl<false, true>();
    else c_.copies == 1 ? remainderImpl<true, false>() : remainderImpl<false, false>();
    remainder_valid_ = true;
  }
  return remainder_.data();
}

template <int L>
template <bool equal, bool offset>
void BladeDynamics<L>::remainderImpl() noexcept {
  for (std::size_t m = 0; m < static_cast<std::size_t>(c_.modes); ++m) {
    Vec by_hub{};
    for (int i = 0; i < kHubRows; ++i) by_hub += hubRow<equal, offset>(i, m) * acceleration_[i];
    remainder_[static_cast<std::size_t>(c_.mode_order[m])] = modal_load_[m] - by_hub;
  }
}

template <int L>
SectionMotion<L> BladeDynamics<L>::displacementAcceleration(int j) noexcept {
  if (!d_acceleration_valid_) {
    remainder();
    for (std::size_t m = 0; m < static_cast<std::size_t>(c_.modes); ++m)
      q_acceleration_[m] = remainder_[static_cast<std::size_t>(c_.mode_order[m])] - read(c_.stiffness, m) * firstOf<L>(q_[m]) - read(c_.mode_damping, m) * secondOf<L>(q_[m]);
    c_.copies == 1 ? toNodes<L, L, true>(c_, numbers(q_acceleration_), numbers(d_acceleration_))
                   : toNodes<L, L, false>(c_, numbers(q_acceleration_), numbers(d_acceleration_));
    d_acceleration_valid_ = true;
  }
  Vec values[kShapeRows];
  evaluateShape(c_, c_.shapes[static_cast<std::size_t>(j)], d_acceleration_.data(), values);
  return {values[kRowV], values[kRowW], values[kRowTwist], values[kRowSlopeV], values[kRowSlopeW]};
}

template <int L>
void BladeDynamics<L>::findMassMoments() noexcept {
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

template <int L>
void BladeDynamics<L>::momentum(const BladeAxes<L>& axes, const Vec3& velocity, Vec3& linear_R, Vec3& angular_R) const noexcept {
  const Vec3 lead{Vec{}, sameLanes<L>(root_lead_), Vec{}};
  const Vec3 v = axes.toBlade(velocity + cross(axes.omega, lead)), w = axes.omegaOfBlade();
  const MassMoments& m = moments_;
  linear_R = axes.fromBlade(rigid(0) * v + cross(w, m.first) + m.first_rate);
  angular_R = axes.fromBlade(m.second * w + m.deformation_momentum + cross(m.first, v)) + cross(lead, linear_R);
}

template <int L>
LaneVector<L> BladeDynamics<L>::energy(const BladeAxes<L>& axes, const Vec3& velocity) const noexcept {
  // With P and H about the origin of B, T = (v.P + w.H + v.S' + w.h + q'.q') / 2.
  const Vec3 lead{Vec{}, sameLanes<L>(root_lead_), Vec{}};
  const Vec3 v = axes.toBlade(velocity + cross(axes.omega, lead)), w = axes.omegaOfBlade();
  const MassMoments& m = moments_;
  const Vec3 P = rigid(0) * v + cross(w, m.first) + m.first_rate, H = m.second * w + m.deformation_momentum + cross(m.first, v);
  Vec twice = dot(v, P) + dot(w, H) + dot(v, m.first_rate) + dot(w, m.deformation_momentum);
  // Elastic: the modes' stiffness less what rotation at nominal speed contributes to it.
  for (std::size_t i = 0; i < static_cast<std::size_t>(c_.modes); ++i) {
    const Vec q = firstOf<L>(q_[i]), rate = secondOf<L>(q_[i]);
    twice += rate * rate + read(c_.stiffness, i) * q * q;
  }
  twice -= c_.nominal_mean * (form_[kFormMean] + form_[kFormCosine]) - c_.nominal_spin * form_[kFormSpin] + c_.nominal_lead_v * form_[kFormOffsetV];
  return 0.5 * twice;
}

template <int L>
LaneVector<L> BladeDynamics<L>::dissipation() const noexcept {
  Vec power{};
  int hinge = 0;
  for (NodeDof slope : {kDofSlopeV, kDofSlopeW}) {
    const Vec rate = secondOf<L>(d_[root(slope)]);
    power += read(c_.hinge_damping, static_cast<std::size_t>(hinge++)) * rate * rate;
  }
  for (std::size_t m = 0; m < static_cast<std::size_t>(c_.modes); ++m) {
    const Vec rate = secondOf<L>(q_[m]);
    power += read(c_.mode_damping, m) * rate * rate;
  }
  return power;
}

template struct BladeAxes<4>;
template struct BladeAxes<8>;
template class BladeDynamics<4>;
template class BladeDynamics<8>;

}  // namespace heerk_rotor
