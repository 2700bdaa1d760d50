#pragma once
#include "heerk_rotor/core/coupled_system.hpp"

namespace heerk_rotor {

/// What a coupled system is to the outside world: which messages tell of it.
enum class MachineKind {
  kRotor,  // has blades: offers lag, flap or another quantity per blade (RotorView)
  kShaft,  // has discs: offers displacement (ShaftView)
  kOther   // neither
};

/// Throws std::invalid_argument when the system is rotor and shaft at once, and whatever the views throw.
MachineKind machineKind(const CoupledSystem& system);

}  // namespace heerk_rotor
