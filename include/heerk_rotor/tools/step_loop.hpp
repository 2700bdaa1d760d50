#pragma once
#include <cstdint>

#include "heerk_rotor/tools/command_file.hpp"
#include "heerk_rotor/tools/failure_dump.hpp"
#include "heerk_rotor/tools/progress_bar.hpp"
#include "heerk_rotor/tools/open_recorders.hpp"
#include "heerk_rotor/tools/run_summary.hpp"

namespace heerk_rotor {

/// What goes along with every step of a run.
struct StepCompanions {
  Vector* command = nullptr;            // w in effect: before the run, then after it
  CommandSchedule* commands = nullptr;  // or none: the command stays as it is
  Recorders* recorders = nullptr;       // already observers of the simulation; the first failed one ends the run; or none
  RecentInstants* recent = nullptr;     // or none
  ProgressBar* progress = nullptr;      // or none
};

/// Takes `steps` steps; ends earlier on a failure of solver or recorder, or when StopRequest has seen a signal.
RunSummary runSteps(Simulation& simulation, std::uint64_t steps, const StepCompanions& companions) noexcept;

/// Shows the present instant to the recorders that want it: the last row of a record that ends on the grid.
/// A failure of the solver there goes into the summary.
void recordFinalInstant(Simulation& simulation, const StepCompanions& companions, RunSummary& summary) noexcept;

}  // namespace heerk_rotor
