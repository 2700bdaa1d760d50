#include "heerk_rotor/ros/shaft_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "heerk_rotor/config/section.hpp"

namespace heerk_rotor {
namespace {

constexpr double kUsualMagnification = 500.0;

/// Path of the first subsystem of that type; empty: there is none.
std::string subsystemOfType(const Configuration& configuration, const std::string& type) {
  Problems ignored;
  for (const auto& entry : configuration.root()["subsystems"]) {
    const std::string path = "subsystems." + entry.first.as<std::string>();
    if (Section(configuration, path, ignored).word("type", "") == type) return path;
  }
  return "";
}

/// z of nodes given by number.
std::vector<double> places(const std::vector<double>& numbers, const std::vector<double>& nodes) {
  std::vector<double> z;
  for (const double number : numbers)
    if (number >= 0.0 && number < static_cast<double>(nodes.size())) z.push_back(nodes[static_cast<std::size_t>(number)]);
  return z;
}

/// m r^2 / 2 = Jp, m (3 r^2 + t^2) / 12 = Jd; a disc that is no solid cylinder gets a fair thickness.
ShaftGeometry::Disc drawnDisc(double z, double mass, double polar, double diametral) {
  const double radius = std::sqrt(2.0 * polar / mass), square = 12.0 * diametral / mass - 3.0 * radius * radius;
  return {z, radius, square > 1e-4 * radius * radius ? std::sqrt(square) : 0.1 * radius};
}

void readShaft(Section shaft, ShaftGeometry& geometry) {
  geometry.nodes = {0.0};
  for (const double segment : shaft.list("segments", {}, "m")) geometry.nodes.push_back(geometry.nodes.back() + segment);
  geometry.diameter = shaft.list("diameter", {geometry.diameter}, "m").front();
  Section discs = shaft.child("discs"), bearings = shaft.child("bearings");
  const std::vector<double> z = places(discs.list("nodes", {}, "-"), geometry.nodes);
  const std::vector<double> mass = discs.numbers("mass", z.size(), 1.0, "kg"), polar = discs.numbers("polar_inertia", z.size(), 0.01, "kg m^2"),
                            diametral = discs.numbers("diametral_inertia", z.size(), 0.005, "kg m^2");
  for (std::size_t i = 0; i < z.size(); ++i) geometry.discs.push_back(drawnDisc(z[i], mass[i], polar[i], diametral[i]));
  geometry.bearings = places(bearings.list("nodes", {}, "-"), geometry.nodes);
  const std::vector<double> journals = places(shaft.list("journals", {}, "-"), geometry.nodes);
  if (!journals.empty()) geometry.journal = journals.front();
}

void readFilm(Section film, ShaftGeometry& geometry) {
  geometry.clearance = film.number("clearance", 0.0, "m");
  geometry.housing_x = -geometry.clearance * film.number("static_eccentricity_x", 0.0, "-");
  geometry.housing_y = -geometry.clearance * film.number("static_eccentricity_y", -0.2, "-");
}

}  // namespace

double ShaftGeometry::magnification() const {
  if (clearance <= 0.0 || length() <= 0.0) return kUsualMagnification;
  const double wanted = 0.15 * length() / clearance, decade = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double factor : {5.0, 2.0})
    if (factor * decade <= wanted) return factor * decade;
  return decade;
}

ShaftGeometry readShaftGeometry(const Configuration& configuration) {
  Problems ignored;  // the simulation has been built from this configuration
  ShaftGeometry geometry;
  if (const std::string shaft = subsystemOfType(configuration, "shaft_rotor"); !shaft.empty()) readShaft(Section(configuration, shaft, ignored), geometry);
  if (const std::string film = subsystemOfType(configuration, "squeeze_film_damper"); !film.empty()) readFilm(Section(configuration, film, ignored), geometry);
  return geometry;
}

}  // namespace heerk_rotor
