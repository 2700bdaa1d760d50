#pragma once
#include <array>
#include <memory>

#include "heerk_rotor/core/stiff_part.hpp"
#include "step_method_kinds.hpp"

namespace heerk_rotor {

/// Nodes and weights of the quadrature in a precise step: Clenshaw-Curtis with four nodes (Liu & Zhang, eq. 9, the inner points at t_k + dt/4 and
/// t_k + 3 dt/4; order 4).
constexpr std::array<double, 4> kPreciseNode{0.0, 0.25, 0.75, 1.0}, kPreciseWeight{1.0 / 18.0, 4.0 / 9.0, 4.0 / 9.0, 1.0 / 18.0};

/// What a precise step does with the linear part of one subsystem. n: its states; S: its stiff part.
class PrecisePiece {
 public:
  virtual ~PrecisePiece() = default;
  /// f = S x + r (n each; f may be r).
  virtual void complete(const double* x, const double* r, double* f) const noexcept = 0;
  /// result = e^{hS} x + h sum_i w_i e^{(1 - c_i) hS} r_i, r_i = r + i * stride.
  virtual void combine(const double* x, const double* r, Index stride, double* result) const noexcept = 0;
};

/// precise_1 takes every S as one dense matrix; precise_2 uses what is known of its blocks.
std::unique_ptr<PrecisePiece> makePrecisePiece(PreciseVariant variant, const StiffPart& part, double h);

}  // namespace heerk_rotor
