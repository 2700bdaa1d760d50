// Error against CPU time of our methods and of what a user would pick instead, on the same problems, in the same run.
// scripts/work_precision.py runs it, draws the curves and checks the targets.
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "comparison.hpp"

int main(int argc, char** argv) {
  using namespace heerk_rotor::work_precision;
  CLI::App app{"Error against CPU time on the rotor problems: one CSV row per method, setting and step or tolerance.\n"
               "CPU time is that of the process for one integration, set-up excluded, median of the rounds."};
  ComparisonOptions options;
  std::vector<std::string> problems;
  bool list = false;
  app.add_option("PROBLEM", problems, "problems, all when none is named (--list shows them)");
  app.add_option("--methods", options.methods, "only these methods, separated by commas")->delimiter(',');
  app.add_option("--rounds", options.rounds, "measurements per point, of which the median counts")->capture_default_str();
  app.add_option("--limit", options.limit, "integrations that take longer are measured once and end a curve; 8 times that where the problem takes anyone long [s]")
      ->capture_default_str();
  app.add_option("--finest-error", options.finest_error, "a curve ends with the first error below")->capture_default_str();
  app.add_flag("--quick", options.quick, "fewer points per curve and fewer settings");
  app.add_flag("--list", list, "list the problems");
  CLI11_PARSE(app, argc, argv);
  if (list) {
    for (const std::string& name : problemNames()) std::puts(name.c_str());
    return 0;
  }
#ifndef HEERK_WITH_SUNDIALS
  std::fprintf(stderr, "work_precision: built without SUNDIALS: no CVODE, ARKODE, IDA (scripts/build_sundials.sh)\n");
#endif
#ifndef HEERK_WITH_ODEINT
  std::fprintf(stderr, "work_precision: built without Boost.odeint\n");
#endif
  try {
    std::puts(csvHeader());
    for (const std::string& name : problems.empty() ? problemNames() : problems) compare(name, options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "work_precision: %s\n", error.what());
    return 2;
  }
  return 0;
}
