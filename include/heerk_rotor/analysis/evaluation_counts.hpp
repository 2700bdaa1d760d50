#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// Average evaluations per step, as in the paper's Table 5. f is evaluated once per stage and subsystem; g as often as the
/// iteration asks for it with changed input: an output port counts by itself, so that a subsystem's share of a whole g is
/// its count divided by its number of ports.
struct EvaluationCounts {
  std::string method;
  long steps = 0;
  int stages = 0;
  double newton_iterations = 0.0;            // per step
  double jacobians = 0.0;                    // in all
  struct Row {
    std::string subsystem;
    double f = 0.0, g_ports = 0.0;           // per step
    Index ports = 0;
  };
  std::vector<Row> rows;
};

/// Takes `steps` steps; throws std::runtime_error when one fails.
EvaluationCounts countEvaluations(Simulation& simulation, const Vector& command, long steps);

std::string text(const EvaluationCounts& counts);
std::string json(const EvaluationCounts& counts);

}  // namespace heerk_rotor
