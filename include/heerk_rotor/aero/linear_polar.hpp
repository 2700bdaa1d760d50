#pragma once
#include "heerk_rotor/aero/lanes.hpp"

namespace heerk_rotor {

/// Attached flow in closed form, infinitely often differentiable where |alpha| < 45 deg and Mach < kMachLimit:
///   cl = a0 / sqrt(1 - M^2) (alpha - alpha0),   cd = cd0 + cd1 alpha + cd2 alpha^2,   cm = cm0
/// Beyond 45 deg the formulas are continued such that they stay bounded, continuous and periodic: alpha is replaced by its
/// distance from the nearest multiple of 180 deg between 45 deg of it, and falls linearly to zero at 90 deg; alpha0 changes
/// sign for flow from behind. So lift and drag have the right sign in reverse flow. There is no stall.
struct LinearPolar {
  static constexpr double kMachLimit = 0.97;  // higher Mach numbers count as this one, where Prandtl-Glauert gives a factor of 4.1

  double lift_slope = 5.73;       // a0, incompressible [1/rad]
  double zero_lift_angle = 0.0;   // alpha0 [rad]
  double drag[3] = {0.01, 0, 0};  // cd0 [-], cd1 [1/rad], cd2 [1/rad^2]
  double moment = 0.0;            // cm0 about the quarter chord, nose up positive

  /// a0 / sqrt(1 - M^2).
  double slopeAt(double mach) const noexcept;
  /// alpha: in (-pi, pi] [rad]. N is 1, 4 or 8.
  template <int N>
  void at(const Lanes<N>& alpha, const Lanes<N>& mach, Lanes<N>& lift, Lanes<N>& drag, Lanes<N>& moment) const noexcept;
};

}  // namespace heerk_rotor
