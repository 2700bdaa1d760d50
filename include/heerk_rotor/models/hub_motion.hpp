#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

/// Number of blades of the lag rotor and of the models made for it.
constexpr int kLagBlades = 4;

/// The input port by which models follow the hub; a mast's output of the same name drives it.
inline InputPort hubMotionInput() {
  return {"hub_motion", 4, "rad, rad/s", "azimuth and speed of the hub, mast twist and its rate", Unconnected::kError, {}, {"azimuth", "speed", "twist", "twist_rate"}};
}

}  // namespace heerk_rotor
