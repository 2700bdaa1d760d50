#pragma once
#include "heerk_rotor/aero/lanes.hpp"

namespace heerk_rotor {

struct Air {
  double density = 1.225;         // rho [kg/m^3]
  double speed_of_sound = 340.3;  // [m/s]; infinity for incompressible flow
};

/// What a blade section is, besides its polar.
struct BladeSection {
  double chord = 0.3;          // c [m]
  double elastic_axis = 0.25;  // position of the axis for moments behind the leading edge [parts of c]
  double lift_factor = 1.0;    // on the lift only, see tipLossFactor
};

enum class SectionKinematics {
  kFull,        // all angles, reverse flow included
  kSmallAngle,  // the textbook's: W = |U_T|, phi = U_P / U_T, force along z = lift; no reverse flow. To compare with closed forms.
};

/// Flow at one section of N blades. Unpitched axes: z along the shaft, tangential from leading to trailing edge.
template <int N>
struct SectionFlow {
  Lanes<N> tangential;     // U_T, air relative to the section towards the trailing edge [m/s]; negative in reverse flow
  Lanes<N> perpendicular;  // U_P, air relative to the section along -z [m/s]
  Lanes<N> pitch;          // theta, nose up [rad]
  Lanes<N> lag_angle;      // added to alpha for the polar [rad]: (effective - geometric downwash) / W, 0 for quasi-steady
};

/// Loads of one section of N blades per unit span.
template <int N>
struct SectionLoads {
  Lanes<N> vertical;  // along z [N/m]
  Lanes<N> inplane;   // towards the trailing edge [N/m]
  Lanes<N> moment;    // about the elastic axis, nose up [N]
  Lanes<N> alpha;     // theta - phi + lag_angle in (-pi, pi] [rad] (small angle: not wrapped)
  Lanes<N> mach;      // W / speed of sound
};

/// Blade-element loads with W^2 = U_T^2 + U_P^2, phi = atan2(U_P, U_T), alpha = theta - phi:
///   vertical = dL cos phi - dD sin phi,  inplane = dL sin phi + dD cos phi,  moment = c dM + (x_ea - 1/4) c (force along the section's normal)
/// The cosine of phi is U_T / W. Without wind (W = 0) all loads are zero. A value that is not finite gives loads that are not finite.
/// Polar: LinearPolar or AirfoilTable. N: 1, 4 or 8.
template <int N, class Polar>
void sectionLoads(const BladeSection& section, const Polar& polar, const Air& air, SectionKinematics kinematics, const SectionFlow<N>& flow,
                  SectionLoads<N>& loads) noexcept;

}  // namespace heerk_rotor
