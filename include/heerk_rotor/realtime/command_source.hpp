#pragma once
#include <cstdint>

namespace heerk_rotor {

/// Where the swashplate command in effect came from; kNone: none has come, the default is in effect; kTimeout: the last one
/// became too old and the default took its place; kSnapshot: loaded with the state; kFile: simulate --commands.
enum class CommandSource : std::uint8_t { kNone, kRos, kRosArray, kLcm, kTimeout, kSnapshot, kFile };

constexpr const char* name(CommandSource source) {
  switch (source) {
    case CommandSource::kRos: return "ros";
    case CommandSource::kRosArray: return "ros_array";
    case CommandSource::kLcm: return "lcm";
    case CommandSource::kTimeout: return "timeout";
    case CommandSource::kSnapshot: return "snapshot";
    case CommandSource::kFile: return "file";
    case CommandSource::kNone: break;
  }
  return "none";
}

}  // namespace heerk_rotor
