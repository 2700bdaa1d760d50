#include "heerk_rotor/solve/start_values.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace heerk_rotor {
namespace {

constexpr double kReach = 2.0;  // how far a parabola goes beyond its instants, in parts of their span

/// Stages reach one instant by different sums.
bool sameInstant(double a, double b) noexcept { return std::abs(a - b) <= 2e-15 * std::max(std::abs(a), std::abs(b)); }

}  // namespace

bool StartValues::reaches(double t) const noexcept {
  if (known_ < 2) return false;
  const auto [first, last] = std::minmax_element(time_, time_ + known_);
  const double reach = kReach * (*last - *first);
  return t >= *first - reach && t <= *last + reach;
}

bool StartValues::predict(double t, double* values) const noexcept {
  for (int k = 0; k < known_; ++k)
    if (sameInstant(t, time_[k])) {
      std::copy_n(at(k), size_, values);
      return true;
    }
  if (!reaches(t)) return false;
  double weight[kInstants];  // Lagrange
  for (int k = 0; k < known_; ++k) {
    weight[k] = 1.0;
    for (int j = 0; j < known_; ++j)
      if (j != k) weight[k] *= (t - time_[j]) / (time_[k] - time_[j]);
  }
  if (known_ == 2) {
    for (Index i = 0; i < size_; ++i) values[i] = weight[0] * at(0)[i] + weight[1] * at(1)[i];
  } else {
    for (Index i = 0; i < size_; ++i) values[i] = weight[0] * at(0)[i] + weight[1] * at(1)[i] + weight[2] * at(2)[i];
  }
  return true;
}

void StartValues::remember(double t, const double* values) noexcept {
  int k = 0;
  while (k < known_ && !sameInstant(t, time_[k])) ++k;
  if (k == known_ && known_ >= 2 && !reaches(t)) k = known_ = 0;  // time has been set back, or ahead
  if (k == known_) {
    if (known_ < kInstants) ++known_;
    else --k;  // the oldest goes
  }
  const int slot = slot_[k];
  for (; k > 0; --k) {
    slot_[k] = slot_[k - 1];
    time_[k] = time_[k - 1];
  }
  slot_[0] = slot;
  time_[0] = t;
  std::copy_n(values, size_, values_.data() + slot * size_);
}

void StartValues::appendTo(std::vector<double>& cache) const {
  cache.push_back(known_);
  for (int k = 0; k < kInstants; ++k) {
    cache.push_back(time_[k]);
    cache.insert(cache.end(), at(k), at(k) + size_);
  }
}

void StartValues::restore(std::vector<double>::const_iterator& value) {
  if (!(*value >= 0.0 && *value <= kInstants)) throw std::invalid_argument("start values of " + std::to_string(*value) + " instants, expected at most " + std::to_string(kInstants));
  known_ = static_cast<int>(*value++);
  for (int k = 0; k < kInstants; ++k) {
    slot_[k] = k;
    time_[k] = *value++;
    std::copy_n(value, size_, values_.data() + k * size_);
    value += size_;
  }
}

}  // namespace heerk_rotor
