#pragma once
#include "heerk_rotor/assembly/rotor_view.hpp"
#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/core/coupled_system.hpp"
#include "heerk_rotor/ros/command_gate.hpp"

namespace heerk_rotor {

/// Sizes for drawing the rotor [m].
struct RotorGeometry {
  double hinge_offset = 0.2;
  double radius = 5.0;
  double root_cutout = 0.8;
  double chord = 0.32;
};

/// Reads the sizes from whatever subsystem of the configuration gives hinge_offset, radius, root_cutout and chord. Without a
/// radius: hinge offset plus twice the distance hinge - centre of mass (blade_length); without a chord a sixteenth of the radius.
RotorGeometry readRotorGeometry(const Configuration& configuration);

/// Travel of the swashplate that takes the collective command; the model's defaults for what the configuration leaves out.
CommandLimits readCommandLimits(const Configuration& configuration, const CoupledSystem& system, const RotorView& view);

}  // namespace heerk_rotor
