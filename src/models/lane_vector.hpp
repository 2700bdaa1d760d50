#pragma once
#include <cstring>

namespace heerk_rotor {

/// L values of one quantity, one per blade, as one vector register (a GCC and Clang extension): arithmetic acts on all blades at once.
template <int L>
struct LaneVectorOf {
  typedef double Type __attribute__((vector_size(L * sizeof(double))));
};
template <int L>
using LaneVector = typename LaneVectorOf<L>::Type;

template <int L>
inline LaneVector<L> sameLanes(double value) noexcept { return LaneVector<L>{} + value; }

/// Reads `count` <= L values; the lanes beyond repeat the first value, so that they compute something finite.
template <int L>
inline LaneVector<L> loadLanes(const double* values, int count) noexcept {
  LaneVector<L> lanes;
  if (count == L) {
    std::memcpy(&lanes, values, sizeof lanes);
  } else {
    lanes = sameLanes<L>(values[0]);
    for (int k = 1; k < count; ++k) lanes[k] = values[k];
  }
  return lanes;
}

template <int L>
inline void storeLanes(const LaneVector<L>& lanes, int count, double* values) noexcept {
  if (count == L) std::memcpy(values, &lanes, sizeof lanes);
  else for (int k = 0; k < count; ++k) values[k] = lanes[k];
}

/// A vector of 3 components per blade.
template <int L>
struct Lanes3 {
  LaneVector<L> x, y, z;
};
template <int L> inline Lanes3<L> operator+(const Lanes3<L>& a, const Lanes3<L>& b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <int L> inline Lanes3<L> operator-(const Lanes3<L>& a, const Lanes3<L>& b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <int L> inline Lanes3<L> operator*(const LaneVector<L>& s, const Lanes3<L>& a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
template <int L> inline LaneVector<L> dot(const Lanes3<L>& a, const Lanes3<L>& b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <int L> inline Lanes3<L> cross(const Lanes3<L>& a, const Lanes3<L>& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace heerk_rotor
