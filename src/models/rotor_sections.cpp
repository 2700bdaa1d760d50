#include "heerk_rotor/models/rotor_sections.hpp"

#include "heerk_rotor/beam/gauss_rule.hpp"
#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/models/registry.hpp"

namespace heerk_rotor {
void placeSections(SectionRule rule, int count, double inner, double outer, RotorSections& sections) {
  sections.r.clear();
  sections.width.clear();
  const double length = outer - inner;
  if (rule == SectionRule::kMidpoint) {
    for (int i = 0; i < count; ++i) {
      sections.r.push_back(inner + length * (i + 0.5) / count);
      sections.width.push_back(length / count);
    }
    return;
  }
  const GaussRule gauss(count);
  for (std::size_t i = 0; i < gauss.node.size(); ++i) {
    sections.r.push_back(inner + length * static_cast<double>(gauss.node[i]));
    sections.width.push_back(length * static_cast<double>(gauss.weight[i]));
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
