#include "block_interpolant.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace heerk_rotor {
namespace {

/// Slope at an interior point from the secants beside it (Fritsch and Butland 1984): their weighted harmonic mean, zero at an extremum.
double interiorSlope(double left_width, double right_width, double left_secant, double right_secant) {
  if (left_secant * right_secant <= 0.0) return 0.0;
  const double a = 2.0 * right_width + left_width, b = right_width + 2.0 * left_width;
  return (a + b) / (a / left_secant + b / right_secant);
}

void requireIncreasing(const std::vector<double>& grid, const char* what, std::size_t least) {
  if (grid.size() < least) throw std::invalid_argument(std::string("airfoil table: ") + std::to_string(grid.size()) + " " + what + ", expected at least " + std::to_string(least));
  for (std::size_t i = 0; i < grid.size(); ++i)
    if (!std::isfinite(grid[i]) || (i > 0 && !(grid[i] > grid[i - 1])))
      throw std::invalid_argument(std::string("airfoil table: ") + what + " must increase strictly, found " + std::to_string(grid[i]) + " at place " + std::to_string(i + 1));
}

}  // namespace

double deckRadians(double alpha_deg) { return alpha_deg * (M_PI / 180.0); }

BlockInterpolant::BlockInterpolant(const C81Block& block, TableInterpolation interpolation) : block_(block), interpolation_(interpolation) {
  requireIncreasing(block.alpha_deg, "angles", 2);
  requireIncreasing(block.mach, "Mach numbers", 1);
  const std::size_t n = block.alpha_deg.size(), m = block.mach.size();
  if (block.values.size() != n * m)
    throw std::invalid_argument("airfoil table: " + std::to_string(block.values.size()) + " values, expected angles x Mach numbers = " + std::to_string(n * m));
  for (double value : block.values)
    if (!std::isfinite(value)) throw std::invalid_argument("airfoil table: a value is not finite");
  for (double alpha : block.alpha_deg) alpha_.push_back(deckRadians(alpha));
  if (interpolation != TableInterpolation::kMonotoneCubic) return;

  slopes_.resize(n * m);
  const bool full_turn = block.alpha_deg.front() == -180.0 && block.alpha_deg.back() == 180.0;
  for (std::size_t j = 0; j < m; ++j) {
    const auto width = [&](std::size_t i) { return alpha_[i + 1] - alpha_[i]; };
    const auto secant = [&](std::size_t i) { return (block.value(i + 1, j) - block.value(i, j)) / width(i); };
    const auto slope = [&](std::size_t i) -> double& { return slopes_[i * m + j]; };
    for (std::size_t i = 1; i + 1 < n; ++i) slope(i) = interiorSlope(width(i - 1), width(i), secant(i - 1), secant(i));
    if (full_turn && block.value(0, j) == block.value(n - 1, j)) {
      slope(0) = slope(n - 1) = interiorSlope(width(n - 2), width(0), secant(n - 2), secant(0));
    } else {
      slope(0) = slope(n - 1) = 0.0;  // values are constant beyond; the derivative shall not jump there
    }
  }
}

BlockInterpolant::Sample BlockInterpolant::inColumn(std::size_t i, double alpha, std::size_t j) const {
  const std::size_t m = block_.mach.size();
  const double width = alpha_[i + 1] - alpha_[i], s = (alpha - alpha_[i]) / width;
  const double left = block_.value(i, j), right = block_.value(i + 1, j);
  if (interpolation_ == TableInterpolation::kLinear) return {(1.0 - s) * left + s * right, 0.0};
  // Cubic Hermite form
  const double d0 = slopes_[i * m + j], d1 = slopes_[(i + 1) * m + j], s2 = s * s, s3 = s2 * s;
  return {left + (3.0 * s2 - 2.0 * s3) * (right - left) + width * ((s3 - 2.0 * s2 + s) * d0 + (s3 - s2) * d1),
          6.0 * (s - s2) * (right - left) / width + (3.0 * s2 - 4.0 * s + 1.0) * d0 + (3.0 * s2 - 2.0 * s) * d1};
}

BlockInterpolant::Sample BlockInterpolant::at(double alpha, double mach) const {
  const std::vector<double>& grid = block_.mach;
  const std::size_t m = grid.size();
  const double x = std::clamp(alpha, alpha_.front(), alpha_.back());
  const std::size_t cell = std::min<std::size_t>(std::upper_bound(alpha_.begin() + 1, alpha_.end() - 1, x) - alpha_.begin() - 1, alpha_.size() - 2);
  Sample result;
  if (m == 1) {
    result = inColumn(cell, x, 0);
  } else {
    const double y = std::clamp(mach, grid.front(), grid.back());
    const std::size_t j = std::upper_bound(grid.begin() + 1, grid.end() - 1, y) - grid.begin() - 1;
    const double share = (y - grid[j]) / (grid[j + 1] - grid[j]);
    const Sample low = inColumn(cell, x, j), high = inColumn(cell, x, j + 1);
    result = {(1.0 - share) * low.value + share * high.value, (1.0 - share) * low.slope + share * high.slope};
  }
  return result;
}

}  // namespace heerk_rotor
