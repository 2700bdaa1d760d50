#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "heerk_rotor/tools/signal_statistics.hpp"
#include "heerk_rotor/tools/sweep.hpp"

namespace heerk_rotor {

/// What became of one run of a sweep.
struct SweepOutcome {
  std::string status;                          // "done", "interrupted", "solver_stalled", "non_finite", "bad_configuration", "not_trimmed" or "error"
  std::uint64_t steps = 0;                     // taken
  double simulated_time = 0.0;                 // [s]
  std::uint64_t state_hash = 0;                // after the last good step; 0 when there was none
  std::vector<SignalSummary> summaries = {};   // per column of signals; not used unless status is "done"
  std::vector<bool> present = {};              // whether this run has the signal; empty: none
  std::string message = {};                    // why it failed, or which limit of a model was reached
};

/// The result file of a sweep as text: a header with units, one line per run. Columns: run [-]; the swept keys; status [-], steps [-], time [s],
/// state_hash [-]; for each signal NAME.final, .mean, .half_peak_to_peak (of the last revolution), .min, .max (of the run); message [-].
/// Numbers have 17 significant digits; nan where a run has no such value. Depends on nothing but the runs themselves.
class SweepTable {
 public:
  /// `units`: of the swept keys, "" for none.
  SweepTable(const Sweep& sweep, const std::vector<std::string>& units, const std::vector<Signal>& signals);

  std::string header() const { return header_; }
  std::string row(std::uint64_t run, const SweepOutcome& outcome) const;

 private:
  const Sweep& sweep_;
  std::size_t signals_;
  std::string header_;
};

}  // namespace heerk_rotor
