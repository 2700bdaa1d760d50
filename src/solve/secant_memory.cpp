#include "heerk_rotor/solve/secant_memory.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace heerk_rotor {
namespace {
// Pieces of whole registers, then one by one: unknowns are few.
using Lanes = Eigen::Array<double, 4, 1>;
using Load = Eigen::Map<const Lanes>;
constexpr Index kLanes = Lanes::RowsAtCompileTime;
constexpr double kNearlySingular = 1e-3;  // of what a new pair divides by, in parts of |s|^2

inline double dot(const double* left, const double* right, Index size) noexcept {
  Lanes sums = Lanes::Zero();
  double rest = 0.0;
  Index i = 0;
  for (; i + kLanes <= size; i += kLanes) sums += Load(left + i) * Load(right + i);
#pragma GCC unroll 1
  for (; i < size; ++i) rest += left[i] * right[i];
  return size < kLanes ? rest : sums.sum() + rest;
}

inline void add(double factor, const double* from, double* to, Index size) noexcept {
  Index i = 0;
  for (; i + kLanes <= size; i += kLanes) Eigen::Map<Lanes>(to + i) += factor * Load(from + i);
#pragma GCC unroll 1
  for (; i < size; ++i) to[i] += factor * from[i];
}

}  // namespace

SecantMemory::SecantMemory(Index unknowns) : size_(unknowns), a_(Vector::Zero(unknowns * kPairs)), b_(a_) {}

void SecantMemory::improve(double* residual) const noexcept {
  double share[kPairs];
  for (Index k = 0; k < count_; ++k) share[k] = dot(b(k), residual, size_);
  for (Index k = 0; k < count_; ++k) add(share[k], a(k), residual, size_);
}

void SecantMemory::learn(const double* s, const double* r_new, double* left) noexcept {
  const double square = dot(s, s, size_), along = dot(s, left, size_), denominator = square - along;
  if (!(std::abs(denominator) > kNearlySingular * square)) return;  // also refuses what is not finite
  if (count_ == kPairs) {
    clear();
    std::copy_n(r_new, size_, left);
    return;
  }
  double* const b_new = b(count_);
  std::copy_n(s, size_, b_new);
  for (Index k = 0; k < count_; ++k) add(dot(a(k), s, size_), b(k), b_new, size_);
  for (Index i = 0; i < size_; ++i) a(count_)[i] = left[i] / denominator;
  ++count_;
  // H_new p = left + a (b' p), and b' p = s' H p = s' left.
  const double factor = 1.0 + along / denominator;
  for (Index i = 0; i < size_; ++i) left[i] *= factor;
}

std::vector<double> SecantMemory::values() const {
  std::vector<double> values{static_cast<double>(count_)};
  values.insert(values.end(), a_.begin(), a_.end());
  values.insert(values.end(), b_.begin(), b_.end());
  return values;
}

void SecantMemory::restore(const std::vector<double>& values) {
  const std::size_t expected = 1 + 2 * static_cast<std::size_t>(a_.size());
  if (values.size() != expected) throw std::invalid_argument("memory of secants: " + std::to_string(values.size()) + " numbers, expected " + std::to_string(expected));
  if (!(values[0] >= 0.0 && values[0] <= static_cast<double>(kPairs))) throw std::invalid_argument("memory of secants: " + std::to_string(values[0]) + " pairs, expected at most " + std::to_string(kPairs));
  count_ = static_cast<Index>(values[0]);
  std::copy_n(values.begin() + 1, a_.size(), a_.begin());
  std::copy_n(values.begin() + 1 + a_.size(), b_.size(), b_.begin());
}

}  // namespace heerk_rotor
