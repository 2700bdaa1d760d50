#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

// The ports by which models at the hub follow what carries the mast; a fuselage's outputs of the same names drive them. Both in axes of
// hub_link (x forward, y left, z up along the shaft), which do not turn with the rotor. Unconnected: a mount at rest.

/// Entries 0..2: velocity of the hub centre; 3..5: angular velocity of the mount (p, q, r).
inline InputPort mountVelocityInput() {
  return {"mount_velocity", 6, "m/s, rad/s", "velocity of the hub centre and angular velocity of the mount, in hub_link", Unconnected::kDefault, {}, {"x", "y", "z", "roll", "pitch", "yaw"}};
}

/// Entries 0..2: acceleration of the hub centre minus gravity; 3..5: angular acceleration of the mount.
inline InputPort mountAccelerationInput() {
  return {"mount_acceleration", 6, "m/s^2, rad/s^2", "acceleration of the hub centre minus gravity, and angular acceleration of the mount, in hub_link",
          Unconnected::kDefault, {}, {"x", "y", "z", "roll", "pitch", "yaw"}};
}

}  // namespace heerk_rotor
