#pragma once
#include <vector>

#include "heerk_rotor/assembly/command_view.hpp"
#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/core/coupled_system.hpp"
#include "heerk_rotor/ros/command_gate.hpp"

namespace heerk_rotor {

/// Sizes for drawing the rotor [m].
struct RotorGeometry {
  double hinge_offset = 0.2;   // of rigid blades
  double radius = 5.0;
  double root_cutout = 0.8;    // the aerofoil begins here
  double chord = 0.32;
  bool clockwise = false;      // seen from above
  struct Section {
    double width;              // span it stands for
    double chord;
  };
  std::vector<Section> sections;  // of elastic blades, as the model has them; empty for rigid blades
};

/// Reads the sizes from whatever subsystem of the configuration gives hinge_offset, radius, root_cutout, chord and rotation. Elastic
/// blades (fe_rotor) have theirs in their list of nodes. Without a radius: hinge offset plus twice the distance hinge - centre of
/// mass (blade_length); without a chord a sixteenth of the radius.
RotorGeometry readRotorGeometry(const Configuration& configuration);

/// Travel of the swashplate that takes the collective command; the model's defaults for what the configuration leaves out.
CommandLimits readCommandLimits(const Configuration& configuration, const CoupledSystem& system, const CommandView& commands);

}  // namespace heerk_rotor
