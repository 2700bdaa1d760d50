#include "broyden_memory.hpp"

#include <cmath>

namespace heerk_rotor {

double BroydenMemory::projection(std::size_t j, const double* correction) const noexcept {
  double sum = 0.0;
  for (std::size_t k = 0; k < unknowns_; ++k) sum += taken_[j * unknowns_ + k] * correction[k];
  return sum / square_[j];
}

void BroydenMemory::improve(double* correction) const noexcept {
  if (count_ == 0) return;
  for (std::size_t j = 0; j + 1 < count_; ++j) {
    const double share = projection(j, correction);
    for (std::size_t k = 0; k < unknowns_; ++k) correction[k] += share * taken_[(j + 1) * unknowns_ + k];
  }
  const double share = projection(count_ - 1, correction);
  if (!(std::abs(1.0 - share) > 0.1)) return;  // nearly singular update
  for (std::size_t k = 0; k < unknowns_; ++k) correction[k] /= 1.0 - share;
}

void BroydenMemory::remember(const double* correction, const double* inverse_nominal) noexcept {
  if (count_ == kMemory) count_ = 0;
  double square = 0.0;
  for (std::size_t k = 0; k < unknowns_; ++k) {
    const double scaled = correction[k] * inverse_nominal[k];
    taken_[count_ * unknowns_ + k] = scaled;
    square += scaled * scaled;
  }
  if (!(square > 0.0)) return;
  square_[count_++] = square;
}

}  // namespace heerk_rotor
