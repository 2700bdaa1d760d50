#pragma once
#include <memory>

#include "heerk_rotor/integrate/step_method.hpp"
#include "heerk_rotor/integrate/tableau.hpp"

namespace heerk_rotor {

/// One kind of method each.
std::unique_ptr<StepMethod> makeExponentialRungeKutta(const Tableau& tableau, const CoupledSystem& system, double h);
std::unique_ptr<StepMethod> makeNewmark(const CoupledSystem& system, double h, double tolerance);
enum class PreciseVariant { kDense, kSubBlocks };  // precise_1, precise_2
std::unique_ptr<StepMethod> makePreciseIntegration(PreciseVariant variant, const CoupledSystem& system, double h);

constexpr int kNewmarkOrder = 2, kPreciseOrder = 4;

}  // namespace heerk_rotor
