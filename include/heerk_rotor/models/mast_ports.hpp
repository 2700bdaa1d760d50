#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/models/lag_rotor_parameters.hpp"

namespace heerk_rotor {

/// Whose inertia the mast turns.
enum class MastHub {
  kOfLagRotor,  // hub and blades of a lag_rotor, which knows no rotation of the fuselage
  kOwn          // a hub of its own (parameter hub_inertia) on a mount that moves in space; the blades' inertia is in their reaction (fe_rotor)
};

/// What all masts share, so that one line of the configuration swaps them.
/// Inputs: blade_reaction (moment of the blades on the hub about +z); drive (angle, rate and acceleration of the drive relative to Omega t and to
///   the mount; none = exactly Omega t); with a hub of its own also mount_velocity and mount_acceleration (mount_ports.hpp).
/// Outputs: hub_motion, hub_acceleration (relative to the mount), twist, azimuth, rotor_speed, torque (on what holds the drive, about +z);
///   with a hub of its own also gyroscopic_moment and hub_angular_momentum.
///
/// The spinning hub has the angular momentum H = I (hub speed + r) about z. Turning its axis with the mount's rates p, q needs the moment
/// omega x H = (q H, -p H); gyroscopic_moment is its reaction on the mount, (-q H, +p H). The inertia of the hub about x and y turns with the
/// mount and belongs to the mount's inertia; its inertia about z does not, and must not be counted there.
std::vector<InputPort> mastInputs(MastHub hub, bool reaction_needed);
std::vector<OutputPort> mastOutputs(MastHub hub, bool elastic, double rotor_speed);

enum MastInput { kReaction, kDriveAngle, kDriveRate, kDriveAcceleration, kMountVelocity, kMountAcceleration = 10 };
enum MountAxis { kRoll = 3, kPitchAxis, kYaw };  // entries of the two mount inputs
enum MastOutput { kHubMotion, kHubAcceleration, kTwistOut, kAzimuth, kSpeed, kTorque, kGyroscopicMoment, kHubAngularMomentum };

/// The two outputs of a hub of its own: H from hub inertia and speed relative to the mount, and its reaction on the mount.
inline double hubAngularMomentum(double inertia, double speed, const In& u) noexcept { return inertia * (speed + u[kMountVelocity + kYaw]); }
inline void gyroscopicMoment(double angular_momentum, const In& u, Out& y) noexcept {
  y << -u[kMountVelocity + kPitchAxis] * angular_momentum, u[kMountVelocity + kRoll] * angular_momentum;
}

/// The hub as its mast sees it.
struct HubOnMast {
  MastHub kind = MastHub::kOfLagRotor;
  MastLoad load;
  double kappa = 1.0;  // how much the blades of a lag rotor take of the hub's inertia (LagRotorConstants) [-]
};

/// Reads the key hub_inertia, or takes the lag_rotor named by `rotor:` or the only one there is. Records a problem when neither is
/// there; beside an fe_rotor hub_inertia is required, because elastic blades alone leave the hub without inertia.
HubOnMast readHubOnMast(Section& section, const BuildContext& context);

}  // namespace heerk_rotor
