#include "heerk_rotor/tools/run_summary.hpp"

#include <cstdio>
#include <sstream>

#include "heerk_rotor/core/hash_text.hpp"
#include "heerk_rotor/tools/number_text.hpp"

namespace heerk_rotor {

std::string name(RunStatus status) {
  switch (status) {
    case RunStatus::kDone: return "done";
    case RunStatus::kInterrupted: return "interrupted";
    case RunStatus::kSolverStalled: return "solver_stalled";
    case RunStatus::kNonFinite: return "non_finite";
    case RunStatus::kOutputFailed: return "output_failed";
  }
  return "unknown";
}

std::string json(const RunSummary& summary) {
  std::ostringstream out;
  const bool timed = summary.steps > 0 && summary.wall_time > 0.0;
  out << "{\"steps\": " << summary.steps << ", \"simulated_time\": " << numberText(summary.simulated_time)
      << ", \"wall_time\": " << numberText(summary.wall_time)
      << ", \"real_time_factor\": " << (timed ? numberText(summary.realTimeFactor()) : "null") << ", \"solves\": " << summary.spent.solves
      << ", \"newton_iterations\": " << summary.spent.newton_iterations
      << ", \"residual_evaluations\": " << summary.spent.residual_evaluations
      << ", \"factorizations\": " << summary.spent.factorizations << ", \"status\": \"" << name(summary.status)
      << "\", \"state_hash\": \"" << hashText(summary.state_hash) << "\"}\n";
  return out.str();
}

std::string text(const RunSummary& summary) {
  char buffer[512];
  const double solves = summary.spent.solves > 0 ? static_cast<double>(summary.spent.solves) : 1.0;
  std::snprintf(buffer, sizeof buffer,
                "%s: %llu steps, %.6g s simulated in %.4g s (%.4g x real time, %.3g us per step)\n"
                "algebraic part: %llu solves, %.3g Newton iterations and %.3g residual evaluations per solve, %llu factorizations\n"
                "state hash %s\n",
                name(summary.status).c_str(), static_cast<unsigned long long>(summary.steps), summary.simulated_time, summary.wall_time,
                summary.realTimeFactor(), summary.steps > 0 ? 1e6 * summary.wall_time / static_cast<double>(summary.steps) : 0.0,
                static_cast<unsigned long long>(summary.spent.solves), static_cast<double>(summary.spent.newton_iterations) / solves,
                static_cast<double>(summary.spent.residual_evaluations) / solves,
                static_cast<unsigned long long>(summary.spent.factorizations), hashText(summary.state_hash).c_str());
  return buffer;
}

}  // namespace heerk_rotor
