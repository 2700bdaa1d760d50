#pragma once

namespace heerk_rotor {

/// 0 when all values are finite, else not a number: 0 * x is 0 for every finite x, so that the sum tells without a branch
/// per value.
template <class Values>
double nonFinite(const Values& values) noexcept {
  double sum = 0.0;
  for (const double value : values) sum += 0.0 * value;
  return sum;
}

}  // namespace heerk_rotor
