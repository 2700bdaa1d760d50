#pragma once
#include <vector>

#include "heerk_rotor/beam/blade_properties.hpp"
#include "heerk_rotor/models/rotor_sections.hpp"

namespace heerk_rotor {

struct BuildContext;

/// Parameters of the elastic rotor.
struct FeRotorParameters {
  RotorSections sections;               // blades, tip radius, radii of the airloads
  std::vector<BladeProperties> blades;  // one per blade
  double rotor_speed = 0.0;             // nominal: of the modes and of S [rad/s]
  double precone = 0.0;                 // up positive [rad]
  int modes = 0;                        // lowest modes kept per blade; 0: all
  bool small_angle = false;             // first order in pitch, slopes and precone, as the textbook's closed forms
  double absolute_below = 0.0;          // modes slower than this count from the drive instead of the hub (see BladeCoefficients) [rad/s]

  bool equalBlades() const;
};

/// Frequency of the only elastic mast with a hub of its own that is connected with the only fe_rotor, blades left out [rad/s]: modes of the blades that
/// are slower count from the drive. 0 where there is no such pair, and with `formulation: printed`.
double twistFrequency(const BuildContext& context);

/// Reads `subsystems.<rotor>`; records problems. Finishes the section.
FeRotorParameters readFeRotorParameters(Section& section, double rotor_speed);

}  // namespace heerk_rotor
