#pragma once
#include <memory>

#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/models/rotor_sections.hpp"

namespace heerk_rotor::work_precision {

/// The airloads that the configuration describes in `subsystems.airloads`, with the linear polar in place of tables, at the given sections.
/// (A file of its own because the headers of beam and airloads each have a BladeSection.)
std::unique_ptr<SubsystemModel> makeSmoothAirloads(const Configuration& configuration, const RotorSections& sections, double rotor_speed);

}  // namespace heerk_rotor::work_precision
