#pragma once
#include <string>

#include "heerk_rotor/core/coupled_system.hpp"

namespace heerk_rotor {

/// Where an output port stands in y.
struct PortRange {
  Index begin = -1, size = 0;
  bool present() const noexcept { return begin >= 0; }
};

/// "subsystem.name" without its subsystem.
std::string localName(const std::string& name);

/// The output port of that name, whatever subsystem offers it; absent when none does. `size` 0 accepts any.
/// Throws std::invalid_argument, beginning with `viewer`, when two subsystems offer it or the size differs.
PortRange findPort(const CoupledSystem& system, const std::string& viewer, const std::string& quantity, Index size);

}  // namespace heerk_rotor
