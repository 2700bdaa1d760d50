#pragma once
#include <memory>
#include <vector>

#include "heerk_rotor/integrate/linear_propagator.hpp"
#include "row_plan.hpp"

namespace heerk_rotor {

/// One kind of block each; arguments are valid (makePropagator has checked them).
std::unique_ptr<LinearPropagator> makeZeroPropagator(Index size, double h, const Tableau& tableau);
std::unique_ptr<LinearPropagator> makeDensePropagator(const DenseStiff& part, double h, const Tableau& tableau);
std::unique_ptr<LinearPropagator> makeModalPropagator(const ModalStiff& part, double h, const Tableau& tableau);
std::unique_ptr<LinearPropagator> makePairPropagator(const PairStiff& part, double h, const Tableau& tableau);

/// From the finished matrices, one (n x n) per entry of the plan.
std::unique_ptr<LinearPropagator> makeMatrixPropagator(RowPlan plan, const std::vector<Matrix>& matrices);

}  // namespace heerk_rotor
