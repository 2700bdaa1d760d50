#include <cmath>

#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/models/shaft_rotor.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Numbers of nodes, each checked; what is wrong is recorded and left out.
std::vector<int> readNodes(Section& section, const std::string& key, int nodes) {
  std::vector<int> result;
  if (!section.has(key)) return result;
  for (const double value : section.list(key, {}, "node")) {
    if (value == std::floor(value) && value >= 0.0 && value < nodes) result.push_back(static_cast<int>(value));
    else section.problem(key, "whole numbers in 0.." + std::to_string(nodes - 1) + ", the nodes between and at the ends of the segments");
  }
  return result;
}

std::vector<ShaftDisc> readDiscs(Section section, int nodes) {
  const std::vector<int> node = readNodes(section, "nodes", nodes);
  const std::size_t n = node.size();
  const auto mass = section.numbers("mass", n, 0.0, "kg", nonNegative());
  const auto diametral = section.numbers("diametral_inertia", n, 0.0, "kg m^2", nonNegative());
  const auto polar = section.numbers("polar_inertia", n, 0.0, "kg m^2", nonNegative());
  const auto unbalance = section.numbers("unbalance", n, 0.0, "kg m", nonNegative());
  const auto angle = section.numbers("unbalance_angle_deg", n, 0.0, "deg", {-360.0, 360.0, false});
  section.finish();
  std::vector<ShaftDisc> discs;
  for (std::size_t i = 0; i < n; ++i) discs.push_back({node[i], mass[i], diametral[i], polar[i], unbalance[i], angle[i] * kDegree});
  return discs;
}

std::vector<ShaftBearing> readBearings(Section section, int nodes) {
  const std::vector<int> node = readNodes(section, "nodes", nodes);
  const std::size_t n = node.size();
  const auto stiffness_x = section.numbers("stiffness_x", n, 0.0, "N/m", nonNegative());
  const auto stiffness_y = section.numbers("stiffness_y", n, 0.0, "N/m", nonNegative());
  const auto damping_x = section.numbers("damping_x", n, 0.0, "N s/m", nonNegative());
  const auto damping_y = section.numbers("damping_y", n, 0.0, "N s/m", nonNegative());
  section.finish();
  std::vector<ShaftBearing> bearings;
  for (std::size_t i = 0; i < n; ++i) bearings.push_back({node[i], stiffness_x[i], stiffness_y[i], damping_x[i], damping_y[i]});
  return bearings;
}

/// A table over the segments, or one number for all.
std::vector<double> readTable(Section& section, const std::string& key, double fallback, std::size_t segments, Range range) {
  std::vector<double> table = section.list(key, {fallback}, "m", range);
  if (table.size() == 1 || table.size() == segments) return table;
  section.problem(key, "one number [m], or one per segment (" + std::to_string(segments) + ", not " + std::to_string(table.size()) + ")");
  return {fallback};
}

}  // namespace

ShaftRotorParameters readShaftRotorParameters(Section& section, const SimulationSettings& simulation) {
  ShaftRotorParameters p;
  p.rotor_speed = simulation.rotor_speed;
  ShaftProperties& shaft = p.shaft;
  const std::size_t problems = section.problems().list().size();
  if (!section.has("segments")) section.problem("segments", "the length of each finite element from node 0 on [m], as a list");
  shaft.segments = section.list("segments", {1.0}, "m", positive());
  shaft.diameter = readTable(section, "diameter", 0.03, shaft.segments.size(), positive());
  shaft.inner_diameter = readTable(section, "inner_diameter", 0.0, shaft.segments.size(), nonNegative());
  shaft.youngs_modulus = section.number("youngs_modulus", shaft.youngs_modulus, "N/m^2", positive());
  shaft.density = section.number("density", shaft.density, "kg/m^3", positive());
  shaft.poisson_ratio = section.number("poisson_ratio", shaft.poisson_ratio, "-", {-1.0, 0.5, true});
  shaft.shear = section.flag("shear", shaft.shear);
  shaft.mass_damping = section.number("mass_damping", shaft.mass_damping, "1/s", nonNegative());
  shaft.stiffness_damping = section.number("stiffness_damping", shaft.stiffness_damping, "s", nonNegative());
  shaft.discs = readDiscs(section.child("discs"), shaft.nodes());
  shaft.bearings = readBearings(section.child("bearings"), shaft.nodes());
  p.journals = readNodes(section, "journals", shaft.nodes());
  p.modal = section.word("coordinates", "modal", {"modal", "physical"}) == "modal";
  // As states of S, cos and sin of the azimuth are as exact as the method's treatment of S: Newmark's would drift in phase.
  p.unbalance_in_exponential = section.flag("unbalance_in_exponential", simulation.integrator != "Newmark");
  p.linearised_film_damping = section.number("linearised_film_damping", 0.0, "N s/m", nonNegative());
  if (p.linearised_film_damping > 0.0 && p.journals.empty()) section.problem("linearised_film_damping", "0 where there are no journals");
  section.finish();
  if (section.problems().list().size() == problems)
    for (const std::string& problem : shaftProblems(shaft)) section.problem("type", "a shaft in order: " + problem);
  return p;
}

Made makeShaftRotor(Section& section, const BuildContext& context) {
  const std::size_t problems = section.problems().list().size();
  const ShaftRotorParameters p = readShaftRotorParameters(section, context.simulation);
  return section.problems().list().size() == problems ? makeShaftRotorModel(p) : nullptr;
}

}  // namespace heerk_rotor
