#include "heerk_rotor/models/fe_rotor_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/models/elastic_mast.hpp"
#include "heerk_rotor/models/registry.hpp"

namespace heerk_rotor {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Spanwise tables of one blade.
void readTables(Section& section, BladeProperties& blade) {
  blade.nodes = section.list("nodes", blade.nodes, "m", nonNegative());
  blade.stations = section.list("stations", {}, "m", nonNegative());
  blade.mass = section.list("mass", blade.mass, "kg/m", positive());
  blade.EI_flap = section.list("EI_flap", blade.EI_flap, "N m^2", positive());
  blade.EI_lag = section.list("EI_lag", blade.EI_lag, "N m^2", positive());
  blade.GJ = section.list("GJ", blade.GJ, "N m^2", positive());
  blade.km1 = section.list("km1", blade.km1, "m", nonNegative());
  blade.km2 = section.list("km2", blade.km2, "m", nonNegative());
  blade.kA = section.list("kA", blade.kA, "m", nonNegative());
  blade.e = section.list("e", blade.e, "m");
  blade.eA = section.list("eA", blade.eA, "m");
  blade.EB1 = section.list("EB1", blade.EB1, "N m^4", nonNegative());
  blade.EB2 = section.list("EB2", blade.EB2, "N m^3");
  blade.root_lead = section.number("root_lead", 0.0, "m");
  blade.tip_mass = section.number("tip_mass", 0.0, "kg", nonNegative());
  blade.damping_mass = section.number("damping_mass", 0.0, "1/s", nonNegative());
  blade.damping_stiffness = section.number("damping_stiffness", 0.0, "s", nonNegative());
}

/// Built-in twist: a table over the stations, or linear over the radius.
void readTwist(Section& section, BladeProperties& blade) {
  if (section.has("twist_deg") && section.has("twist_deg_per_R"))
    section.problem("twist_deg", "either twist_deg over the stations or twist_deg_per_R");
  const double rate = section.number("twist_deg_per_R", 0.0, "deg", {-60.0, 60.0, false});
  const double zero = section.number("zero_twist_radius", 0.75, "parts of R", {0.0, 1.0, false});
  std::vector<double> table = section.list("twist_deg", {0.0}, "deg", {-90.0, 90.0, false});
  for (double& value : table) value *= kDegree;
  blade.twist = table;
  if (rate == 0.0) return;
  if (blade.stations.size() < 2) blade.stations = {blade.nodes.front(), blade.nodes.back()};
  blade.twist = linearTwist(blade.stations, rate * kDegree, blade.nodes.back(), zero * blade.nodes.back());
}

/// What one blade differs by from the others.
void readDifferences(Section& section, std::vector<BladeProperties>& blades) {
  const std::size_t n = blades.size();
  const bool flap_hinge = section.flag("flap_hinge", false), lag_hinge = section.flag("lag_hinge", false);
  const auto flap_spring = section.numbers("flap_spring", n, 0.0, "N m/rad", nonNegative());
  const auto lag_spring = section.numbers("lag_spring", n, 0.0, "N m/rad", nonNegative());
  const auto flap_damper = section.numbers("flap_damper", n, 0.0, "N m s/rad", nonNegative());
  const auto lag_damper = section.numbers("lag_damper", n, 0.0, "N m s/rad", nonNegative());
  const auto mass = section.numbers("mass_factor", n, 1.0, "-", positive());
  const auto stiffness = section.numbers("stiffness_factor", n, 1.0, "-", positive());
  for (std::size_t k = 0; k < n; ++k) {
    BladeProperties& blade = blades[k];
    blade.root = {flap_hinge, lag_hinge, flap_spring[k], lag_spring[k], flap_damper[k], lag_damper[k]};
    for (double& value : blade.mass) value *= mass[k];
    blade.tip_mass *= mass[k];
    for (auto* table : {&blade.EI_flap, &blade.EI_lag, &blade.GJ, &blade.EB1, &blade.EB2})
      for (double& value : *table) value *= stiffness[k];
  }
}

bool same(const BladeProperties& a, const BladeProperties& b) {
  return a.mass == b.mass && a.tip_mass == b.tip_mass && a.EI_flap == b.EI_flap && a.EI_lag == b.EI_lag && a.GJ == b.GJ && a.EB1 == b.EB1 && a.EB2 == b.EB2 &&
         a.root.flap_spring == b.root.flap_spring && a.root.lag_spring == b.root.lag_spring && a.root.flap_damper == b.root.flap_damper &&
         a.root.lag_damper == b.root.lag_damper;
}

}  // namespace

bool FeRotorParameters::equalBlades() const {
  return std::all_of(blades.begin(), blades.end(), [this](const BladeProperties& blade) { return same(blade, blades.front()); });
}

double twistFrequency(const BuildContext& context) {
  const std::string mast = context.onlySubsystemOfType("elastic_mast");
  const std::string rotor = context.onlySubsystemOfType("fe_rotor");
  if (formulationOf(context) == LagFormulation::kPrinted || mast.empty() || rotor.empty()) return 0.0;
  for (const char* port : {"hub_motion", "hub_acceleration"})
    if (!context.connects(mast + "." + port, rotor + "." + port)) return 0.0;
  Problems reported_by_the_mast_itself;
  Section section(context.configuration, "subsystems." + mast, reported_by_the_mast_itself);
  if (!section.has("hub_inertia")) return 0.0;
  const double stiffness = section.number("stiffness", ElasticMast::Parameters().stiffness, "N m/rad", positive());
  const double inertia = section.number("hub_inertia", 1.0, "kg m^2", positive());
  return reported_by_the_mast_itself.empty() ? std::sqrt(stiffness / inertia) : 0.0;
}

FeRotorParameters readFeRotorParameters(Section& section, double rotor_speed) {
  FeRotorParameters p;
  p.rotor_speed = rotor_speed;
  p.sections = readRotorSections(section);
  p.precone = kDegree * section.number("precone_deg", 0.0, "deg", {-20.0, 20.0, false});
  p.modes = static_cast<int>(section.integer("modes", 0, 0, 10000));
  p.small_angle = section.word("kinematics", "full", {"full", "small_angle"}) == "small_angle";

  BladeProperties blade;  // a plain uniform blade unless the file says otherwise
  blade.nodes = {0.2, 4.91};
  blade.mass = {5.5};
  blade.EI_flap = {8000.0};
  blade.EI_lag = {80000.0};
  blade.GJ = {6000.0};
  blade.km1 = {0.0075};
  blade.km2 = {0.073};
  const std::size_t problems = section.problems().list().size();
  readTables(section, blade);
  readTwist(section, blade);
  p.blades.assign(static_cast<std::size_t>(p.sections.blades), blade);
  readDifferences(section, p.blades);
  section.finish();
  if (section.problems().list().size() == problems)
    for (const std::string& problem : bladeProblems(p.blades.front())) section.problem("type", "a blade in order: " + problem);
  if (p.modes > 0 && p.modes > static_cast<int>(5 * (blade.nodes.size() - 1) + 2)) section.problem("modes", "at most the blade's degrees of freedom");
  return p;
}

}  // namespace heerk_rotor
