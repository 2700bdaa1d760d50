#pragma once
#include <string>

#include "heerk_rotor/config/section.hpp"

namespace heerk_rotor {

/// The `simulation:` section of a configuration.
struct SimulationSettings {
  std::string integrator = "HEERK4";
  double rotor_speed = 0.0;                  // nominal, > 0 [rad/s]
  double step = 0.0;                         // h [s], from `step` or from `azimuth_step_deg` and the rotor speed
  std::string formulation = "absolute_lag";  // absolute_lag | printed: states of the blades on an elastic mast (docs/lag_rotor.md, docs/fe_rotor.md)
  bool paper_tolerance = false;              // newton_tolerance: paper
  double newton_tolerance = 1e-10;           // on the scaled Newton correction
  double duration = 10.0;                    // default length of `simulate` [s]

  double revolution() const;                 // T_rev [s]
};

/// Reads and checks the section; problems go to `problems`.
SimulationSettings readSimulationSettings(const Configuration& configuration, Problems& problems);

}  // namespace heerk_rotor
