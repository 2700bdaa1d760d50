#include "heerk_rotor/shaft/shaft_properties.hpp"

#include <cmath>
#include <sstream>

namespace heerk_rotor {
namespace {

/// Collects sentences "what = found, expected ...".
class Complaints {
 public:
  template <class Number>
  void expect(bool good, const std::string& what, Number found, const std::string& expected) {
    if (good) return;
    std::ostringstream text;
    text << what << " = " << found << ", expected " << expected;
    list.push_back(text.str());
  }
  void positive(const std::string& what, double value, const std::string& unit) {
    expect(value > 0.0 && std::isfinite(value), what, value, "a number > 0 [" + unit + "]");
  }
  void nonNegative(const std::string& what, double value, const std::string& unit) {
    expect(value >= 0.0 && std::isfinite(value), what, value, "a number >= 0 [" + unit + "]");
  }
  void node(const std::string& what, int value, int nodes) {
    expect(value >= 0 && value < nodes, what, value, "a node in 0.." + std::to_string(nodes - 1));
  }
  std::vector<std::string> list;
};

}  // namespace

std::vector<std::string> shaftProblems(const ShaftProperties& p) {
  Complaints wrong;
  wrong.expect(!p.segments.empty(), "number of segments", p.segments.size(), "at least 1");
  const auto fits = [&](const std::vector<double>& table) { return table.size() == 1 || table.size() == p.segments.size(); };
  const std::string lengths = "1 or one per segment, " + std::to_string(p.segments.size());
  wrong.expect(fits(p.diameter), "number of diameters", p.diameter.size(), lengths);
  wrong.expect(fits(p.inner_diameter), "number of inner diameters", p.inner_diameter.size(), lengths);
  if (!wrong.list.empty()) return wrong.list;

  for (std::size_t i = 0; i < p.segments.size(); ++i) {
    const std::string number = " " + std::to_string(i + 1);
    const double outer = p.diameter[p.diameter.size() == 1 ? 0 : i], inner = p.inner_diameter[p.inner_diameter.size() == 1 ? 0 : i];
    wrong.positive("length of segment" + number, p.segments[i], "m");
    wrong.positive("diameter of segment" + number, outer, "m");
    wrong.expect(inner >= 0.0 && inner < outer, "inner diameter of segment" + number, inner, "0 <= inner < outer diameter [m]");
  }
  wrong.positive("Young's modulus", p.youngs_modulus, "N/m^2");
  wrong.positive("density", p.density, "kg/m^3");
  wrong.expect(p.poisson_ratio > -1.0 && p.poisson_ratio <= 0.5, "Poisson's ratio", p.poisson_ratio, "a number in (-1, 0.5]");
  wrong.nonNegative("mass damping", p.mass_damping, "1/s");
  wrong.nonNegative("stiffness damping", p.stiffness_damping, "s");

  for (std::size_t i = 0; i < p.discs.size(); ++i) {
    const ShaftDisc& disc = p.discs[i];
    const std::string of = " of disc " + std::to_string(i + 1);
    wrong.node("node" + of, disc.node, p.nodes());
    wrong.nonNegative("mass" + of, disc.mass, "kg");
    wrong.nonNegative("diametral inertia" + of, disc.diametral_inertia, "kg m^2");
    // Perpendicular axes: J_p <= 2 J_d for any rigid body, equal for a flat one.
    wrong.expect(disc.polar_inertia >= 0.0 && disc.polar_inertia <= 2.0 * disc.diametral_inertia * (1.0 + 1e-9), "polar inertia" + of, disc.polar_inertia,
                 "0 .. twice the diametral inertia [kg m^2]");
    wrong.nonNegative("unbalance" + of, disc.unbalance, "kg m");
  }
  for (std::size_t i = 0; i < p.bearings.size(); ++i) {
    const ShaftBearing& bearing = p.bearings[i];
    const std::string of = " of bearing " + std::to_string(i + 1);
    wrong.node("node" + of, bearing.node, p.nodes());
    wrong.nonNegative("stiffness x" + of, bearing.stiffness_x, "N/m");
    wrong.nonNegative("stiffness y" + of, bearing.stiffness_y, "N/m");
    wrong.nonNegative("damping x" + of, bearing.damping_x, "N s/m");
    wrong.nonNegative("damping y" + of, bearing.damping_y, "N s/m");
  }
  return wrong.list;
}

}  // namespace heerk_rotor
