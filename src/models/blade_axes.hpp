#pragma once
#include "lane_vector.hpp"

namespace heerk_rotor {

/// How the axes of the blades move: rotating blade axes R (x outboard, y toward the leading edge, z along the shaft) and the blades' own
/// pitched axes B (R turned up by the precone, then nose up by the pitch), per blade.
template <int L>
struct BladeAxes {
  LaneVector<L> sine, cosine;             // of the azimuth of each blade
  LaneVector<L> pitch_sine, pitch_cosine;
  Lanes3<L> omega;                        // angular velocity of R, in R [rad/s]
  LaneVector<L> pitch_rate;               // [rad/s]
  LaneVector<L> speed;                    // of the rotor relative to the mount [rad/s]
  LaneVector<L> precone_sine, precone_cosine;

  Lanes3<L> toBlade(const Lanes3<L>& v_R) const noexcept;     // R to B
  Lanes3<L> fromBlade(const Lanes3<L>& v_B) const noexcept;   // B to R
  Lanes3<L> fromHub(const double* v_H) const noexcept;        // hub_link to R
  Lanes3<L> toHub(const Lanes3<L>& v_R) const noexcept;
  Lanes3<L> omegaOfBlade() const noexcept;                    // angular velocity of B, in B
};

template <int L>
inline Lanes3<L> BladeAxes<L>::toBlade(const Lanes3<L>& v) const noexcept {
  const LaneVector<L> up = precone_cosine * v.z - precone_sine * v.x;
  return {precone_cosine * v.x + precone_sine * v.z, pitch_cosine * v.y + pitch_sine * up, pitch_cosine * up - pitch_sine * v.y};
}

template <int L>
inline Lanes3<L> BladeAxes<L>::fromBlade(const Lanes3<L>& v) const noexcept {
  const LaneVector<L> up = pitch_sine * v.y + pitch_cosine * v.z;
  return {precone_cosine * v.x - precone_sine * up, pitch_cosine * v.y - pitch_sine * v.z, precone_sine * v.x + precone_cosine * up};
}

template <int L>
inline Lanes3<L> BladeAxes<L>::fromHub(const double* v) const noexcept {
  return {-(cosine * v[0] + sine * v[1]), sine * v[0] - cosine * v[1], sameLanes<L>(v[2])};
}

template <int L>
inline Lanes3<L> BladeAxes<L>::toHub(const Lanes3<L>& v) const noexcept {
  return {sine * v.y - cosine * v.x, -(sine * v.x + cosine * v.y), v.z};
}

template <int L>
inline Lanes3<L> BladeAxes<L>::omegaOfBlade() const noexcept {
  Lanes3<L> w = toBlade(omega);
  w.x += pitch_rate;
  return w;
}

}  // namespace heerk_rotor
