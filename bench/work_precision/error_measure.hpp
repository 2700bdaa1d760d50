#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "problem.hpp"

namespace heerk_rotor::work_precision {

/// Outputs of one solution, port by port: (entries x instants) each.
using Observed = std::vector<Matrix>;

struct Error {
  double measured = 0.0;  // over the problem's measured ports
  double all = 0.0;       // over all published ports
};

/// Evaluates the published outputs along a solution, and compares: root mean square over ports of (root mean square over entries and instants
/// of the difference, in parts of the port's largest magnitude in the reference).
class ErrorMeasure {
 public:
  explicit ErrorMeasure(const Problem& problem) : problem_(problem) {}

  Observed observe(const Problem::Overrides& overrides, const Matrix& states);
  void setReference(Observed reference);
  Error compare(const Observed& found) const;

 private:
  struct Observer {
    std::unique_ptr<CoupledSystem> system;
    std::unique_ptr<AlgebraicSolver> solver;
    Vector command;
    std::vector<std::pair<Index, Index>> ports;  // begin and size in y
  };
  Observer& observerOf(const Problem::Overrides& overrides);

  Problem problem_;
  std::map<Problem::Overrides, Observer> observers_;
  std::vector<char> is_measured_;  // (ports)
  Observed reference_;
  std::vector<double> magnitude_;  // (ports)
};

}  // namespace heerk_rotor::work_precision
