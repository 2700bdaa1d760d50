#include "heerk_rotor/assembly/machine_kind.hpp"

#include <stdexcept>

#include "heerk_rotor/assembly/rotor_view.hpp"
#include "heerk_rotor/assembly/shaft_view.hpp"

namespace heerk_rotor {

MachineKind machineKind(const CoupledSystem& system) {
  const bool shaft = ShaftView(system).discs() > 0, rotor = RotorView(system).blades() > 0;
  if (shaft && rotor) throw std::invalid_argument("the system offers displacement (of a shaft's discs) and quantities per blade (of a rotor): expected one of both");
  return shaft ? MachineKind::kShaft : rotor ? MachineKind::kRotor : MachineKind::kOther;
}

}  // namespace heerk_rotor
