#pragma once
#include <cmath>
#include <cstring>

namespace heerk_rotor {

/// Numbers that one vector register of the processor holds.
#if defined(__AVX512F__)
inline constexpr int kRegisterLanes = 8;
#elif defined(__AVX__)
inline constexpr int kRegisterLanes = 4;
#else
inline constexpr int kRegisterLanes = 2;
#endif

template <int L>
struct WideLanes;

/// L values of one quantity, one per blade: arithmetic acts on all blades at once. One vector register (a GCC and Clang extension) where
/// that holds so many, otherwise two halves.
template <int L, bool wide = (L > kRegisterLanes)>
struct LaneVectorOf {
  typedef double Type __attribute__((vector_size(L * sizeof(double))));
};
template <int L>
struct LaneVectorOf<L, true> {
  using Type = WideLanes<L>;
};
template <int L>
using LaneVector = typename LaneVectorOf<L>::Type;

template <int L>
struct WideLanes {
  using Half = LaneVector<L / 2>;
  Half low, high;

  WideLanes() noexcept : low{}, high{} {}
  WideLanes(const Half& low_, const Half& high_) noexcept : low(low_), high(high_) {}
  // Register by register: compilers copy plain structures in smaller pieces, for which a register that is read next has to wait.
  WideLanes(const WideLanes& b) noexcept : low(b.low), high(b.high) {}
  WideLanes& operator=(const WideLanes& b) noexcept { low = b.low; high = b.high; return *this; }

  double& operator[](int k) noexcept { return reinterpret_cast<double*>(this)[k]; }
  const double& operator[](int k) const noexcept { return reinterpret_cast<const double*>(this)[k]; }
  WideLanes operator-() const noexcept { return {-low, -high}; }
  WideLanes& operator+=(const WideLanes& b) noexcept { low += b.low; high += b.high; return *this; }
  WideLanes& operator+=(double b) noexcept { low += b; high += b; return *this; }
  WideLanes& operator-=(const WideLanes& b) noexcept { low -= b.low; high -= b.high; return *this; }
  friend WideLanes operator+(const WideLanes& a, const WideLanes& b) noexcept { return {a.low + b.low, a.high + b.high}; }
  friend WideLanes operator-(const WideLanes& a, const WideLanes& b) noexcept { return {a.low - b.low, a.high - b.high}; }
  friend WideLanes operator*(const WideLanes& a, const WideLanes& b) noexcept { return {a.low * b.low, a.high * b.high}; }
  friend WideLanes operator/(const WideLanes& a, const WideLanes& b) noexcept { return {a.low / b.low, a.high / b.high}; }
  friend WideLanes operator+(const WideLanes& a, double b) noexcept { return {a.low + b, a.high + b}; }
  friend WideLanes operator-(const WideLanes& a, double b) noexcept { return {a.low - b, a.high - b}; }
  friend WideLanes operator*(const WideLanes& a, double b) noexcept { return {a.low * b, a.high * b}; }
  friend WideLanes operator/(const WideLanes& a, double b) noexcept { return {a.low / b, a.high / b}; }
  friend WideLanes operator+(double a, const WideLanes& b) noexcept { return {a + b.low, a + b.high}; }
  friend WideLanes operator-(double a, const WideLanes& b) noexcept { return {a - b.low, a - b.high}; }
  friend WideLanes operator*(double a, const WideLanes& b) noexcept { return {a * b.low, a * b.high}; }
  friend WideLanes operator/(double a, const WideLanes& b) noexcept { return {a / b.low, a / b.high}; }
};

/// Less zero changes no value, so that compilers only copy; plus zero would change -0.
template <int L>
inline LaneVector<L> sameLanes(double value) noexcept { return value - LaneVector<L>{}; }

/// L values that lie side by side.
template <int L>
inline LaneVector<L> readLanes(const double* values) noexcept {
  if constexpr (L > kRegisterLanes) {
    return {readLanes<L / 2>(values), readLanes<L / 2>(values + L / 2)};
  } else {
    LaneVector<L> lanes;
    std::memcpy(&lanes, values, sizeof lanes);
    return lanes;
  }
}

template <int L>
inline void writeLanes(const LaneVector<L>& lanes, double* values) noexcept {
  if constexpr (L > kRegisterLanes) {
    writeLanes<L / 2>(lanes.low, values);
    writeLanes<L / 2>(lanes.high, values + L / 2);
  } else {
    std::memcpy(values, &lanes, sizeof lanes);
  }
}

/// Reads `count` <= L values; the lanes beyond repeat the first value, so that they compute something finite.
template <int L>
inline LaneVector<L> loadLanes(const double* values, int count) noexcept {
  if (count == L) return readLanes<L>(values);
  double lanes[L];
  for (int k = 0; k < L; ++k) lanes[k] = values[k < count ? k : 0];
  return readLanes<L>(lanes);
}

template <int L>
inline void storeLanes(const LaneVector<L>& lanes, int count, double* values) noexcept {
  if (count == L) writeLanes<L>(lanes, values);
  else for (int k = 0; k < count; ++k) values[k] = lanes[k];
}

/// Two quantities of all blades side by side, for what is done alike to both.
template <int L>
inline LaneVector<2 * L> joinLanes(const LaneVector<L>& first, const LaneVector<L>& second) noexcept {
  if constexpr (2 * L > kRegisterLanes) {
    return {first, second};
  } else {
    double both[2 * L];
    writeLanes<L>(first, both);
    writeLanes<L>(second, both + L);
    return readLanes<2 * L>(both);
  }
}
template <int L>
inline LaneVector<L> firstOf(const LaneVector<2 * L>& both) noexcept {
  if constexpr (2 * L > kRegisterLanes) return both.low;
  else return readLanes<L>(reinterpret_cast<const double*>(&both));
}
template <int L>
inline LaneVector<L> secondOf(const LaneVector<2 * L>& both) noexcept {
  if constexpr (2 * L > kRegisterLanes) return both.high;
  else return readLanes<L>(reinterpret_cast<const double*>(&both) + L);
}

template <int L>
inline LaneVector<2 * L> repeatLanes(const LaneVector<L>& lanes) noexcept { return joinLanes<L>(lanes, lanes); }

template <int L>
inline LaneVector<L> squareRoot(const LaneVector<L>& square) noexcept {
  if constexpr (L > kRegisterLanes) {
    return {squareRoot<L / 2>(square.low), squareRoot<L / 2>(square.high)};
  } else {
    double values[L];
    std::memcpy(values, &square, sizeof values);
    for (double& value : values) value = std::sqrt(value);
    return readLanes<L>(values);
  }
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
