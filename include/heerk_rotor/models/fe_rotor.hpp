#pragma once
#include <memory>

#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/models/fe_rotor_parameters.hpp"

namespace heerk_rotor {

/// Elastic rotor: flap, lag and torsion of 2 to 8 blades as finite elements (HEERK paper, Section 4; structure after Houbolt & Brooks,
/// NACA TR 1346), on a hub that moves in any way.
///
/// Per blade, in pitched axes that feather with theta(t): M d'' + (C + 2 w_x G) d' + K(w, w', theta) d = loads, linear in the elastic
/// displacements; root clamped or hinged in flap and lag. States are modal coordinates at nominal speed and zero pitch (V'MV = I,
/// modes in 80-bit arithmetic), then their rates, [mode][blade]; S is the modal 2x2 form with C = alpha M + beta K at nominal speed. The
/// remainder is given directly: pitch, precone Coriolis and hub terms, speed variation, hinge dampers, airloads. On an elastic mast, modes slower
/// than it have as states their motion relative to the drive instead of the hub (`simulation.formulation: absolute_lag`, lag_rotor.md, section 5): q plus the
/// mode's share of the mast's twist, for which hub_motion and hub_acceleration, both of that mast, bring twist, rate and accelerations (docs/fe_rotor.md). Outputs and
/// given initial values mean the same in both formulations.
///
/// Inputs: hub_motion, hub_acceleration (from a mast; relative to the mount), mount_velocity, mount_acceleration (of the hub in hub_link;
/// the linear acceleration is the specific force, gravity taken off, so that weight of the blades comes with it), hub_gravity (to
/// recover the true acceleration of sections), pitch, pitch_rate, pitch_acceleration per blade, section_loads.
/// Outputs: position, velocity, axes, pitch and acceleration of the sections for airloads; root loads by equilibrium (airloads less
/// inertia loads over the deformed blade, from the same Lagrangian as the equations of motion, so that momentum and energy
/// balance) per blade in rotating axes and summed in hub_link; lag, flap and twist of the tip (fe_blade.md, section 5, item 7).
///
/// Assumptions: moderate elastic slopes (second order in the energies), no bending rotary inertia, no foreshortening Coriolis (third
/// order in the energies). `kinematics: small_angle` drops pitch from the structure and keeps positions and axes of first
/// order, for comparison with the textbook's closed forms.
std::unique_ptr<SubsystemModel> makeFeRotorModel(const FeRotorParameters& parameters);

/// Stiffness and damping with which the modes that count from the drive hold the twist of the mast at nominal speed: constant, so that they belong into
/// the mast's S.
struct TwistLoad {
  double stiffness = 0.0;  // [N m/rad]
  double damping = 0.0;    // [N m s/rad]
};
TwistLoad twistLoad(const FeRotorParameters& parameters);

}  // namespace heerk_rotor
