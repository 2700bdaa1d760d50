#pragma once
#include <cmath>
#include <cstdint>

#include "heerk_rotor/realtime/instant.hpp"
#include "heerk_rotor/rotor_state_t.hpp"
#include "heerk_rotor/shaft_state_t.hpp"

namespace heerk_rotor {

/// What a state message says beyond the instant itself.
struct LcmNote {
  std::int64_t stamp = 0;      // [ns]
  std::uint64_t overruns = 0;  // steps that missed their deadline since the start
  std::uint64_t dropped = 0;   // instants this publisher's ring lost since the start
};

/// Stamp of an instant; `base`: stamp of simulation time 0 [ns].
inline std::int64_t lcmStamp(std::int64_t base, double sim_time) { return base + std::llround(sim_time * 1e9); }

/// Message and channel that tell of an instant.
template <class Instant>
struct LcmState;
template <>
struct LcmState<RotorInstant> {
  using Message = rotor_state_t;
  static constexpr const char* kChannel = "ROTOR_STATE";
};
template <>
struct LcmState<ShaftInstant> {
  using Message = shaft_state_t;
  static constexpr const char* kChannel = "SHAFT_STATE";
};

/// Fill a message from an instant. Reusing the message avoids allocation in the steady state.
void toLcmState(const RotorInstant& instant, const LcmNote& note, rotor_state_t& message);
void toLcmState(const ShaftInstant& instant, const LcmNote& note, shaft_state_t& message);

}  // namespace heerk_rotor
