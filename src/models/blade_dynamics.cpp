#include "blade_dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "heerk_rotor/beam/beam_types.hpp"

namespace heerk_rotor {

template <int L>
BladeDynamics<L>::BladeDynamics(const FeRotorParameters& p) : deformation_(p), c_(deformation_.coefficients()), root_lead_(p.blades.front().root_lead) {
  const auto modal = static_cast<std::size_t>(c_.modalSize()), nodal = static_cast<std::size_t>(c_.nodal_size);
  for (auto* v : {&modal_load_, &remainder_, &q_acceleration_}) v->assign(modal, Vec{});
  for (auto* v : {&nodal_load_, &d_acceleration_}) v->assign(nodal, Vec{});
  load_key_.resize(static_cast<std::size_t>(4 * c_.sections * c_.blades));
  acceleration_key_.resize(sizeof(HubAcceleration<L>) / sizeof(double));
}

template <int L>
void BladeDynamics<L>::deform(const double* x, const double (&twist)[2], bool same_x) noexcept {
  if (deformation_.deform(x, twist, same_x)) load_valid_ = acceleration_valid_ = false;
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
  const Vec* slot = deformation_.slots(kind) + c_.first_node * c_.slots[kind] * rows;
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
  for (NodeDof slope : {kDofSlopeV, kDofSlopeW})
    nodal_load_[static_cast<std::size_t>(c_.kind_begin[slope / 2] + slope % 2)] -= entry<equal, L>(c_.hinge_damping, static_cast<std::size_t>(hinge++)) * deformation_.rootRate(slope);

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
  toModes<L, L, equal>(c_, numbers(nodal_load_), nullptr, numbers(modal_load_));
  c_.offset ? loadOnHub<equal, true>() : loadOnHub<equal, false>();

  // Force and moment that the hub exerts on the blade, less the airloads, without the hub's accelerations.
  const auto& m = deformation_.moments();
  hub_force_ = hub_force_ + sameLanes<L>(2.0) * cross(w, m.first_rate) + cross(w, cross(w, m.first)) + deformation_.firstByRates() - air_force_;
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
    const Vec acceleration = modal_load_[m] - entry<equal, L>(c_.stiffness, m) * firstOf<L>(deformation_.modal(m)) - entry<equal, L>(c_.mode_damping, m) * secondOf<L>(deformation_.modal(m));
    for (int i = 0; i < kHubRows; ++i) sum[i] += deformation_.template hubRow<equal, offset>(i, m) * acceleration;
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
  const Vec3 force = hub_force_ + deformation_.rigid(0) * a + cross(alpha, deformation_.moments().first), moment = hub_moment_ + deformation_.moments().second * alpha + cross(deformation_.moments().first, a);
  Vec load[kHubRows] = {force.x, force.y, force.z, moment.x, moment.y, moment.z};
  for (int i = 0; i < kHubRows; ++i)
    for (int j = 0; j < kHubRows; ++j) load[i] -= deformation_.hubRowProduct(i, j) * A[j];
  root_force_ = axes.fromBlade({-load[kRowX], -load[kRowY], -load[kRowZ]});
  root_moment_ = axes.fromBlade({-load[kRowTurnX], -load[kRowTurnY], -load[kRowTurnZ]});
  if (root_lead_ != 0.0) root_moment_ = root_moment_ + cross(lead, root_force_);
}

template <int L>
void BladeDynamics<L>::findRemainder() noexcept {
  if (remainder_valid_) return;
  if (c_.offset) c_.copies == 1 ? remainderImpl<true, true>() : remainderImpl<false, true>();
  else c_.copies == 1 ? remainderImpl<true, false>() : remainderImpl<false, false>();
  remainder_valid_ = true;
}

template <int L>
template <bool equal, bool offset>
void BladeDynamics<L>::remainderImpl() noexcept {
  for (std::size_t m = 0; m < static_cast<std::size_t>(c_.modes); ++m) {
    Vec by_hub{};
    for (int i = 0; i < kHubRows; ++i) by_hub += deformation_.template hubRow<equal, offset>(i, m) * acceleration_[i];
    remainder_[m] = modal_load_[m] - by_hub;
  }
}

template <int L>
void BladeDynamics<L>::storeRemainder(const double (&twist)[3], double* to) noexcept {
  findRemainder();
  for (std::size_t m = 0; m < static_cast<std::size_t>(c_.modes); ++m) {
    Vec value = remainder_[m];
    if (c_.absolute) value += entry<L>(c_, c_.twist_share, m) * (twist[0] * entry<L>(c_, c_.stiffness, m) + twist[1] * entry<L>(c_, c_.mode_damping, m) + twist[2]);
    storeLanes<L>(value, c_.blades, to + c_.mode_order[m] * c_.blades);
  }
}

template <int L>
SectionMotion<L> BladeDynamics<L>::displacementAcceleration(int j) noexcept {
  if (!d_acceleration_valid_) {
    findRemainder();
    for (std::size_t m = 0; m < static_cast<std::size_t>(c_.modes); ++m)
      q_acceleration_[m] = remainder_[m] - entry<L>(c_, c_.stiffness, m) * firstOf<L>(deformation_.modal(m)) - entry<L>(c_, c_.mode_damping, m) * secondOf<L>(deformation_.modal(m));
    c_.copies == 1 ? toNodes<L, L, true>(c_, numbers(q_acceleration_), numbers(d_acceleration_))
                   : toNodes<L, L, false>(c_, numbers(q_acceleration_), numbers(d_acceleration_));
    d_acceleration_valid_ = true;
  }
  Vec values[kShapeRows];
  evaluateShape(c_, c_.shapes[static_cast<std::size_t>(j)], d_acceleration_.data(), values);
  return {values[kRowV], values[kRowW], values[kRowTwist], values[kRowSlopeV], values[kRowSlopeW]};
}

template <int L>
void BladeDynamics<L>::momentum(const BladeAxes<L>& axes, const Vec3& velocity, Vec3& linear_R, Vec3& angular_R) const noexcept {
  const Vec3 lead{Vec{}, sameLanes<L>(root_lead_), Vec{}};
  const Vec3 v = axes.toBlade(velocity + cross(axes.omega, lead)), w = axes.omegaOfBlade();
  const auto& m = deformation_.moments();
  linear_R = axes.fromBlade(deformation_.rigid(0) * v + cross(w, m.first) + m.first_rate);
  angular_R = axes.fromBlade(m.second * w + m.deformation_momentum + cross(m.first, v)) + cross(lead, linear_R);
}

template <int L>
LaneVector<L> BladeDynamics<L>::energy(const BladeAxes<L>& axes, const Vec3& velocity) const noexcept {
  // With P and H about the origin of B, T = (v.P + w.H + v.S' + w.h + q'.q') / 2.
  const Vec3 lead{Vec{}, sameLanes<L>(root_lead_), Vec{}};
  const Vec3 v = axes.toBlade(velocity + cross(axes.omega, lead)), w = axes.omegaOfBlade();
  const auto& m = deformation_.moments();
  const Vec3 P = deformation_.rigid(0) * v + cross(w, m.first) + m.first_rate, H = m.second * w + m.deformation_momentum + cross(m.first, v);
  Vec twice = dot(v, P) + dot(w, H) + dot(v, m.first_rate) + dot(w, m.deformation_momentum);
  // Elastic: the modes' stiffness less what rotation at nominal speed contributes to it.
  for (std::size_t i = 0; i < static_cast<std::size_t>(c_.modes); ++i) {
    const Vec q = firstOf<L>(deformation_.modal(i)), rate = secondOf<L>(deformation_.modal(i));
    twice += rate * rate + entry<L>(c_, c_.stiffness, i) * q * q;
  }
  twice -= c_.nominal_mean * (deformation_.form(kFormMean) + deformation_.form(kFormCosine)) - c_.nominal_spin * deformation_.form(kFormSpin) + c_.nominal_lead_v * deformation_.form(kFormOffsetV);
  return 0.5 * twice;
}

template <int L>
LaneVector<L> BladeDynamics<L>::dissipation() const noexcept {
  Vec power{};
  int hinge = 0;
  for (NodeDof slope : {kDofSlopeV, kDofSlopeW}) {
    const Vec rate = deformation_.rootRate(slope);
    power += entry<L>(c_, c_.hinge_damping, static_cast<std::size_t>(hinge++)) * rate * rate;
  }
  for (std::size_t m = 0; m < static_cast<std::size_t>(c_.modes); ++m) {
    const Vec rate = secondOf<L>(deformation_.modal(m));
    power += entry<L>(c_, c_.mode_damping, m) * rate * rate;
  }
  return power;
}

template class BladeDynamics<4>;
template class BladeDynamics<8>;

}  // namespace heerk_rotor
