#pragma once
#include <memory>

#include "heerk_rotor/core/stiff_part.hpp"
#include "heerk_rotor/integrate/tableau.hpp"

namespace heerk_rotor {

/// The linear half of an exponential Runge-Kutta step for one block of states: everything that depends on (S, h, tableau)
/// is tabulated at construction, `combine` only multiplies and adds.
class LinearPropagator {
 public:
  virtual ~LinearPropagator() = default;

  /// result = e^{c_row hS} x + h sum_{j < row} a_{row,j}(hS) F_j; row == stages() is the step itself.
  /// x, result: (n); F_j = remainders + j * stride, (n) each. result must not overlap x or F.
  virtual void combine(int row, const double* x, const double* remainders, Index stride, double* result) const noexcept = 0;

  /// result = e^{c_row hS} x alone.
  virtual void propagate(int row, const double* x, double* result) const noexcept = 0;
};

/// The propagator that fits the structure of `part`. A tableau with exponential == false takes S as zero
/// (the caller then passes complete right-hand sides as remainders).
std::unique_ptr<LinearPropagator> makePropagator(const StiffPart& part, double h, const Tableau& tableau);

}  // namespace heerk_rotor
