#pragma once
#include <cstdint>

#include "heerk_rotor/assembly/blade_shapes.hpp"
#include "heerk_rotor/assembly/rotor_view.hpp"
#include "heerk_rotor/realtime/snapshot_ring.hpp"

namespace heerk_rotor {

/// Where the swashplate command in effect came from; kNone: none has come, the default is in effect; kTimeout: the last one
/// became too old and the default took its place; kSnapshot: loaded with the state.
enum class CommandSource : std::uint8_t { kNone, kRos, kRosArray, kLcm, kTimeout, kSnapshot };

constexpr const char* name(CommandSource source) {
  switch (source) {
    case CommandSource::kRos: return "ros";
    case CommandSource::kRosArray: return "ros_array";
    case CommandSource::kLcm: return "lcm";
    case CommandSource::kTimeout: return "timeout";
    case CommandSource::kSnapshot: return "snapshot";
    case CommandSource::kNone: break;
  }
  return "none";
}

/// What travels from the step thread to publishers and recorders.
struct RotorInstant {
  RotorReading reading;
  CommandSource source = CommandSource::kNone;
};

/// What the display is told beyond that: too much for every step of a log.
struct RotorPicture {
  RotorInstant instant;
  BladeShapes blades;
};

using RotorRing = SnapshotRing<RotorInstant>;

}  // namespace heerk_rotor
