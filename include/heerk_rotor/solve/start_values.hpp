#pragma once
#include <vector>

#include "heerk_rotor/core/types.hpp"

namespace heerk_rotor {

/// Where the unknowns of a solve are likely to be at an instant: what was found there before (by an earlier stage of the step, or the last one of the step
/// before), otherwise on the parabola through the last three instants.
class StartValues {
 public:
  explicit StartValues(Index unknowns) : size_(unknowns), values_(Vector::Zero(kInstants * unknowns)) {}

  void forget() noexcept { known_ = 0; }

  /// Values at t; false: nothing better than the last ones is known.
  bool predict(double t, double* values) const noexcept;

  /// The solution at t.
  void remember(double t, const double* values) noexcept;

  /// Everything it holds, for a checkpoint: so many numbers, whatever is known. restore() throws std::invalid_argument when they cannot be that.
  void appendTo(std::vector<double>& cache) const;
  void restore(std::vector<double>::const_iterator& value);

 private:
  static constexpr int kInstants = 3;
  bool reaches(double t) const noexcept;
  const double* at(int k) const noexcept { return values_.data() + slot_[k] * size_; }

  Index size_;
  int known_ = 0;
  int slot_[kInstants] = {0, 1, 2};  // of values_, the most recent first
  double time_[kInstants] = {};      // of them
  Vector values_;
};

}  // namespace heerk_rotor
