#include "heerk_rotor/analysis/coupling_report.hpp"

#include <sstream>

namespace heerk_rotor {
namespace {

std::string names(const CoupledSystem& system, const std::vector<Index>& outputs, const std::string& quote = "") {
  std::string text;
  for (const Index output : outputs) text += (text.empty() ? "" : ", ") + quote + system.outputs()[static_cast<std::size_t>(output)].name + quote;
  return text;
}

void writeSubsystems(std::ostringstream& out, const CoupledSystem& system) {
  out << "subsystems: " << system.subsystems().size() << " with " << system.stateSize() << " states, " << system.inputSize() << " inputs (" << system.commandSize() << " of them commands), "
      << system.outputSize() << " outputs\n";
  for (const CoupledSystem::Subsystem& subsystem : system.subsystems()) {
    out << "  " << subsystem.name << ": x " << subsystem.x_size << ", u " << subsystem.u_size << ", y " << subsystem.y_size << "\n";
    for (const InputPort& port : subsystem.model->inputs()) out << "    in  " << port.name << " (" << port.size << ") [" << port.unit << "]\n";
    for (const OutputPort& port : subsystem.model->outputs()) {
      out << "    out " << port.name << " (" << port.size << ") [" << port.unit << "]";
      for (std::size_t i = 0; i < port.feedthrough.size(); ++i) out << (i == 0 ? " <- " : ", ") << port.feedthrough[i];
      out << "\n";
    }
  }
}

void writeConnections(std::ostringstream& out, const CoupledSystem& system) {
  out << "connections:\n";
  for (const CoupledSystem::Input& input : system.inputs()) {
    out << "  " << input.name << " = ";
    for (std::size_t i = 0; i < input.sources.size(); ++i) out << (i > 0 ? " + " : "") << system.outputs()[static_cast<std::size_t>(input.sources[i])].name;
    if (input.sources.empty()) out << (input.command >= 0 ? "command" : "default value");
    out << "\n";
  }
}

}  // namespace

Coupling analyseCoupling(CoupledSystem& system) {
  const Vector x = system.initialState(), w = system.defaultCommand();
  SolverOptions options;
  Coupling coupling{planEvaluation(system, 0.0, x, w), AlgebraicSolver(system, options, 0.0, x, w).loops(), {}};
  options.prune = false;
  coupling.full = AlgebraicSolver(system, options, 0.0, x, w).loops();
  return coupling;
}

std::string couplingText(const CoupledSystem& system, const Coupling& coupling) {
  std::ostringstream out;
  writeSubsystems(out, system);
  writeConnections(out, system);
  out << "evaluation order of a stage:\n";
  for (const EvaluationPlan::Item& item : coupling.plan.stage)
    out << "  " << (item.output >= 0 ? system.outputs()[static_cast<std::size_t>(item.output)].name : "loop " + std::to_string(item.loop + 1)) << "\n";
  std::vector<Index> observed;
  for (const EvaluationPlan::Item& item : coupling.plan.observed) observed.push_back(item.output);
  if (!observed.empty()) out << "for observers only: " << names(system, observed) << "\n";
  if (coupling.pruned.empty()) out << "loops: none\n";
  for (std::size_t l = 0; l < coupling.pruned.size(); ++l) {
    const LoopInfo &pruned = coupling.pruned[l], &full = coupling.full[l];
    const LoopPlan& plan = coupling.plan.pruned[l];
    out << "loop " << l + 1 << ": " << names(system, pruned.outputs) << "\n"
        << "  evaluated before: " << names(system, plan.before) << "\n  iterated: " << names(system, plan.core) << "\n  evaluated after: " << names(system, plan.after) << "\n"
        << "  all entries:    " << full.unknowns.size() << " unknowns, " << full.gradient_nonzeros << " nonzeros of I - dg/dy, " << full.factors.nonzeros() << " of L + U\n"
        << "  pruned to:      " << pruned.unknowns.size() << " unknowns, " << pruned.gradient_nonzeros << " nonzeros of I - dg/dy, " << pruned.factors.nonzeros() << " of L + U, "
        << plan.colours << " differences per gradient\n";
  }
  return out.str();
}

std::string couplingJson(const CoupledSystem& system, const Coupling& coupling) {
  std::ostringstream out;
  out << "{\"states\": " << system.stateSize() << ", \"inputs\": " << system.inputSize() << ", \"outputs\": " << system.outputSize() << ", \"commands\": " << system.commandSize() << ", \"loops\": [";
  for (std::size_t l = 0; l < coupling.pruned.size(); ++l) {
    const LoopInfo &pruned = coupling.pruned[l], &full = coupling.full[l];
    out << (l > 0 ? ", " : "") << "{\"ports\": [" << names(system, pruned.outputs, "\"") << "], \"entries\": " << full.unknowns.size() << ", \"gradient_nonzeros\": " << full.gradient_nonzeros
        << ", \"factor_nonzeros\": " << full.factors.nonzeros() << ", \"pruned\": {\"unknowns\": " << pruned.unknowns.size() << ", \"gradient_nonzeros\": " << pruned.gradient_nonzeros
        << ", \"factor_nonzeros\": " << pruned.factors.nonzeros() << "}}";
  }
  out << "]}";
  return out.str();
}

}  // namespace heerk_rotor
