#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor::work_precision {

/// An initial value problem on which methods are compared: a coupled system, its start and the instants at which the solution is looked at.
/// Commands are constant; t begins at 0.
struct Problem {
  using Overrides = std::vector<std::string>;

  std::string name;
  std::string group;       // problems of one kind share the targets of the comparison: lag_rotor, blades, rotor, dual_disc
  std::string meaning;     // one sentence for the report
  /// A fresh system; "key=value" overrides change its form, not its solution (fewer modes: its truth).
  std::function<CoupledSystem(const Overrides&)> build;
  double newton_tolerance = 1e-10;          // of the algebraic part, of all methods alike
  double duration = 0.0;                    // [s]
  int instants = 0;                         // t_k = k duration / instants, k = 1..instants
  int first_instant = 1;                    // the error counts from here on
  std::vector<std::string> measured = {};   // ports whose error is the problem's; empty: all published ones
  std::map<std::string, double> start = {}; // states by name that differ from the system's own initial ones
  Vector command = {};                      // (commands); empty: the system's default
  Overrides second_order = {};              // overrides that give S the second-order form [[0, I], [-K, -C]]
  Overrides newmark = {};                   // overrides under which Newmark's method is at its best
  std::vector<int> mode_counts = {};        // of truncated blades, largest first; empty: nothing to truncate
  double fine_step = 0.0;                   // of the second reference [s]
  double patience = 1.0;                    // times the limit of time per integration, where even the best methods need long

  double spacing() const { return duration / instants; }
  Vector startOf(const CoupledSystem& system) const;
  Vector commandOf(const CoupledSystem& system) const { return command.size() > 0 ? command : system.defaultCommand(); }
};

/// All problems by name; expensive starts are found here, outside all measurements.
std::vector<std::string> problemNames();
Problem makeProblem(const std::string& name);

/// `blades` elastic blades (all 50 modes each) with smooth airloads on a hub that turns with constant speed and does not move otherwise.
Problem bladesOnHub(int blades);

/// The complete elastic rotor with smooth airloads.
Problem completeRotor();

}  // namespace heerk_rotor::work_precision
