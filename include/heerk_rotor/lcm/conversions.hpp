#pragma once
#include <cstdint>
#include <string>

#include "heerk_rotor/assembly/rotor_view.hpp"
#include "heerk_rotor/rotor_state_t.hpp"

namespace heerk_rotor {

/// Fills an LCM message from a reading; stamp in nanoseconds, overruns and dropped as in RotorState. Reusing the message
/// avoids allocation in the steady state.
void toLcmState(const RotorReading& reading, std::int64_t stamp, const std::string& command_source, std::uint64_t overruns,
                std::uint64_t dropped, rotor_state_t& message);

}  // namespace heerk_rotor
