#include "error_measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

namespace heerk_rotor::work_precision {

ErrorMeasure::Observer& ErrorMeasure::observerOf(const Problem::Overrides& overrides) {
  Observer& o = observers_[overrides];
  if (o.system) return o;
  o.system = std::make_unique<CoupledSystem>(problem_.build(overrides));
  o.command = problem_.commandOf(*o.system);
  SolverOptions options;
  options.tolerance = 1e-13;
  o.solver = std::make_unique<AlgebraicSolver>(*o.system, options, 0.0, problem_.startOf(*o.system), o.command);
  std::set<Index> published;
  for (const Signal& signal : o.system->signals())
    if (signal.published && signal.kind == Signal::Kind::kOutput) published.insert(signal.index);
  is_measured_.clear();
  for (const CoupledSystem::Output& output : o.system->outputs()) {
    if (published.count(output.begin) == 0) continue;
    o.ports.emplace_back(output.begin, output.size);
    is_measured_.push_back(problem_.measured.empty() || std::count(problem_.measured.begin(), problem_.measured.end(), output.name) > 0);
  }
  if (std::count(is_measured_.begin(), is_measured_.end(), 1) == 0) throw std::logic_error(problem_.name + ": no published port is among the measured ones");
  return o;
}

Observed ErrorMeasure::observe(const Problem::Overrides& overrides, const Matrix& states) {
  Observer& o = observerOf(overrides);
  const Index first = problem_.first_instant - 1, count = problem_.instants - first;
  Observed observed;
  for (const auto& [begin, size] : o.ports) observed.push_back(Matrix::Constant(size, count, std::numeric_limits<double>::infinity()));
  Vector x;
  for (Index k = 0; k < count; ++k) {
    x = states.col(first + k);
    const double t = static_cast<double>(first + k + 1) * problem_.spacing();
    if (!std::isfinite(x.sum()) || o.solver->solve(t, x, o.command).status != SolveStatus::kConverged) return observed;
    o.solver->evalObserved(t, x, o.command);
    for (std::size_t p = 0; p < o.ports.size(); ++p) observed[p].col(k) = o.solver->y().segment(o.ports[p].first, o.ports[p].second);
  }
  return observed;
}

void ErrorMeasure::setReference(Observed reference) {
  reference_ = std::move(reference);
  magnitude_.clear();
  for (const Matrix& port : reference_) magnitude_.push_back(port.cwiseAbs().maxCoeff());
}

Error ErrorMeasure::compare(const Observed& found) const {
  double measured = 0.0, all = 0.0;
  int measured_ports = 0, ports = 0;
  for (std::size_t p = 0; p < reference_.size(); ++p) {
    if (magnitude_[p] < 1e-12) continue;  // nothing moves there
    const double square = ((found[p] - reference_[p]) / magnitude_[p]).array().square().mean();
    all += square;
    ++ports;
    if (is_measured_[p]) {
      measured += square;
      ++measured_ports;
    }
  }
  return {std::sqrt(measured / measured_ports), std::sqrt(all / ports)};
}

}  // namespace heerk_rotor::work_precision
