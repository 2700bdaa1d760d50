#pragma once
#include <memory>
#include <vector>

#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/shaft/shaft_properties.hpp"

namespace heerk_rotor {

class Section;
struct SimulationSettings;

struct ShaftRotorParameters {
  double rotor_speed = 0.0;              // Omega [rad/s]
  ShaftProperties shaft;
  std::vector<int> journals;             // nodes at which outside forces act
  bool modal = true;                     // coordinates: modal | physical
  bool unbalance_in_exponential = true;  // modal only: the unbalance of nominal speed is part of S
  double linearised_film_damping = 0.0;  // moved into S at the first journal, given back by the remainder [N s/m]
};

/// Reads the section and records what is wrong.
ShaftRotorParameters readShaftRotorParameters(Section& section, const SimulationSettings& simulation);

/// Rotating shaft with rigid discs and linear bearings as finite elements, after Liu & Zhang's dual-disc rotor.
///
///   M q'' + (C - omega G) q' + K q = journal forces + unbalance,  omega = Omega + drive rate, psi = Omega t + drive angle
///   unbalance of a disc: U [omega^2 (cos, sin)(psi + alpha) + omega' (sin, -cos)(psi + alpha)]
/// q: x, y and tilts about x and y of each node, from the static position (weight and static bearing loads are not in the equation).
/// Segments by Euler-Bernoulli with rotary inertia and gyroscopic moments, or Timoshenko (shear: true).
///
/// States, modal: pairs of coordinates of the eigenvectors of H at nominal speed (energy coordinates, 80-bit arithmetic), counted from the
/// steady response to the unbalance of nominal speed, and the phasor e^{i Omega t}, which drives that response. All of this is in S
/// (PairStiff; without unbalance_in_exponential, as for Newmark, the unbalance is in the remainder); the remainder holds journal forces, and
/// with a drive off its nominal motion the differences of gyroscopic term and unbalance.
/// States, physical: q, then q' (SecondOrderStiff); the unbalance is in the remainder. Both give the same outputs.
/// linearised_film_damping: damping that belongs to a film outside may stand in S at the first journal; the remainder takes it off again.
///
/// Inputs: drive (angle, rate, acceleration relative to Omega t; default: constant nominal speed), journal_force, journal_force_2, ..
/// Outputs: displacement and disc_velocity of the discs, journal_motion (x, y, rates), bearing_force on the shaft, node_displacement, azimuth,
/// rotor_speed, energy, dissipated_power, unbalance_power (into the shaft). None depends on the journal forces at once.
///
/// Assumptions: small displacements; a shaft stiff in torsion and along its axis; the driving torque follows the tangent of the shaft;
/// stiffness_damping acts in fixed axes (rotating internal damping, which destabilises above the first critical speed, is not modelled).
std::unique_ptr<SubsystemModel> makeShaftRotorModel(const ShaftRotorParameters& parameters);

}  // namespace heerk_rotor
