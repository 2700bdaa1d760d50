#pragma once

namespace heerk_rotor {

/// N values of one quantity, one per blade: the innermost dimension of everything computed for all blades at once.
template <int N>
struct alignas(N * sizeof(double) <= 64 ? N * sizeof(double) : 64) Lanes {
  double value[N];
  double& operator[](int k) { return value[k]; }
  const double& operator[](int k) const { return value[k]; }
};

}  // namespace heerk_rotor
