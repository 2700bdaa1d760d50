#include "integration.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

namespace heerk_rotor::work_precision {

double cpu_deadline = std::numeric_limits<double>::infinity();

double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<double> tolerances(bool quick) {
  std::vector<double> list;
  for (int k = 2; k <= 24; k += quick ? 2 : 1) list.push_back(std::pow(10.0, -0.5 * k));
  return list;
}

Vector stateScale(const Problem& problem, const Matrix& states) {
  const CoupledSystem system = problem.build({});
  const std::vector<std::string> units = system.stateUnits();
  const Vector start = problem.startOf(system);
  std::map<std::string, double> largest;
  for (Index i = 0; i < start.size(); ++i) {
    double& magnitude = largest[units[static_cast<std::size_t>(i)]];
    magnitude = std::max({magnitude, std::abs(start[i]), states.size() > 0 ? states.row(i).cwiseAbs().maxCoeff() : 0.0});
  }
  Vector scale(start.size());
  for (Index i = 0; i < start.size(); ++i) {
    const double magnitude = largest[units[static_cast<std::size_t>(i)]];
    scale[i] = magnitude > 0.0 ? magnitude : 1.0;
  }
  return scale;
}

ReferenceMethods referenceMethods(const Problem& problem, const Vector& scale) {
  ReferenceMethods methods;
  methods.check_name = "HEERK4";
  methods.check = ownMethod(problem, "HEERK4", problem.fine_step, {}, 1e-14);
  methods.main_name = "ARKODE ERK, order 8, tolerance 1e-13";
  methods.main = tightExplicit(problem, scale);
  if (methods.main) return methods;
  methods.main_name = "HEERK3";  // other tableau, same propagation
  methods.main = ownMethod(problem, "HEERK3", 0.5 * problem.fine_step, {}, 1e-14);
  return methods;
}

}  // namespace heerk_rotor::work_precision
