#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/solve/algebraic_solver.hpp"
#include "heerk_rotor/solve/evaluation_plan.hpp"

namespace heerk_rotor {

/// How a system hangs together at its initial state: evaluation order, and each loop pruned and with all its entries.
struct Coupling {
  EvaluationPlan plan;
  std::vector<LoopInfo> pruned, full;  // per loop
};

Coupling analyseCoupling(CoupledSystem& system);

/// For people: subsystems with their ports, connections, order of evaluation, loops with sparsity (HEERK paper, Figure 6).
std::string couplingText(const CoupledSystem& system, const Coupling& coupling);

/// Sizes only: {"states": n, ..., "loops": [{"ports": [...], "entries": e, "unknowns": u, ...}]}.
std::string couplingJson(const CoupledSystem& system, const Coupling& coupling);

}  // namespace heerk_rotor
