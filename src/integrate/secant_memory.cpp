#include "secant_memory.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace heerk_rotor {

void SecantMemory::improve(Vector& residual) const noexcept {
  double share[kPairs];
  for (Index k = 0; k < count_; ++k) share[k] = b_.col(k).dot(residual);
  for (Index k = 0; k < count_; ++k) residual += share[k] * a_.col(k);
}

void SecantMemory::learn(const Vector& s, const Vector& left) noexcept {
  const double denominator = s.squaredNorm() - s.dot(left);
  if (!(std::abs(denominator) > 1e-3 * s.squaredNorm())) return;  // would make H nearly singular; also refuses what is not finite
  double share[kPairs];
  for (Index k = 0; k < count_; ++k) share[k] = a_.col(k).dot(s);
  const Index to = next_;  // the pair that goes when the memory is full still counts in s' H
  const double share_of_old = to < count_ ? share[to] : 0.0;
  b_.col(to) *= share_of_old;
  b_.col(to) += s;
  for (Index k = 0; k < count_; ++k)
    if (k != to) b_.col(to) += share[k] * b_.col(k);
  a_.col(to) = left / denominator;
  next_ = (to + 1) % kPairs;
  if (count_ < kPairs) ++count_;
}

std::vector<double> SecantMemory::values() const {
  std::vector<double> values{static_cast<double>(count_), static_cast<double>(next_)};
  values.insert(values.end(), a_.data(), a_.data() + a_.size());
  values.insert(values.end(), b_.data(), b_.data() + b_.size());
  return values;
}

void SecantMemory::restore(const std::vector<double>& values) {
  const std::size_t expected = 2 + 2 * static_cast<std::size_t>(a_.size());
  if (values.size() != expected) throw std::invalid_argument("Newmark's memory: " + std::to_string(values.size()) + " numbers, expected " + std::to_string(expected));
  count_ = static_cast<Index>(values[0]);
  next_ = static_cast<Index>(values[1]);
  if (count_ < 0 || count_ > kPairs || next_ < 0 || next_ >= kPairs) throw std::invalid_argument("Newmark's memory: its counters are out of range");
  std::copy_n(values.begin() + 2, a_.size(), a_.data());
  std::copy_n(values.begin() + 2 + a_.size(), b_.size(), b_.data());
}

}  // namespace heerk_rotor
