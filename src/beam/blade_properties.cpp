#include "heerk_rotor/beam/blade_properties.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace heerk_rotor {
namespace {

using Table = std::vector<double>;

/// A table with what its values may be.
struct TableRule {
  const char* name;
  const char* unit;
  const Table BladeProperties::*table;
  enum Range { kPositive, kNotNegative, kAny } range;
};

const TableRule kTables[] = {
    {"mass", "kg/m", &BladeProperties::mass, TableRule::kPositive},
    {"EI_flap", "N m^2", &BladeProperties::EI_flap, TableRule::kPositive},
    {"EI_lag", "N m^2", &BladeProperties::EI_lag, TableRule::kPositive},
    {"GJ", "N m^2", &BladeProperties::GJ, TableRule::kPositive},
    {"km1", "m", &BladeProperties::km1, TableRule::kNotNegative},
    {"km2", "m", &BladeProperties::km2, TableRule::kNotNegative},
    {"kA", "m", &BladeProperties::kA, TableRule::kNotNegative},
    {"e", "m", &BladeProperties::e, TableRule::kAny},
    {"eA", "m", &BladeProperties::eA, TableRule::kAny},
    {"EB1", "N m^4", &BladeProperties::EB1, TableRule::kNotNegative},
    {"EB2", "N m^3", &BladeProperties::EB2, TableRule::kAny},
    {"twist", "rad", &BladeProperties::twist, TableRule::kAny},
};

class Problems {
 public:
  template <class... Parts>
  void add(const Parts&... parts) {
    std::ostringstream text;
    (text << ... << parts);
    list_.push_back(text.str());
  }
  std::vector<std::string> take() { return std::move(list_); }

 private:
  std::vector<std::string> list_;
};

/// True when the radii are usable.
bool checkRadii(Problems& problems, const char* name, const Table& radii) {
  bool good = true;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (!std::isfinite(radii[i]) || radii[i] < 0) {
      problems.add(name, "[", i, "] = ", radii[i], " m, expected a finite radius >= 0");
      good = false;
    } else if (i > 0 && !(radii[i] > radii[i - 1])) {
      problems.add(name, "[", i, "] = ", radii[i], " m, expected more than ", name, "[", i - 1, "] = ", radii[i - 1], " m");
      good = false;
    }
  }
  return good;
}

bool checkTable(Problems& problems, const TableRule& rule, const BladeProperties& p) {
  const Table& table = p.*rule.table;
  if (table.empty() || (table.size() != 1 && table.size() != p.stations.size())) {
    problems.add(rule.name, " has ", table.size(), " values, expected 1 or one for each of the ", p.stations.size(), " stations");
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const bool in_range = rule.range == TableRule::kAny || (rule.range == TableRule::kPositive ? table[i] > 0 : table[i] >= 0);
    if (std::isfinite(table[i]) && in_range) continue;
    good = false;
    problems.add(rule.name, "[", i, "] = ", table[i], " ", rule.unit, ", expected a finite number",
                 rule.range == TableRule::kPositive ? " > 0" : rule.range == TableRule::kNotNegative ? " >= 0" : "");
  }
  return good;
}

void checkNotNegative(Problems& problems, const char* name, const char* unit, double value) {
  if (!(std::isfinite(value) && value >= 0)) problems.add(name, " = ", value, " ", unit, ", expected a finite number >= 0");
}

/// Left station of the segment that holds x, and x's position in it (0..1; constant beyond the ends).
struct Place {
  std::size_t left;
  BeamReal fraction;
  BeamReal length;  // of the segment [m]; 0 beyond the stations
};

Place placeOf(const Table& stations, BeamReal x) {
  if (stations.size() < 2 || x < stations.front()) return {0, 0, 0};
  if (x > stations.back()) return {stations.size() - 2, 1, 0};
  std::size_t left = std::upper_bound(stations.begin(), stations.end(), x) - stations.begin() - 1;
  left = std::min(left, stations.size() - 2);
  const BeamReal length = static_cast<BeamReal>(stations[left + 1]) - stations[left];
  return {left, (x - stations[left]) / length, length};
}

BeamReal interpolate(const Table& table, const Place& place) {
  if (table.size() == 1) return table[0];
  return table[place.left] * (1 - place.fraction) + table[place.left + 1] * place.fraction;
}

}  // namespace

std::vector<double> linearTwist(const std::vector<double>& stations, double per_radius, double radius, double zero_radius) {
  std::vector<double> twist;
  for (double r : stations) twist.push_back(per_radius * (r - zero_radius) / radius);
  return twist;
}

std::vector<std::string> bladeProblems(const BladeProperties& p) {
  Problems problems;

  // Radii.
  const bool good_nodes = checkRadii(problems, "nodes", p.nodes);
  const bool good_stations = checkRadii(problems, "stations", p.stations);
  if (p.nodes.size() < 2) problems.add("nodes: ", p.nodes.size(), " given, expected at least 2 (one element)");
  if (p.stations.size() == 1) problems.add("stations: 1 given, expected none (constant tables) or at least 2");
  if (good_nodes && good_stations && p.nodes.size() >= 2 && p.stations.size() >= 2) {
    if (p.stations.front() > p.nodes.front())
      problems.add("stations[0] = ", p.stations.front(), " m, expected at most nodes[0] = ", p.nodes.front(), " m");
    if (p.stations.back() < p.nodes.back())
      problems.add("stations: last = ", p.stations.back(), " m, expected at least the tip, ", p.nodes.back(), " m");
  }

  // Tables, each alone and then the torsional inertia that must stay positive.
  bool good_tables = true;
  for (const TableRule& rule : kTables) good_tables = checkTable(problems, rule, p) && good_tables;
  if (good_tables) {
    const std::size_t count = std::max<std::size_t>(1, p.stations.size());
    const auto at = [](const Table& table, std::size_t i) { return table[table.size() == 1 ? 0 : i]; };
    for (std::size_t i = 0; i < count; ++i) {
      const double km1 = at(p.km1, i);
      const double km2 = at(p.km2, i);
      const double e = at(p.e, i);
      if (km1 * km1 + km2 * km2 - e * e > 0) continue;
      problems.add("km1, km2, e at station ", i, " = ", km1, ", ", km2, ", ", e,
                   " m, expected km1^2 + km2^2 > e^2 (km2 is about the elastic axis)");
    }
  }

  // Scalars.
  if (!std::isfinite(p.root_lead)) problems.add("root_lead = ", p.root_lead, " m, expected a finite number");
  checkNotNegative(problems, "tip_mass", "kg", p.tip_mass);
  checkNotNegative(problems, "damping_mass", "1/s", p.damping_mass);
  checkNotNegative(problems, "damping_stiffness", "s", p.damping_stiffness);
  const auto hinge = [&](const char* name, bool present, double spring, double damper) {
    const std::string prefix = name;
    checkNotNegative(problems, (prefix + "_spring").c_str(), "N m/rad", spring);
    checkNotNegative(problems, (prefix + "_damper").c_str(), "N m s/rad", damper);
    if (!present && (spring != 0 || damper != 0))
      problems.add(name, "_spring, ", name, "_damper = ", spring, ", ", damper, ", expected 0: there is no ", name, " hinge");
  };
  hinge("flap", p.root.flap_hinge, p.root.flap_spring, p.root.flap_damper);
  hinge("lag", p.root.lag_hinge, p.root.lag_spring, p.root.lag_damper);
  return problems.take();
}

BladeSection bladeSection(const BladeProperties& p, BeamReal x) {
  const Place place = placeOf(p.stations, x);
  BladeSection s;
  s.mass = interpolate(p.mass, place);
  s.EI_flap = interpolate(p.EI_flap, place);
  s.EI_lag = interpolate(p.EI_lag, place);
  s.GJ = interpolate(p.GJ, place);
  s.km1 = interpolate(p.km1, place);
  s.km2 = interpolate(p.km2, place);
  s.kA = interpolate(p.kA, place);
  s.e = interpolate(p.e, place);
  s.eA = interpolate(p.eA, place);
  s.EB1 = interpolate(p.EB1, place);
  s.EB2 = interpolate(p.EB2, place);
  s.twist = interpolate(p.twist, place);
  s.twist_rate = 0;
  if (p.twist.size() > 1 && place.length > 0)
    s.twist_rate = (static_cast<BeamReal>(p.twist[place.left + 1]) - p.twist[place.left]) / place.length;
  return s;
}

std::vector<double> bladeBreaks(const BladeProperties& p) {
  std::vector<double> breaks = p.nodes;
  for (double station : p.stations)
    if (station > p.nodes.front() && station < p.nodes.back()) breaks.push_back(station);
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

namespace {

/// int_a^b m r^power dr for m linear from m_a to m_b; Simpson's rule is exact up to power 2 with m linear.
BeamReal massMoment(BeamReal a, BeamReal b, BeamReal m_a, BeamReal m_b, int power) {
  const BeamReal middle = (a + b) / 2;
  const auto raised = [power](BeamReal r) { return power == 0 ? BeamReal(1) : power == 1 ? r : r * r; };
  return (b - a) / 6 * (m_a * raised(a) + 2 * (m_a + m_b) * raised(middle) + m_b * raised(b));
}

}  // namespace

BladeTension::BladeTension(const BladeProperties& p) : breaks_(bladeBreaks(p)) {
  for (double r : breaks_) mass_.push_back(bladeSection(p, r).mass);
  from_here_.resize(breaks_.size());
  mass_from_here_.resize(breaks_.size());
  from_here_.back() = static_cast<BeamReal>(p.tip_mass) * breaks_.back();
  mass_from_here_.back() = p.tip_mass;
  for (std::size_t i = breaks_.size() - 1; i-- > 0;) {
    from_here_[i] = from_here_[i + 1] + massMoment(breaks_[i], breaks_[i + 1], mass_[i], mass_[i + 1], 1);
    mass_from_here_[i] = mass_from_here_[i + 1] + massMoment(breaks_[i], breaks_[i + 1], mass_[i], mass_[i + 1], 0);
  }
}

BeamReal BladeTension::outboard(BeamReal x, int power, const std::vector<BeamReal>& from_here) const {
  if (x <= breaks_.front()) return from_here.front();
  if (x >= breaks_.back()) return from_here.back();
  const std::size_t right = std::upper_bound(breaks_.begin(), breaks_.end(), x) - breaks_.begin();
  const BeamReal a = breaks_[right - 1];
  const BeamReal b = breaks_[right];
  const BeamReal mass = mass_[right - 1] + (mass_[right] - mass_[right - 1]) * (x - a) / (b - a);
  return from_here[right] + massMoment(x, b, mass, mass_[right], power);
}

BladeInertia bladeInertia(const BladeProperties& p) {
  const std::vector<double> breaks = bladeBreaks(p);
  const BeamReal tip = breaks.back();
  BeamReal moments[3] = {p.tip_mass, p.tip_mass * tip, p.tip_mass * tip * tip};
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const BeamReal m_a = bladeSection(p, breaks[i]).mass;
    const BeamReal m_b = bladeSection(p, breaks[i + 1]).mass;
    for (int power = 0; power < 3; ++power) moments[power] += massMoment(breaks[i], breaks[i + 1], m_a, m_b, power);
  }
  return {static_cast<double>(moments[0]), static_cast<double>(moments[1]), static_cast<double>(moments[2])};
}

}  // namespace heerk_rotor
