#include "comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace heerk_rotor::work_precision {
namespace {

constexpr double kPatience = 6.0;  // times the end of a curve after which a run is given up
constexpr double kSame = 0.01;     // relative change of an error that counts as none
constexpr int kPlateau = 2;        // points without change that end a curve

/// CPU time of one integration that has taken `first` seconds once: median of the rounds, each a batch of integrations.
double medianTime(Integration& integration, double first, const ComparisonOptions& options) {
  const long batch = first >= options.batch ? 1 : std::lround(std::ceil(options.batch / std::max(first, 1e-7)));
  std::vector<double> times;
  for (int round = 0; round < options.rounds; ++round) {
    const double begin = cpuSeconds();
    for (long k = 0; k < batch; ++k) integration.run();
    times.push_back((cpuSeconds() - begin) / static_cast<double>(batch));
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

void printRow(const Problem& problem, const Family& family, double parameter, const Error& error, double seconds, const Integration* run, const char* status) {
  const auto quoted = [](const std::string& text) { return text.find(',') == std::string::npos ? text : '"' + text + '"'; };
  std::printf("%s,%s,%s,%.6g,", problem.name.c_str(), quoted(family.method).c_str(), quoted(family.setting).c_str(), parameter);
  if (std::string(status) == "ok") std::printf("%.4e,%.4e,%ld,%ld,ok,%.4e\n", error.measured, seconds, run->steps(), run->evaluations(), error.all);
  else std::printf(",,,,%s,\n", status);
  std::fflush(stdout);
}

/// A curve from loose to tight, until it is accurate enough or takes too long; truncated modes leave an error that no step removes, where their curves end.
void measure(const Problem& problem, const Family& family, ErrorMeasure& measure_of, const ComparisonOptions& options) {
  double last = std::numeric_limits<double>::infinity();
  int unchanged = 0;
  const double end = problem.patience * options.limit;
  bool skip = false;  // long ones come at every other parameter only
  for (const double parameter : family.parameters) {
    if (skip) {
      skip = false;
      continue;
    }
    std::unique_ptr<Integration> integration;
    try {
      integration = family.make(parameter);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s, %s, %s: does not apply: %s\n", problem.name.c_str(), family.method.c_str(), family.setting.c_str(), error.what());
      return;
    }
    const double begin = cpuSeconds();
    cpu_deadline = begin + kPatience * end;
    const bool finished = integration->run();
    cpu_deadline = std::numeric_limits<double>::infinity();
    const double first = cpuSeconds() - begin;
    const Error error = finished ? measure_of.compare(measure_of.observe(family.overrides, integration->states())) : Error{};
    const bool useful = finished && error.measured < 1.0;
    if (!useful) printRow(problem, family, parameter, error, 0.0, nullptr, finished ? "error above 1" : "failed");
    else printRow(problem, family, parameter, error, first > options.limit ? first : medianTime(*integration, first, options), integration.get(), "ok");
    if ((useful && std::max(error.measured, error.all) < options.finest_error) || first > end) return;
    skip = first > options.limit;
    const double sum = error.measured + error.all;
    unchanged = useful && std::abs(sum - last) < kSame * last ? unchanged + 1 : 0;
    if (family.truncated && unchanged >= kPlateau) return;
    if (useful) last = sum;
  }
}

bool wanted(const Family& family, const ComparisonOptions& options) {
  return options.methods.empty() || std::find(options.methods.begin(), options.methods.end(), family.method) != options.methods.end();
}

}  // namespace

const char* csvHeader() { return "problem,method,setting,h_or_tol,error,cpu_s,steps,evaluations,status,error_all"; }

void compare(const std::string& problem_name, const ComparisonOptions& options) {
  const Problem problem = makeProblem(problem_name);
  ErrorMeasure measure_of(problem);

  // Two solutions by code that shares no step; their distance bounds what the comparison can resolve.
  const Vector coarse_scale = [&problem] {
    const auto run = ownMethod(problem, "HEERK4", 10.0 * problem.fine_step, {}, problem.newton_tolerance);
    if (!run->run()) throw std::runtime_error(problem.name + ": HEERK4 with ten times the step of the reference failed");
    return stateScale(problem, run->states());
  }();
  const ReferenceMethods reference = referenceMethods(problem, coarse_scale);
  if (!reference.main->run() || !reference.check->run()) throw std::runtime_error(problem.name + ": a reference failed");
  measure_of.setReference(measure_of.observe({}, reference.main->states()));
  const Error distance = measure_of.compare(measure_of.observe({}, reference.check->states()));
  const std::string pair = reference.main_name + " against " + reference.check_name;
  std::printf("%s,reference,\"%s\",%.6g,%.4e,,%ld,%ld,ok,%.4e\n", problem.name.c_str(), pair.c_str(), problem.fine_step, distance.measured, reference.main->steps(),
              reference.main->evaluations(), distance.all);
  std::fprintf(stderr, "%s: %s\n  reference: %s with h = %.3g s: %.2e (all published outputs: %.2e)\n", problem.name.c_str(), problem.meaning.c_str(), pair.c_str(),
               problem.fine_step, distance.measured, distance.all);

  const bool quick = options.quick;
  const Vector& scale = coarse_scale;
  for (const auto& families : {ownMethods(problem, quick), generalizedAlpha(problem, quick), odeintPeers(problem, scale, quick), cvodePeers(problem, scale, quick),
                               arkodePeers(problem, scale, quick), idaPeers(problem, scale, quick)})
    for (const Family& family : families)
      if (wanted(family, options)) measure(problem, family, measure_of, options);
}

}  // namespace heerk_rotor::work_precision
