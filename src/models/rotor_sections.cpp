#include "heerk_rotor/models/rotor_sections.hpp"

#include <cmath>

#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/models/registry.hpp"

namespace heerk_rotor {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Root number i of the Legendre polynomial P_n in (-1, 1) and its derivative there, by Newton from Tricomi's estimate.
void legendreRoot(int n, int i, double& root, double& derivative) {
  root = -std::cos(kPi * (i + 0.75) / (n + 0.5));
  for (int iteration = 0; iteration < 100; ++iteration) {
    double p = 1.0, previous = 0.0;
    for (int k = 1; k <= n; ++k) {
      const double next = ((2 * k - 1) * root * p - (k - 1) * previous) / k;
      previous = p;
      p = next;
    }
    derivative = n * (root * p - previous) / (root * root - 1.0);
    const double correction = p / derivative;
    root -= correction;
    if (std::abs(correction) < 1e-16) return;
  }
}

}  // namespace

void placeSections(SectionRule rule, int count, double inner, double outer, RotorSections& sections) {
  sections.r.clear();
  sections.width.clear();
  const double length = outer - inner;
  for (int i = 0; i < count; ++i) {
    if (rule == SectionRule::kMidpoint) {
      sections.r.push_back(inner + length * (i + 0.5) / count);
      sections.width.push_back(length / count);
    } else {
      double root, derivative;
      legendreRoot(count, i, root, derivative);
      sections.r.push_back(inner + 0.5 * length * (1.0 + root));
      sections.width.push_back(length / ((1.0 - root * root) * derivative * derivative));
    }
  }
}

RotorSections readRotorSections(Section& rotor) {
  RotorSections sections;
  sections.blades = static_cast<int>(rotor.integer("blades", 4, 2, 8));
  const std::vector<double> nodes = rotor.list("nodes", {0.2, 4.91}, "m", nonNegative());
  sections.radius = nodes.empty() ? 1.0 : nodes.back();
  const double root = nodes.empty() ? 0.0 : nodes.front();
  const int count = static_cast<int>(rotor.integer("sections", 10, 1, 200));
  const double cutout = rotor.number("root_cutout", root, "m", {root, sections.radius, false});
  const bool gauss = rotor.word("section_rule", "midpoint", {"midpoint", "gauss"}) == "gauss";
  placeSections(gauss ? SectionRule::kGauss : SectionRule::kMidpoint, count, cutout, sections.radius, sections);
  return sections;
}

RotorSections sectionsOfRotor(Section& section, const BuildContext& context) {
  const std::string name = section.word("rotor", context.onlySubsystemOfType("fe_rotor"));
  Problems reported_by_the_rotor_itself;
  Section rotor(context.configuration, "subsystems." + name, reported_by_the_rotor_itself);
  if (name.empty() || rotor.word("type", "") != "fe_rotor") {
    section.problem("rotor", "the name of the fe_rotor this model belongs to (the configuration has not exactly one)");
    RotorSections none;
    none.blades = 4;
    none.radius = 1.0;
    placeSections(SectionRule::kMidpoint, 1, 0.0, 1.0, none);
    return none;
  }
  return readRotorSections(rotor);
}

std::vector<std::string> sectionEntryNames(const std::string& name, const std::vector<std::string>& components, const RotorSections& sections) {
  std::vector<std::string> names;
  for (Index j = 0; j < sections.count(); ++j)
    for (const std::string& component : components)
      for (int k = 0; k < sections.blades; ++k)
        names.push_back(name + "_" + std::to_string(j + 1) + (component.empty() ? "" : "_" + component) + "_" + std::to_string(k + 1));
  return names;
}

}  // namespace heerk_rotor
