#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"

namespace heerk_rotor {

/// Finds the commands that the outside world gives in any coupled system, by name whatever subsystem takes them:
///   *.collective, *.lateral_cyclic, *.longitudinal_cyclic, *.speed, *.wind_x .. z, *.external_force_x .. z with
///   *.external_moment_x .. z.
class CommandView {
 public:
  /// Throws std::invalid_argument when two subsystems take the same command, or one takes some components of a vector only.
  explicit CommandView(const CoupledSystem& system);

  bool hasSwashplate() const { return collective_ >= 0; }
  /// Entries of w, or -1.
  Index collective() const { return collective_; }
  Index lateralCyclic() const { return lateral_cyclic_; }
  Index longitudinalCyclic() const { return longitudinal_cyclic_; }
  /// Entries of w in the order of the message's components; empty when the system takes no such command.
  const std::vector<Index>& speed() const { return speed_; }                     // of the rotor [rad/s]
  const std::vector<Index>& wind() const { return wind_; }                       // x, y, z over ground, in odom [m/s]
  const std::vector<Index>& externalWrench() const { return external_wrench_; }  // force, moment, in base_link [N], [N m]

 private:
  Index collective_ = -1, lateral_cyclic_ = -1, longitudinal_cyclic_ = -1;
  std::vector<Index> speed_, wind_, external_wrench_;
};

}  // namespace heerk_rotor
