#pragma once
#include <string>
#include <vector>

#include "error_measure.hpp"
#include "integration.hpp"

namespace heerk_rotor::work_precision {

struct ComparisonOptions {
  bool quick = false;
  int rounds = 3;               // measurements of a time, of which the median counts
  double batch = 0.01;          // least CPU time of one measurement; shorter integrations are repeated within it [s]
  double limit = 0.3;           // integrations that take longer are measured once, and the first beyond the problem's patience ends a curve [s]
  double finest_error = 1e-6;   // a curve ends with the first error below, of the measured and of all published outputs
  std::vector<std::string> methods = {};  // empty: all
};

/// All curves of one problem, a CSV row per point to the standard output, remarks to the standard error.
void compare(const std::string& problem_name, const ComparisonOptions& options);

/// "problem,method,...": the head line of these rows.
const char* csvHeader();

}  // namespace heerk_rotor::work_precision
