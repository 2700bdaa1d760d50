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

template <int L>
BladeDynamics<L>::BladeDynamics(const FeRotorParameters& p)
    : c_(p, L), root_lead_(p.blades.front().root_lead) {
  const auto size = [](int n) { return static_cast<std::size_t>(n); };
  const std::size_t modes = size(c_.mode_blocks * BladeCoefficients::kBlock), dofs = size(c_.dof_blocks * BladeCoefficients::kBlock);
  state_key_.resize(size(2 * c_.modes * c_.blades));
  for (auto* v : {&q_, &q_rate_, &row_u_, &row_twist_, &row_v_, &row_w_, &modal_load_, &remainder_, &q_acceleration_, &unused_}) v->assign(modes, Vec{});
  for (auto* v : {&d_, &d_rate_, &d_acceleration_}) v->assign(dofs + 2 * kNodeDofs, Vec{});
  for (auto& v : product_) v.assign(dofs, Vec{});
  for (auto* v : {&coriolis_rate_, &nodal_load_}) v->assign(dofs, Vec{});
  unused_.assign(dofs + 2 * kNodeDofs, Vec{});
  load_key_.resize(size(4 * c_.sections * c_.blades));
  acceleration_key_.resize(sizeof(HubAcceleration<L>) / sizeof(double));
}

template <int L>
template <bool equal>
LaneVector<L> BladeDynamics<L>::at(const std::vector<double>& values, std::size_t index) const noexcept {
  if (equal) return sameLanes<L>(values[index]);
  Vec lanes;
  std::memcpy(&lanes, values.data() + index * L, sizeof lanes);
  return lanes;
}

template <int L>
LaneVector<L> BladeDynamics<L>::rigid(int i) const noexcept {
  return c_.copies == 1 ? at<true>(c_.rigid, static_cast<std::size_t>(i)) : at<false>(c_.rigid, static_cast<std::size_t>(i));
}

/// d = V q for two vectors at once, so that each coefficient is read once; four rows at a time, so that additions overlap.
template <int L>
template <bool equal>
void BladeDynamics<L>::toNodes(const Vec* q, const Vec* q_rate, Vec* d, Vec* d_rate) const noexcept {
  constexpr int B = BladeCoefficients::kBlock;
  constexpr std::size_t stride = equal ? 1 : L;
  for (int block = 0; block < c_.dof_blocks; ++block) {
    Vec sum[B] = {}, sum_rate[B] = {};
    const double* a = c_.to_nodes.data() + static_cast<std::size_t>(block) * c_.modes * B * stride;
    for (int i = 0; i < c_.modes; ++i, a += B * stride)
      for (int r = 0; r < B; ++r) {
        const Vec coefficient = equal ? sameLanes<L>(a[r]) : loadLanes<L>(a + r * stride, L);
        sum[r] += coefficient * q[i];
        sum_rate[r] += coefficient * q_rate[i];
      }
    for (int r = 0; r < B; ++r) {
      d[block * B + r] = sum[r];
      d_rate[block * B + r] = sum_rate[r];
    }
  }
}

/// modal = V' nodal for `count` vectors at once.
template <int L>
template <bool equal, int count>
void BladeDynamics<L>::toModes(const Vec* const* nodal, Vec* const* modal) const noexcept {
  constexpr int B = BladeCoefficients::kBlock;
  constexpr std::size_t stride = equal ? 1 : L;
  for (int block = 0; block < c_.mode_blocks; ++block) {
    Vec sum[count][B] = {};
    const double* a = c_.to_modes.data() + static_cast<std::size_t>(block) * c_.dofs * B * stride;
    for (int i = 0; i < c_.dofs; ++i, a += B * stride)
      for (int r = 0; r < B; ++r) {
        const Vec coefficient = equal ? sameLanes<L>(a[r]) : loadLanes<L>(a + r * stride, L);
        for (int n = 0; n < count; ++n) sum[n][r] += coefficient * nodal[n][i];
      }
    for (int n = 0; n < count; ++n)
      for (int r = 0; r < B; ++r) modal[n][block * B + r] = sum[n][r];
  }
}

template <int L>
void BladeDynamics<L>::deform(const double* x) noexcept {
  const std::size_t bytes = state_key_.size() * sizeof(double);
  if (state_valid_ && std::memcmp(x, state_key_.data(), bytes) == 0) return;
  std::memcpy(state_key_.data(), x, bytes);
  state_valid_ = true;
  load_valid_ = acceleration_valid_ = false;
  for (int i = 0; i < c_.modes; ++i) {
    q_[static_cast<std::size_t>(i)] = loadLanes<L>(x + i * c_.blades, c_.blades);
    q_rate_[static_cast<std::size_t>(i)] = loadLanes<L>(x + (c_.modes + i) * c_.blades, c_.blades);
  }
  c_.copies == 1 ? deformImpl<true>() : deformImpl<false>();
}

template <int L>
template <bool equal>
void BladeDynamics<L>::deformImpl() noexcept {
  Vec* const d = d_.data() + kNodeDofs;
  Vec* const rate = d_rate_.data() + kNodeDofs;
  toNodes<equal>(q_.data(), q_rate_.data(), d, rate);
  // Forms: products with d, and those with d' that are needed.
  for (int i = 0; i < kForms; ++i) form_[i] = form_rate_[i] = Vec{};
  rate_shortening_ = rate_offset_v_ = rate_offset_w_ = spin_momentum_ = Vec{};
  constexpr std::size_t stride = equal ? 1 : L;
  const bool offset = c_.forms == kForms;
  for (int i = 0; i < c_.dofs; ++i) {
    const Vec* const column = d_.data() + i / kNodeDofs * kNodeDofs;
    const Vec* const column_rate = d_rate_.data() + i / kNodeDofs * kNodeDofs;
    const double* a = c_.band.data() + static_cast<std::size_t>(i) * BladeCoefficients::kBand * static_cast<std::size_t>(c_.forms) * stride;
    Vec sum[kForms] = {}, shortening_rate{}, coriolis_rate{}, offset_v_rate{}, offset_w_rate{};
    for (int j = 0; j < BladeCoefficients::kBand; ++j, a += static_cast<std::size_t>(c_.forms) * stride) {
      const auto coefficient = [a](int form) { return equal ? sameLanes<L>(a[form]) : loadLanes<L>(a + form * stride, L); };
      for (int form = 0; form < kFormOffsetV; ++form) sum[form] += coefficient(form) * column[j];
      shortening_rate += coefficient(kFormShortening) * column_rate[j];
      coriolis_rate += coefficient(kFormCoriolis) * column_rate[j];
      if (offset) {
        for (int form : {kFormOffsetV, kFormOffsetW}) sum[form] += coefficient(form) * column[j];
        offset_v_rate += coefficient(kFormOffsetV) * column_rate[j];
        offset_w_rate += coefficient(kFormOffsetW) * column_rate[j];
      }
    }
    const std::size_t row = static_cast<std::size_t>(i);
    for (int form = 0; form < c_.forms; ++form) {
      product_[form][row] = sum[form];
      form_[form] += d[i] * sum[form];
      form_rate_[form] += rate[i] * sum[form];
    }
    coriolis_rate_[row] = coriolis_rate;
    rate_shortening_ += rate[i] * shortening_rate;
    rate_offset_v_ += rate[i] * offset_v_rate;
    rate_offset_w_ += rate[i] * offset_w_rate;
    spin_momentum_ -= d[i] * coriolis_rate;
  }

  for (int line = 0; line < kLines; ++line) line_[line] = line_rate_[line] = Vec{};
  for (int i = 0; i < c_.dofs; ++i)
    for (int line = 0; line < kLines; ++line) {
      const Vec coefficient = at<equal>(c_.lines, static_cast<std::size_t>(i * kLines + line));
      line_[line] += coefficient * d[i];
      line_rate_[line] += coefficient * rate[i];
    }

  // Modal loads of hub accelerations that depend on the deformation.
  const Vec* nodal[2] = {product_[kFormShortening].data(), product_[kFormCoriolis].data()};
  Vec* modal[2] = {row_u_.data(), row_twist_.data()};
  toModes<equal, 2>(nodal, modal);
  if (offset) {
    const Vec* nodal_offset[2] = {product_[kFormOffsetV].data(), product_[kFormOffsetW].data()};
    Vec* modal_offset[2] = {row_v_.data(), row_w_.data()};
    toModes<equal, 2>(nodal_offset, modal_offset);
  }
  const auto constant = [this](int row, int i) { return at<equal>(c_.hub_rows, static_cast<std::size_t>(row * c_.modes + i)); };
  for (int i = 0; i < c_.modes; ++i) {
    const std::size_t m = static_cast<std::size_t>(i);
    row_u_[m] = constant(0, i) - row_u_[m];
    row_v_[m] = offset ? constant(1, i) - row_v_[m] : constant(1, i);
    row_w_[m] = offset ? constant(2, i) - row_w_[m] : constant(2, i);
    row_twist_[m] = constant(3, i) + row_twist_[m];
  }
}

template <int L>
SectionMotion<L> BladeDynamics<L>::evaluate(const BladeCoefficients::SectionShape& shape, const std::vector<Vec>& padded) const noexcept {
  const Vec* const left = padded.data() + kNodeDofs + kNodeDofs * shape.element;
  const Vec* const right = left + kNodeDofs;
  const auto cubic = [&](const double (&f)[4], int value) { return f[0] * left[value] + f[1] * left[value + 1] + f[2] * right[value] + f[3] * right[value + 1]; };
  return {cubic(shape.v, kDofV), cubic(shape.v, kDofW), shape.twist[0] * left[kDofTwist] + shape.twist[1] * right[kDofTwist], cubic(shape.slope, kDofV),
          cubic(shape.slope, kDofW)};
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

template <int L>
template <bool equal>
void BladeDynamics<L>::loadImpl(const BladeAxes<L>& axes, const double* loads) noexcept {
  omega_ = axes.omegaOfBlade();
  const Vec xx = omega_.x * omega_.x, yy = omega_.y * omega_.y, zz = omega_.z * omega_.z;
  const Vec mean = yy + zz, cosine = zz - yy, sine = 2.0 * omega_.y * omega_.z;
  const Vec rv = -(omega_.x * omega_.y), rw = -(omega_.x * omega_.z);
  // S contains the stiffness at nominal speed, at zero pitch and with the root lead's centripetal acceleration.
  const Vec mean_excess = mean - c_.nominal_mean, cosine_excess = cosine - c_.nominal_mean, spin_excess = xx - c_.nominal_spin;

  Vec* const f = nodal_load_.data();
  for (int i = 0; i < c_.dofs; ++i) {
    const std::size_t row = static_cast<std::size_t>(i);
    const auto line = [&](int which) { return at<equal>(c_.lines, static_cast<std::size_t>(i * kLines + which)); };
    f[i] = mean * line(kLineMean) + cosine * line(kLineCosine) + sine * line(kLineSine) + xx * line(kLineSpin) + rv * line(kLineRV) + rw * line(kLineRW) -
           mean_excess * product_[kFormMean][row] - cosine_excess * product_[kFormCosine][row] - sine * product_[kFormSine][row] +
           spin_excess * product_[kFormSpin][row] - 2.0 * omega_.x * coriolis_rate_[row];
  }
  if (c_.forms == kForms)  // S was taken with the root lead's centripetal acceleration
    for (int i = 0; i < c_.dofs; ++i) f[i] += c_.nominal_lead_v * product_[kFormOffsetV][static_cast<std::size_t>(i)];
  const Vec* const rate = d_rate_.data() + kNodeDofs;
  f[kDofSlopeV] -= at<equal>(c_.hinge_damping, 0) * rate[kDofSlopeV];
  f[kDofSlopeW] -= at<equal>(c_.hinge_damping, 1) * rate[kDofSlopeW];

  // Airloads: on the nodes by the shape functions, and their resultant.
  const int n = c_.blades;
  air_force_ = air_moment_ = Vec3{};
  for (int j = 0; j < c_.sections; ++j) {
    const BladeCoefficients::SectionShape& shape = c_.shapes[static_cast<std::size_t>(j)];
    const double* section = loads + 4 * j * n;
    const Vec3 force = axes.toBlade({loadLanes<L>(section, n), loadLanes<L>(section + n, n), loadLanes<L>(section + 2 * n, n)});
    const Vec moment = loadLanes<L>(section + 3 * n, n);
    Vec* const left = f + kNodeDofs * shape.element;
    Vec* const right = left + kNodeDofs;
    left[kDofV] += shape.v[0] * force.y;
    left[kDofSlopeV] += shape.v[1] * force.y;
    right[kDofV] += shape.v[2] * force.y;
    right[kDofSlopeV] += shape.v[3] * force.y;
    left[kDofW] += shape.v[0] * force.z;
    left[kDofSlopeW] += shape.v[1] * force.z;
    right[kDofW] += shape.v[2] * force.z;
    right[kDofSlopeW] += shape.v[3] * force.z;
    left[kDofTwist] += shape.twist[0] * moment;
    right[kDofTwist] += shape.twist[1] * moment;
    const SectionMotion<L> at_section = evaluate(shape, d_);
    air_force_ = air_force_ + force;
    air_moment_ = air_moment_ + cross(Vec3{sameLanes<L>(shape.radius), at_section.v, at_section.w}, force);
    air_moment_.x += moment;
  }
  const Vec* nodal[1] = {f};
  Vec* modal[1] = {modal_load_.data()};
  toModes<equal, 1>(nodal, modal);
}

template <int L>
void BladeDynamics<L>::accelerate(const BladeAxes<L>& axes, const HubAcceleration<L>& hub) noexcept {
  if (acceleration_valid_ && std::memcmp(acceleration_key_.data(), &hub, sizeof hub) == 0) return;
  std::memcpy(acceleration_key_.data(), &hub, sizeof hub);
  acceleration_valid_ = true;
  d_acceleration_valid_ = false;
  c_.copies == 1 ? accelerateImpl<true>(axes, hub) : accelerateImpl<false>(axes, hub);
}

template <int L>
template <bool equal>
void BladeDynamics<L>::accelerateImpl(const BladeAxes<L>& axes, const HubAcceleration<L>& hub) noexcept {
  // The origin of B is the root lead ahead of the hub centre; B turns with the pitch as well.
  const Vec3 lead{Vec{}, sameLanes<L>(root_lead_), Vec{}};
  Vec3 origin = hub.linear;
  if (root_lead_ != 0.0) origin = origin + cross(hub.angular, lead) + cross(axes.omega, cross(axes.omega, lead));
  const Vec3 a = axes.toBlade(origin);
  const Vec3 w_R = axes.toBlade(axes.omega);
  Vec3 alpha = axes.toBlade(hub.angular);
  alpha.x += hub.pitch;
  alpha.y += axes.pitch_rate * w_R.z;  // w_R x (theta' e_x)
  alpha.z -= axes.pitch_rate * w_R.y;

  // q'' and the momentum it carries.
  const auto constant = [this](int row, int i) { return at<equal>(c_.hub_rows, static_cast<std::size_t>(row * c_.modes + i)); };
  Vec3 linear{}, angular{};
  for (int i = 0; i < c_.modes; ++i) {
    const std::size_t m = static_cast<std::size_t>(i);
    const Vec row_wy = constant(4, i), row_wz = constant(5, i);
    const Vec load = modal_load_[m] - (row_u_[m] * a.x + row_v_[m] * a.y + row_w_[m] * a.z + row_twist_[m] * alpha.x + row_wy * alpha.y + row_wz * alpha.z);
    remainder_[m] = load;
    const Vec acceleration = load - at<equal>(c_.stiffness, m) * q_[m] - at<equal>(c_.mode_damping, m) * q_rate_[m];
    q_acceleration_[m] = acceleration;
    linear.x += row_u_[m] * acceleration;
    linear.y += row_v_[m] * acceleration;
    linear.z += row_w_[m] * acceleration;
    angular.x += row_twist_[m] * acceleration;
    angular.y += row_wy * acceleration;
    angular.z += row_wz * acceleration;
  }

  const Vec3& w = omega_;
  const MassMoments m = massMoments();
  const Vec3 first_acceleration{linear.x - rate_shortening_, linear.y - rate_offset_v_, linear.z - rate_offset_w_};
  const Vec3 force = rigid(0) * a + cross(alpha, m.first) + sameLanes<L>(2.0) * cross(w, m.first_rate) + cross(w, cross(w, m.first)) + first_acceleration;
  const Vec3 moment = m.inertiaTimes(alpha) + cross(m.first, a) + inertiaRateTimes(w) + cross(w, m.inertiaTimes(w) + m.deformation_momentum) + angular;

  root_force_ = axes.fromBlade(air_force_ - force);
  root_moment_ = axes.fromBlade(air_moment_ - moment);
  if (root_lead_ != 0.0) root_moment_ = root_moment_ + cross(lead, root_force_);
}

template <int L>
SectionMotion<L> BladeDynamics<L>::displacementAcceleration(int j) noexcept {
  if (!d_acceleration_valid_) {
    Vec* const d = d_acceleration_.data() + kNodeDofs;
    Vec* const unused = unused_.data() + kNodeDofs;
    c_.copies == 1 ? toNodes<true>(q_acceleration_.data(), q_acceleration_.data(), d, unused)
                   : toNodes<false>(q_acceleration_.data(), q_acceleration_.data(), d, unused);
    d_acceleration_valid_ = true;
  }
  return evaluate(c_.shapes[static_cast<std::size_t>(j)], d_acceleration_);
}

template <int L>
typename BladeDynamics<L>::MassMoments BladeDynamics<L>::massMoments() const noexcept {
  MassMoments m;
  m.first = {rigid(1) + line_[kLineU] - 0.5 * form_[kFormShortening], rigid(2) + line_[kLineV] - 0.5 * form_[kFormOffsetV],
             rigid(3) + line_[kLineW] - 0.5 * form_[kFormOffsetW]};
  m.first_rate = {line_rate_[kLineU] - form_rate_[kFormShortening], line_rate_[kLineV] - form_rate_[kFormOffsetV],
                  line_rate_[kLineW] - form_rate_[kFormOffsetW]};
  m.deformation_momentum = {spin_momentum_ + line_rate_[kLineTwist], -line_rate_[kLineRW], line_rate_[kLineRV]};
  m.xx = rigid(4) + 2.0 * line_[kLineSpin] + form_[kFormSpin];
  m.yy = rigid(5) + 2.0 * (line_[kLineMean] - line_[kLineCosine]) - form_[kFormMean] + form_[kFormCosine];
  m.zz = rigid(6) + 2.0 * (line_[kLineMean] + line_[kLineCosine]) - form_[kFormMean] - form_[kFormCosine];
  m.xy = rigid(7) - line_[kLineRV];
  m.xz = rigid(8) - line_[kLineRW];
  m.yz = rigid(9) + 2.0 * line_[kLineSine] - form_[kFormSine];
  return m;
}

template <int L>
Lanes3<L> BladeDynamics<L>::inertiaRateTimes(const Vec3& w) const noexcept {
  const Vec xx = 2.0 * (line_rate_[kLineSpin] + form_rate_[kFormSpin]);
  const Vec yy = 2.0 * (line_rate_[kLineMean] - line_rate_[kLineCosine] - form_rate_[kFormMean] + form_rate_[kFormCosine]);
  const Vec zz = 2.0 * (line_rate_[kLineMean] + line_rate_[kLineCosine] - form_rate_[kFormMean] - form_rate_[kFormCosine]);
  const Vec xy = -line_rate_[kLineRV], xz = -line_rate_[kLineRW], yz = 2.0 * (line_rate_[kLineSine] - form_rate_[kFormSine]);
  return {xx * w.x + xy * w.y + xz * w.z, xy * w.x + yy * w.y + yz * w.z, xz * w.x + yz * w.y + zz * w.z};
}

template <int L>
void BladeDynamics<L>::momentum(const BladeAxes<L>& axes, const Vec3& velocity, Vec3& linear_R, Vec3& angular_R) const noexcept {
  const Vec3 lead{Vec{}, sameLanes<L>(root_lead_), Vec{}};
  const Vec3 v = axes.toBlade(velocity + cross(axes.omega, lead)), w = axes.omegaOfBlade();
  const MassMoments m = massMoments();
  linear_R = axes.fromBlade(rigid(0) * v + cross(w, m.first) + m.first_rate);
  angular_R = axes.fromBlade(m.inertiaTimes(w) + m.deformation_momentum + cross(m.first, v)) + cross(lead, linear_R);
}

template <int L>
LaneVector<L> BladeDynamics<L>::energy(const BladeAxes<L>& axes, const Vec3& velocity) const noexcept {
  // With P and H about the origin of B, T = (v.P + w.H + v.S' + w.h + q'.q') / 2.
  const Vec3 lead{Vec{}, sameLanes<L>(root_lead_), Vec{}};
  const Vec3 v = axes.toBlade(velocity + cross(axes.omega, lead)), w = axes.omegaOfBlade();
  const MassMoments m = massMoments();
  const Vec3 P = rigid(0) * v + cross(w, m.first) + m.first_rate, H = m.inertiaTimes(w) + m.deformation_momentum + cross(m.first, v);
  Vec twice = dot(v, P) + dot(w, H) + dot(v, m.first_rate) + dot(w, m.deformation_momentum);
  // Elastic: the modes' stiffness less what rotation at nominal speed contributes to it.
  for (std::size_t i = 0; i < static_cast<std::size_t>(c_.modes); ++i) {
    const Vec stiffness = c_.copies == 1 ? at<true>(c_.stiffness, i) : at<false>(c_.stiffness, i);
    twice += q_rate_[i] * q_rate_[i] + stiffness * q_[i] * q_[i];
  }
  twice -= c_.nominal_mean * (form_[kFormMean] + form_[kFormCosine]) - c_.nominal_spin * form_[kFormSpin] + c_.nominal_lead_v * form_[kFormOffsetV];
  return 0.5 * twice;
}

template <int L>
LaneVector<L> BladeDynamics<L>::dissipation() const noexcept {
  const auto read = [this](const std::vector<double>& values, std::size_t i) { return c_.copies == 1 ? at<true>(values, i) : at<false>(values, i); };
  const Vec* const rate = d_rate_.data() + kNodeDofs;
  Vec power = read(c_.hinge_damping, 0) * rate[kDofSlopeV] * rate[kDofSlopeV] + read(c_.hinge_damping, 1) * rate[kDofSlopeW] * rate[kDofSlopeW];
  for (std::size_t m = 0; m < static_cast<std::size_t>(c_.modes); ++m) power += read(c_.mode_damping, m) * q_rate_[m] * q_rate_[m];
  return power;
}

template struct BladeAxes<4>;
template struct BladeAxes<8>;
template class BladeDynamics<4>;
template class BladeDynamics<8>;

}  // namespace heerk_rotor
