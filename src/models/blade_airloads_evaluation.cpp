// The part of BladeAirloads that runs at every evaluation, all blades of a section at once.
#include <cmath>
#include <cstring>

#include "heerk_rotor/core/branch_free_math.hpp"
#include "heerk_rotor/models/blade_airloads.hpp"

namespace heerk_rotor {
namespace {

/// Values of all blades; lanes beyond the last blade repeat the first blade, so that they hold ordinary numbers. Whole lanes are moved at
/// once: memcpy becomes one vector instruction, where lane by lane stalls the vector operations that follow.
template <int N>
inline void load(const double* from, int blades, Lanes<N>& to) noexcept {
  if (blades == N) {
    std::memcpy(to.value, from, sizeof to.value);
  } else {
    for (int k = 0; k < N; ++k) to[k] = from[k < blades ? k : 0];
  }
}

template <int N>
inline void store(const Lanes<N>& from, int blades, double* to) noexcept {
  if (blades == N) {
    std::memcpy(to, from.value, sizeof from.value);
  } else {
    for (int k = 0; k < blades; ++k) to[k] = from[k];
  }
}

template <int N>
struct Vector3 {
  Lanes<N> x, y, z;
};

/// Component c of entry `section` of a port with `components`.
template <int N>
inline void load(const double* port, Index section, Index components, Index c, int blades, Lanes<N>& to) noexcept {
  load<N>(port + sectionEntry(section, c, components, 0, blades), blades, to);
}

template <int N>
inline void load(const double* port, Index section, Index components, Index c, int blades, Vector3<N>& to) noexcept {
  load<N>(port, section, components, c, blades, to.x);
  load<N>(port, section, components, c + 1, blades, to.y);
  load<N>(port, section, components, c + 2, blades, to.z);
}

}  // namespace

/// What holds for whole blades: R_k in hub_link is e_r = (-cos psi_k, -sin psi_k, 0), y = (sin psi_k, -cos psi_k, 0), z.
template <int N>
struct BladeAirloads::Blades {
  Lanes<N> cosine, sine;  // of psi_k
  Vector3<N> wind;        // in R_k [m/s]
  Vector3<N> rates;       // of R_k relative to space, in R_k [rad/s]; only when section_pitch_rate is read
};

/// One section of all blades.
template <int N>
struct BladeAirloads::Flow {
  Vector3<N> t, n;            // section axes before pitch, in R_k
  Lanes<N> r_sine, r_cosine;  // r/R sin psi and r/R cos psi, where inflow and rotor loads are taken
  Lanes<N> pitch_rate;        // theta' about the section's span, relative to space [rad/s]
  Lanes<N> sine, cosine;      // of the pitch theta; 0 and 1 with small angles. Only with lag states or virtual mass
  Lanes<N> chordwise;         // flow along the chord towards the trailing edge [m/s]; likewise
  SectionFlow<N> air;
};

template <int N>
void BladeAirloads::readFlow(Index j, const Blades<N>& blades, const double* u, Flow<N>& flow) const noexcept {
  const int count = p_.sections.blades;
  const double radius = p_.sections.r[j] / p_.sections.radius, tip_speed = p_.rotor_speed * p_.sections.radius;
  const double l0 = u[in_.inflow], l1s = u[in_.inflow + 1], l1c = u[in_.inflow + 2];
  if (p_.inflow_position == InflowPosition::kUndeformed) {
    for (int k = 0; k < N; ++k) {
      flow.r_sine[k] = radius * blades.sine[k];
      flow.r_cosine[k] = radius * blades.cosine[k];
    }
  } else {
    // x e_r + y e_y: its azimuth is atan2(-left, -forward) component, so r sin psi = -left and r cos psi = -forward.
    Lanes<N> x, y;
    load<N>(u + in_.position, j, 3, 0, count, x);
    load<N>(u + in_.position, j, 3, 1, count, y);
    const double scale = 1.0 / p_.sections.radius;
    for (int k = 0; k < N; ++k) {
      flow.r_sine[k] = scale * (x[k] * blades.sine[k] + y[k] * blades.cosine[k]);
      flow.r_cosine[k] = scale * (x[k] * blades.cosine[k] - y[k] * blades.sine[k]);
    }
  }
  Vector3<N> velocity;
  load<N>(u + in_.velocity, j, 3, 0, count, velocity);
  load<N>(u + in_.axes, j, 6, 0, count, flow.t);
  load<N>(u + in_.axes, j, 6, 3, count, flow.n);
  load<N>(u + in_.pitch, j, 1, 0, count, flow.air.pitch);
  for (int k = 0; k < N; ++k) {
    const double induced = tip_speed * (l0 + l1s * flow.r_sine[k] + l1c * flow.r_cosine[k]);
    // The section's velocity through the air, -V.
    const double x = velocity.x[k] - blades.wind.x[k], y = velocity.y[k] - blades.wind.y[k], z = velocity.z[k] - blades.wind.z[k] + induced;
    flow.air.tangential[k] = x * flow.t.x[k] + y * flow.t.y[k] + z * flow.t.z[k];
    flow.air.perpendicular[k] = x * flow.n.x[k] + y * flow.n.y[k] + z * flow.n.z[k];
    flow.air.lag_angle[k] = 0.0;
  }
  if (!readsPitchRate()) return;
  load<N>(u + in_.pitch_rate, j, 1, 0, count, flow.pitch_rate);
  for (int k = 0; k < N; ++k) {
    const double span_x = flow.t.y[k] * flow.n.z[k] - flow.t.z[k] * flow.n.y[k];
    const double span_y = flow.t.z[k] * flow.n.x[k] - flow.t.x[k] * flow.n.z[k];
    const double span_z = flow.t.x[k] * flow.n.y[k] - flow.t.y[k] * flow.n.x[k];
    flow.pitch_rate[k] += blades.rates.x[k] * span_x + blades.rates.y[k] * span_y + blades.rates.z[k] * span_z;
  }
  if (flow_arm_ == 0.0) return;
  const double arm = flow_arm_ * geometry_[j].chord;
  for (int k = 0; k < N; ++k) flow.air.perpendicular[k] -= arm * flow.pitch_rate[k];  // nose up moves what is behind the axis down
}

/// Chordwise flow and the direction of the chord, for the options that need them.
template <int N>
static void alongChord(SectionKinematics kinematics, const SectionFlow<N>& air, Lanes<N>& sine, Lanes<N>& cosine, Lanes<N>& chordwise) noexcept {
  const bool full = kinematics == SectionKinematics::kFull;
  for (int k = 0; k < N; ++k) {
    const SineCosine pitch = sineCosine(air.pitch[k]);
    sine[k] = full ? pitch.sine : 0.0;
    cosine[k] = full ? pitch.cosine : 1.0;
    chordwise[k] = air.tangential[k] * cosine[k] + air.perpendicular[k] * sine[k];
  }
}

/// Sets the lag angle from the states and writes the states' rates.
/// The lag angle turns the flow such that its part along the chord stays and its part w across the chord becomes the effective one.
template <int N>
void BladeAirloads::applyLag(Index j, const double* x, Flow<N>& flow, Results& results) const noexcept {
  const int count = p_.sections.blades;
  const double inverse_sound = 1.0 / polar_air_.speed_of_sound;
  Lanes<N> z[2], zdot[2], downwash, effective, speed;
  for (int i = 0; i < 2; ++i) load<N>(x, j, 2, i, count, z[i]);
  const bool full = p_.kinematics == SectionKinematics::kFull, beddoes = p_.unsteady == Unsteady::kBeddoes;
  for (int k = 0; k < N; ++k) {
    const double ut = flow.air.tangential[k], up = flow.air.perpendicular[k];
    downwash[k] = full ? ut * flow.sine[k] - up * flow.cosine[k] : flow.air.pitch[k] * ut - up;
    speed[k] = full ? std::sqrt(ut * ut + up * up) : std::abs(ut);
  }
  lag_.effectiveDownwash(downwash, z, effective);
  for (int k = 0; k < N; ++k) {
    const double w = downwash[k], change = effective[k] - w, chordwise = flow.chordwise[k];
    if (full)
      flow.air.lag_angle[k] = arcTangent2(chordwise * change, chordwise * chordwise + w * effective[k]);
    else
      flow.air.lag_angle[k] = chordwise == 0.0 ? 0.0 : change / chordwise;
    if (beddoes) {  // compressibility slows the lag as if the section were slower
      double mach = speed[k] * inverse_sound;
      mach = mach > LinearPolar::kMachLimit ? LinearPolar::kMachLimit : mach;
      speed[k] *= 1.0 - mach * mach;
    }
  }
  lag_.derivatives(geometry_[j].chord, speed, downwash, z, zdot);
  for (int i = 0; i < 2; ++i) {
    const Index at = sectionEntry(j, i, 2, 0, count);
    store(zdot[i], count, results.xdot.data() + at);
    for (int k = 0; k < count; ++k) results.steady_x[at + k] = lag_.steadyState(i, downwash[k]);
  }
}

template <int N>
void BladeAirloads::addVirtualMass(Index j, const double* u, const Flow<N>& flow, SectionLoads<N>& loads) const noexcept {
  Vector3<N> acceleration;
  load<N>(u + in_.acceleration, j, 3, 0, p_.sections.blades, acceleration);
  const double chord = geometry_[j].chord, mass = 0.25 * M_PI * p_.air.density * chord * chord;
  const double to_middle = (0.5 - p_.elastic_axis) * chord, to_rear = (0.75 - p_.elastic_axis) * chord;
  for (int k = 0; k < N; ++k) {
    const double along_n = acceleration.x[k] * flow.n.x[k] + acceleration.y[k] * flow.n.y[k] + acceleration.z[k] * flow.n.z[k];
    const double along_t = acceleration.x[k] * flow.t.x[k] + acceleration.y[k] * flow.t.y[k] + acceleration.z[k] * flow.t.z[k];
    const double inertial = -mass * (along_n * flow.cosine[k] - along_t * flow.sine[k]);  // at mid-chord
    const double turning = mass * flow.chordwise[k] * flow.pitch_rate[k];                 // at three quarters of the chord
    loads.vertical[k] += (inertial + turning) * flow.cosine[k];
    loads.inplane[k] += (inertial + turning) * flow.sine[k];
    loads.moment[k] -= to_middle * inertial + to_rear * turning;
  }
}

template <int N>
void BladeAirloads::evaluate(const double* x, const double* u, Results& results) const noexcept {
  const int count = p_.sections.blades;
  const auto [s1, c1] = sineCosine(u[in_.motion]);
  Blades<N> blades;
  for (int k = 0; k < N; ++k) {
    const double c = c1 * turn_cosine_[k] - s1 * turn_sine_[k], s = s1 * turn_cosine_[k] + c1 * turn_sine_[k];
    blades.cosine[k] = c;
    blades.sine[k] = s;
    const double* const wind = u + in_.wind;
    blades.wind.x[k] = -c * wind[0] - s * wind[1];
    blades.wind.y[k] = s * wind[0] - c * wind[1];
    blades.wind.z[k] = wind[2];
    if (!readsPitchRate()) continue;
    const double* const rates = u + in_.mount + 3;
    blades.rates.x[k] = -c * rates[0] - s * rates[1];
    blades.rates.y[k] = s * rates[0] - c * rates[1];
    blades.rates.z[k] = rates[2] + u[in_.motion + 1];
  }

  const bool lag = p_.unsteady != Unsteady::kNone;
  Lanes<N> thrust{}, sine_part{}, cosine_part{};
  for (Index j = 0; j < p_.sections.count(); ++j) {
    Flow<N> flow;
    readFlow(j, blades, u, flow);
    if (lag || p_.virtual_mass) alongChord(p_.kinematics, flow.air, flow.sine, flow.cosine, flow.chordwise);
    if (lag) applyLag(j, x, flow, results);

    SectionLoads<N> loads;
    if (p_.polars.tabulated())
      sectionLoads(geometry_[j], p_.polars.tables[p_.polars.table_of_section[j]], polar_air_, p_.kinematics, flow.air, loads);
    else
      sectionLoads(geometry_[j], p_.polars.linear, polar_air_, p_.kinematics, flow.air, loads);
    if (p_.virtual_mass) addVirtualMass(j, u, flow, loads);
    if (!p_.compressible) {
      for (int k = 0; k < N; ++k) {
        const double ut = flow.air.tangential[k], up = p_.kinematics == SectionKinematics::kFull ? flow.air.perpendicular[k] : 0.0;
        loads.mach[k] = std::sqrt(ut * ut + up * up) / p_.air.speed_of_sound;
      }
    }

    const double width = p_.sections.width[j];
    Vector3<N> force;
    for (int k = 0; k < N; ++k) {
      const double normal = width * loads.vertical[k], forward = -width * loads.inplane[k];
      force.x[k] = normal * flow.n.x[k] + forward * flow.t.x[k];
      force.y[k] = normal * flow.n.y[k] + forward * flow.t.y[k];
      force.z[k] = normal * flow.n.z[k] + forward * flow.t.z[k];
      loads.moment[k] *= width;
    }
    double* const out = results.loads.data() + sectionEntry(j, 0, 4, 0, count);
    store(force.x, count, out);
    store(force.y, count, out + count);
    store(force.z, count, out + 2 * count);
    store(loads.moment, count, out + 3 * count);
    store(loads.alpha, count, results.alpha.data() + j * count);
    store(loads.mach, count, results.mach.data() + j * count);
    for (int k = 0; k < N; ++k) {
      thrust[k] += force.z[k];
      sine_part[k] += flow.r_sine[k] * force.z[k];
      cosine_part[k] += flow.r_cosine[k] * force.z[k];
    }
  }
  double sums[3] = {};
  for (int k = 0; k < count; ++k) {
    sums[0] += thrust[k];
    sums[1] += sine_part[k];
    sums[2] += cosine_part[k];
  }
  for (int i = 0; i < 3; ++i) results.rotor_loads[i] = sums[i] / reference_force_;
}

template void BladeAirloads::evaluate<4>(const double*, const double*, Results&) const noexcept;
template void BladeAirloads::evaluate<8>(const double*, const double*, Results&) const noexcept;

}  // namespace heerk_rotor
