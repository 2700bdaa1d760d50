#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/core/types.hpp"

namespace heerk_rotor {

class Section;
struct BuildContext;

/// Radii at which airloads act on the blades of a rotor: what the structural and the aerodynamic model must agree on.
/// Ports per section hold [section][component][blade], blades innermost, see sectionEntry().
struct RotorSections {
  int blades = 0;
  double radius = 0.0;         // of the tip [m]
  std::vector<double> r;       // of the sections, ascending [m]
  std::vector<double> width;   // that one section stands for [m]

  Index count() const { return static_cast<Index>(r.size()); }
  /// Size of a port with `components` values per section and blade.
  Index portSize(Index components) const { return count() * components * blades; }
};

/// Position of one value in such a port.
inline Index sectionEntry(Index section, Index component, Index components, Index blade, Index blades) {
  return (section * components + component) * blades + blade;
}

/// Centres of `count` equal segments from `inner` to `outer` (midpoint rule: airloads as the HEERK paper's rotor applies them), or
/// nodes and weights of Gauss-Legendre quadrature, which integrates polynomial loads exactly.
enum class SectionRule { kMidpoint, kGauss };
void placeSections(SectionRule rule, int count, double inner, double outer, RotorSections& sections);

/// Reads the keys of a rotor that decide its sections: blades, nodes (tip), sections, root_cutout, section_rule.
RotorSections readRotorSections(Section& rotor);

/// The sections of the fe_rotor that this model serves: the one named by `rotor:` in `section`, or the only one there is.
/// Records a problem when there is none.
RotorSections sectionsOfRotor(Section& section, const BuildContext& context);

/// Names of the entries of a port per section, "<name>_<section>_<component>_<blade>", all counted from 1 except the
/// components, which have names ("" for a port with a single component).
std::vector<std::string> sectionEntryNames(const std::string& name, const std::vector<std::string>& components, const RotorSections& sections);

}  // namespace heerk_rotor
