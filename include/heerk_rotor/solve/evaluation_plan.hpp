#pragma once
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"
#include "heerk_rotor/solve/sparse_lu.hpp"

namespace heerk_rotor {

/// How to solve one loop of output ports.
struct LoopPlan {
  std::vector<Index> outputs;   // all ports of the strongly connected component
  std::vector<Index> inner_inputs;  // input ports of these that the component itself drives
  std::vector<Index> core_inputs;   // those that lead from core port to core port: gathered for every residual
  std::vector<Index> before;    // evaluated once, in this order, before the iteration (a port may recur)
  std::vector<Index> core;      // evaluated for every residual
  std::vector<Index> after;     // evaluated once after convergence, in order
  std::vector<std::vector<Index>> before_inputs, after_inputs;  // for each of these, the inner inputs that it reads
  std::vector<Index> always_checked;    // ports of which pruning assumes more than that they are iterated: with entries that are not, or reading ports in `after`
  std::vector<Index> unknowns;  // y entries that are iterated, ascending
  SparsityPattern gradient;     // of dg/dy restricted to the unknowns, diagonal always present
  std::vector<Index> colour;    // (unknowns) columns of one colour share no row, so one difference serves them all
  Index colours = 0;
};

/// The order in which the outputs of a coupled system become known.
struct EvaluationPlan {
  /// A single port, or a loop, with the inputs to gather before it (each input once per solution, constants never).
  struct Item {
    std::vector<Index> inputs;
    Index output = -1;  // when >= 0
    Index loop = -1;    // otherwise
  };
  std::vector<Item> stage;              // what f needs
  std::vector<Index> last_inputs;       // inputs of f that no port of the stage has gathered
  std::vector<Item> observed;           // ports only observers need, in order; never in a loop
  std::vector<LoopPlan> pruned, full;   // per loop: unknowns pruned to single entries, and the whole component
};

/// Finds dependencies, loops (strongly connected components) and, by probing the gradient at (t, x, w) and at perturbed
/// states around it, which single entries of a loop have to be iterated (HEERK paper, Section 4.3).
EvaluationPlan planEvaluation(CoupledSystem& system, double t, const Vector& x, const Vector& w);

/// The outputs that the stages of a step evaluate, one flag per output.
std::vector<char> neededInStages(const EvaluationPlan& plan, const CoupledSystem& system);

}  // namespace heerk_rotor
