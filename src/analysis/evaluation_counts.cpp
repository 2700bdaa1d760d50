#include "heerk_rotor/analysis/evaluation_counts.hpp"

#include <cstdio>
#include <stdexcept>

namespace heerk_rotor {
namespace {

template <class... Values>
std::string print(const char* format, Values... values) {
  char line[256];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

}  // namespace

EvaluationCounts countEvaluations(Simulation& simulation, const Vector& command, long steps) {
  const SolverCounters before = simulation.solver().counters();
  const std::vector<std::uint64_t> outputs = simulation.solver().outputEvaluations();
  for (long i = 0; i < steps; ++i)
    if (simulation.step(command) != StepStatus::kOk) throw std::runtime_error("evaluation counts: " + simulation.failure().where + ": " + simulation.failure().cause);
  const SolverCounters& after = simulation.solver().counters();
  const auto per_step = [steps](std::uint64_t now, std::uint64_t then) { return static_cast<double>(now - then) / static_cast<double>(steps); };

  EvaluationCounts counts;
  counts.method = simulation.options().method;
  counts.steps = steps;
  counts.stages = simulation.method().evaluations();
  counts.newton_iterations = per_step(after.newton_iterations, before.newton_iterations);
  counts.jacobians = static_cast<double>(after.jacobians - before.jacobians);
  const CoupledSystem& system = simulation.system();
  for (std::size_t k = 0; k < system.subsystems().size(); ++k) {
    const CoupledSystem::Subsystem& subsystem = system.subsystems()[k];
    EvaluationCounts::Row row;
    row.subsystem = subsystem.name;
    row.f = subsystem.x_size > 0 ? counts.stages : 0.0;
    row.g_ports = per_step(simulation.solver().outputEvaluations()[k], outputs[k]);
    for (const CoupledSystem::Output& output : system.outputs()) row.ports += output.subsystem == static_cast<Index>(k);
    counts.rows.push_back(row);
  }
  return counts;
}

std::string text(const EvaluationCounts& counts) {
  std::string out = print("evaluations per step, %s (%d stages), average over %ld steps; %.3g Newton iterations per step, %g Jacobians in all\n", counts.method.c_str(), counts.stages,
                          counts.steps, counts.newton_iterations, counts.jacobians);
  out += print("%-16s %10s %16s %16s\n", "subsystem", "f", "output ports", "g (ports / all)");
  for (const EvaluationCounts::Row& row : counts.rows)
    out += print("%-16s %10.4g %16.4g %16.4g\n", row.subsystem.c_str(), row.f, row.g_ports, row.ports > 0 ? row.g_ports / static_cast<double>(row.ports) : 0.0);
  return out;
}

std::string json(const EvaluationCounts& counts) {
  std::string out = print("{\"method\": \"%s\", \"stages\": %d, \"steps\": %ld, \"newton_iterations\": %.9g, \"jacobians\": %g, \"subsystems\": {", counts.method.c_str(), counts.stages,
                          counts.steps, counts.newton_iterations, counts.jacobians);
  for (std::size_t k = 0; k < counts.rows.size(); ++k)
    out += print("%s\"%s\": {\"f\": %.9g, \"output_ports\": %.9g, \"ports\": %ld}", k > 0 ? ", " : "", counts.rows[k].subsystem.c_str(), counts.rows[k].f, counts.rows[k].g_ports,
                 static_cast<long>(counts.rows[k].ports));
  return out + "}}";
}

}  // namespace heerk_rotor
