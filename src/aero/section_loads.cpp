#include "heerk_rotor/aero/section_loads.hpp"

#include <cmath>
#include <type_traits>

#include "heerk_rotor/aero/airfoil_table.hpp"
#include "heerk_rotor/aero/linear_polar.hpp"
#include "heerk_rotor/core/branch_free_math.hpp"

namespace heerk_rotor {
namespace {

/// Moment of the force at the quarter chord about the elastic axis. The normal of a section with pitch theta is
/// z cos theta + (towards the trailing edge) sin theta; at zero offset the trigonometry is not needed.
template <int N>
void addOffsetMoment(const BladeSection& section, const Lanes<N>& pitch, SectionLoads<N>& loads) noexcept {
  const double arm = (section.elastic_axis - 0.25) * section.chord;
  if (arm == 0.0) return;
  for (int k = 0; k < N; ++k) {
    const SineCosine theta = sineCosine(pitch[k]);
    loads.moment[k] += arm * (loads.vertical[k] * theta.cosine + loads.inplane[k] * theta.sine);
  }
}

template <int N, class Polar>
void fullLoads(const BladeSection& section, const Polar& polar, const Air& air, const SectionFlow<N>& flow, SectionLoads<N>& loads) noexcept {
  const double half_rho_c = 0.5 * air.density * section.chord, inverse_sound = 1.0 / air.speed_of_sound;
  Lanes<N> speed, alpha, mach, lift, drag, moment;
  for (int k = 0; k < N; ++k) {
    const double ut = flow.tangential[k], up = flow.perpendicular[k];
    speed[k] = std::sqrt(ut * ut + up * up);
    mach[k] = speed[k] * inverse_sound;
    alpha[k] = wrapAngle(flow.pitch[k] - arcTangent2(up, ut) + flow.lag_angle[k]);
  }
  polar.at(alpha, mach, lift, drag, moment);
  for (int k = 0; k < N; ++k) {
    // rho/2 c W^2 cl cos phi = (rho/2 c W) cl U_T
    const double q = half_rho_c * speed[k], cl = lift[k] * section.lift_factor;
    loads.vertical[k] = q * (cl * flow.tangential[k] - drag[k] * flow.perpendicular[k]);
    loads.inplane[k] = q * (cl * flow.perpendicular[k] + drag[k] * flow.tangential[k]);
    loads.moment[k] = q * speed[k] * section.chord * moment[k];
  }
  loads.alpha = alpha;
  loads.mach = mach;
}

/// phi = U_P / U_T; where U_T = 0 the loads vanish whatever phi is.
double smallInflowAngle(double ut, double up) noexcept { return ut == 0.0 ? 0.0 : up / ut; }

template <int N>
void smallAngleLoads(const BladeSection& section, const AirfoilTable& polar, const Air& air, const SectionFlow<N>& flow, SectionLoads<N>& loads) noexcept {
  const double half_rho_c = 0.5 * air.density * section.chord;
  Lanes<N> alpha, mach, lift, drag, moment;
  for (int k = 0; k < N; ++k) {
    alpha[k] = flow.pitch[k] - smallInflowAngle(flow.tangential[k], flow.perpendicular[k]) + flow.lag_angle[k];
    mach[k] = std::abs(flow.tangential[k]) / air.speed_of_sound;
  }
  polar.at(alpha, mach, lift, drag, moment);
  for (int k = 0; k < N; ++k) {
    const double ut = flow.tangential[k], q = half_rho_c * ut, cl = lift[k] * section.lift_factor;
    loads.vertical[k] = q * cl * ut;
    loads.inplane[k] = q * (cl * flow.perpendicular[k] + drag[k] * ut);
    loads.moment[k] = q * ut * section.chord * moment[k];
  }
  loads.alpha = alpha;
  loads.mach = mach;
}

/// Multiplied out with e = alpha U_T = theta U_T - U_P, so that nothing is divided by U_T: a polynomial in the flow, whose
/// integrals over the disc are the textbook's.
template <int N>
void smallAngleLoads(const BladeSection& section, const LinearPolar& polar, const Air& air, const SectionFlow<N>& flow, SectionLoads<N>& loads) noexcept {
  const double half_rho_c = 0.5 * air.density * section.chord;
  for (int k = 0; k < N; ++k) {
    const double ut = flow.tangential[k], up = flow.perpendicular[k], mach = std::abs(ut) / air.speed_of_sound;
    const double e = (flow.pitch[k] + flow.lag_angle[k]) * ut - up;
    const double lift = section.lift_factor * polar.slopeAt(mach) * (e - polar.zero_lift_angle * ut);
    loads.vertical[k] = half_rho_c * lift * ut;
    loads.inplane[k] = half_rho_c * (lift * up + polar.drag[0] * ut * ut + polar.drag[1] * e * ut + polar.drag[2] * e * e);
    loads.moment[k] = half_rho_c * section.chord * polar.moment * ut * ut;
    loads.alpha[k] = flow.pitch[k] + flow.lag_angle[k] - smallInflowAngle(ut, up);
    loads.mach[k] = mach;
  }
}

}  // namespace

double LinearPolar::slopeAt(double mach) const noexcept {
  const double m = mach > kMachLimit ? kMachLimit : mach;  // NaN stays NaN
  return lift_slope / std::sqrt(1.0 - m * m);
}

template <int N>
void LinearPolar::at(const Lanes<N>& alpha, const Lanes<N>& mach, Lanes<N>& lift, Lanes<N>& drag_, Lanes<N>& moment_) const noexcept {
  for (int k = 0; k < N; ++k) {
    const double size = std::abs(alpha[k]), behind = M_PI - size;
    // 1 up to 45 deg, -1 from 135 deg on, linear between
    double forward = (0.5 * M_PI - size) * (4.0 / M_PI);
    forward = forward > 1.0 ? 1.0 : forward;
    forward = forward < -1.0 ? -1.0 : forward;
    double angle = 0.5 * M_PI - size;  // between 45 and 135 deg
    angle = size < 0.25 * M_PI ? size : angle;
    angle = behind < 0.25 * M_PI ? -behind : angle;
    angle = std::copysign(1.0, alpha[k]) * angle;
    lift[k] = slopeAt(mach[k]) * (angle - zero_lift_angle * forward);
    drag_[k] = drag[0] + angle * (drag[1] + angle * drag[2]);
    moment_[k] = moment;
  }
}

template <int N, class Polar>
void sectionLoads(const BladeSection& section, const Polar& polar, const Air& air, SectionKinematics kinematics, const SectionFlow<N>& flow,
                  SectionLoads<N>& loads) noexcept {
  if (kinematics == SectionKinematics::kFull)
    fullLoads(section, polar, air, flow, loads);
  else
    smallAngleLoads(section, polar, air, flow, loads);
  addOffsetMoment(section, flow.pitch, loads);
}

#define HEERK_INSTANTIATE(N)                                                                                                                  \
  template void LinearPolar::at<N>(const Lanes<N>&, const Lanes<N>&, Lanes<N>&, Lanes<N>&, Lanes<N>&) const noexcept;                         \
  template void sectionLoads<N, LinearPolar>(const BladeSection&, const LinearPolar&, const Air&, SectionKinematics, const SectionFlow<N>&,        \
                                             SectionLoads<N>&) noexcept;                                                                      \
  template void sectionLoads<N, AirfoilTable>(const BladeSection&, const AirfoilTable&, const Air&, SectionKinematics, const SectionFlow<N>&,      \
                                              SectionLoads<N>&) noexcept;
HEERK_INSTANTIATE(1)
HEERK_INSTANTIATE(4)
HEERK_INSTANTIATE(8)

}  // namespace heerk_rotor
