#include "heerk_rotor/integrate/step_method.hpp"

#include <algorithm>
#include <stdexcept>

#include "step_method_kinds.hpp"

namespace heerk_rotor {
namespace {

constexpr const char *kNewmark = "Newmark", *kPrecise1 = "precise_1", *kPrecise2 = "precise_2";

[[noreturn]] void refuse(const std::string& name) {
  std::string names;
  for (const std::string& known : stepMethodNames()) names += (names.empty() ? "" : ", ") + known;
  throw std::invalid_argument("integrator '" + name + "': unknown, expected one of " + names);
}

const Tableau* findTableau(const std::string& name) {
  const auto found = std::find_if(tableaus().begin(), tableaus().end(), [&name](const Tableau& t) { return t.name == name; });
  return found == tableaus().end() ? nullptr : &*found;
}

}  // namespace

void StepMethod::restoreMemory(const std::vector<double>& memory) {
  if (!memory.empty()) throw std::invalid_argument(name() + " keeps no memory, found " + std::to_string(memory.size()) + " numbers of it");
}

std::unique_ptr<StepMethod> makeStepMethod(const std::string& name, const CoupledSystem& system, double h, double tolerance) {
  if (const Tableau* known = findTableau(name)) return makeExponentialRungeKutta(*known, system, h);
  if (name == kNewmark) return makeNewmark(system, h, tolerance);
  if (name == kPrecise1) return makePreciseIntegration(PreciseVariant::kDense, system, h);
  if (name == kPrecise2) return makePreciseIntegration(PreciseVariant::kSubBlocks, system, h);
  refuse(name);
}

std::vector<std::string> stepMethodNames() {
  std::vector<std::string> names;
  for (const Tableau& method : tableaus()) names.push_back(method.name);
  for (const char* name : {kNewmark, kPrecise1, kPrecise2}) names.push_back(name);
  return names;
}

int orderOfStepMethod(const std::string& name) {
  if (const Tableau* known = findTableau(name)) return known->order;
  if (name == kNewmark) return kNewmarkOrder;
  if (name == kPrecise1 || name == kPrecise2) return kPreciseOrder;
  refuse(name);
}

}  // namespace heerk_rotor
