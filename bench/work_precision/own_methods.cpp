// Our own methods, all through Simulation.
#include <cmath>

#include "integration.hpp"

namespace heerk_rotor::work_precision {
namespace {

/// Evaluations of f per step and, for Newmark's iteration, as many solves of the algebraic part as were counted.
class OwnMethod final : public Integration {
 public:
  OwnMethod(const Problem& problem, const std::string& method, double step, const Problem::Overrides& overrides, double newton_tolerance) : problem_(problem) {
    StepOptions options;
    options.method = method;
    options.step = step;
    options.solver.tolerance = newton_tolerance;
    CoupledSystem system = problem.build(overrides);
    const Vector x = problem.startOf(system);
    command_ = problem.commandOf(system);
    simulation_ = std::make_unique<Simulation>(std::move(system), options);
    simulation_->setState(x);
    start_ = simulation_->checkpoint();
    start_.w = command_;
    stride_ = std::lround(problem.spacing() / step);
    states_.resize(x.size(), problem.instants);
  }

  bool run() override {
    simulation_->restore(start_);
    const std::uint64_t solves = simulation_->solver().counters().solves;
    bool good = true;
    for (Index k = 0; k < problem_.instants && good; ++k) {
      for (long i = 0; i < stride_ && good; ++i) good = simulation_->step(command_) == StepStatus::kOk && ((i & 0xff) != 0xff || cpuSeconds() < cpu_deadline);
      states_.col(k) = simulation_->state();
    }
    steps_ = static_cast<long>(simulation_->stepCount());
    evaluations_ = static_cast<long>(simulation_->solver().counters().solves - solves);
    return good;
  }

 private:
  Problem problem_;
  std::unique_ptr<Simulation> simulation_;
  Simulation::Checkpoint start_;
  Vector command_;
  long stride_;
};

Family family(const Problem& problem, const std::string& label, const std::string& method, const std::string& setting, const Problem::Overrides& overrides,
              const std::vector<double>& steps) {
  return {label, setting, steps, [=](double step) { return ownMethod(problem, method, step, overrides, problem.newton_tolerance); }, overrides};
}

}  // namespace

std::unique_ptr<Integration> ownMethod(const Problem& problem, const std::string& name, double step, const Problem::Overrides& overrides, double newton_tolerance) {
  return std::make_unique<OwnMethod>(problem, name, step, overrides, newton_tolerance);
}

std::vector<double> dividingSteps(const Problem& problem, bool quick) {
  std::vector<double> steps;
  for (long unit = 1; unit <= 16384; unit *= 2)
    for (const long part : {2, 3})
      if (const long parts = unit * part / 2; parts * 2 == unit * part && (!quick || part == 2)) steps.push_back(problem.spacing() / static_cast<double>(parts));
  return steps;
}

std::vector<Family> ownMethods(const Problem& problem, bool quick) {
  const std::vector<double> steps = dividingSteps(problem, quick);
  std::vector<Family> families;
  for (const char* method : {"HEERK4", "HEERK3", "HEERK2", "HERK4"}) families.push_back(family(problem, method, method, "", {}, steps));
  families.push_back(family(problem, "Newmark", "Newmark", problem.newmark.empty() ? "" : "unbalance in the remainder", problem.newmark, steps));
  if (!problem.second_order.empty()) {
    for (const char* method : {"precise_1", "precise_2"}) families.push_back(family(problem, method, method, "physical coordinates", problem.second_order, steps));
    families.push_back(family(problem, "precise_2", "precise_2", "modal coordinates", {}, steps));
  }
  for (const int modes : problem.mode_counts) {
    if (quick && modes != 20 && modes != 9) continue;
    families.push_back(family(problem, "truncated RK4", "HERK4", std::to_string(modes) + " modes", {"subsystems.rotor.modes=" + std::to_string(modes)}, steps));
    families.back().truncated = true;
  }
  for (const int modes : problem.mode_counts) {
    if (modes != 20 && (quick || modes != 9)) continue;
    families.push_back(family(problem, "truncated HEERK4", "HEERK4", std::to_string(modes) + " modes", {"subsystems.rotor.modes=" + std::to_string(modes)}, steps));
    families.back().truncated = true;
  }
  return families;
}

}  // namespace heerk_rotor::work_precision
