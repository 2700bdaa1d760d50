#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace heerk_rotor {

/// Broyden's update of a kept Jacobian within one solve, from the corrections taken so far: what is left of the residual after a
/// correction tells how wrong the Jacobian is in that direction. Loops of inertia are nearly linear, so that few directions are enough
/// (Kelley, Solving Nonlinear Equations with Newton's Method, SIAM 2003, chapter 4). All corrections in units of the nominal magnitudes.
/// Memory is taken at construction; nothing outlives clear().
class BroydenMemory {
 public:
  explicit BroydenMemory(std::size_t unknowns) : unknowns_(unknowns), taken_(kMemory * unknowns, 0.0) {}

  void clear() noexcept { count_ = 0; }
  /// Turns the correction of the kept Jacobian into that of the updated one, in place.
  void improve(double* correction) const noexcept;
  /// Keeps a correction that is being applied; begins anew when the memory is full.
  void remember(const double* correction, const double* inverse_nominal) noexcept;

 private:
  static constexpr std::size_t kMemory = 8;
  double projection(std::size_t j, const double* correction) const noexcept;

  std::size_t unknowns_, count_ = 0;
  std::vector<double> taken_;              // (kMemory x unknowns) one after the other
  std::array<double, kMemory> square_{};   // of their norms
};

}  // namespace heerk_rotor
