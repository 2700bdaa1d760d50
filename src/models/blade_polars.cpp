#include "heerk_rotor/models/blade_polars.hpp"

#include <algorithm>
#include <filesystem>

#include "heerk_rotor/aero/c81_reader.hpp"
#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/models/registry.hpp"

namespace heerk_rotor {
namespace {

/// Where r lies between stations: `first`, and the share of the one after it (0 beyond the ends).
struct Between {
  std::size_t first;
  double share;
};

Between between(const std::vector<double>& stations, double r) {
  const auto after = std::upper_bound(stations.begin(), stations.end(), r);
  if (after == stations.begin()) return {0, 0.0};
  const auto first = static_cast<std::size_t>(after - stations.begin()) - 1;
  if (after == stations.end()) return {first, 0.0};
  return {first, (r - stations[first]) / (stations[first + 1] - stations[first])};
}

/// The stations of a list of `count` values under `key`, read from `key`_stations. On a problem as many stations as values are made up,
/// so that reading can go on.
std::vector<double> readStations(Section& section, const std::string& key, std::size_t count) {
  const std::string name = key + "_stations";
  if (count == 1) {
    if (section.has(name)) section.problem(name, "not given, because " + key + " is a single value");
    section.list(name, {}, "r/R");
    return {0.0};
  }
  std::vector<double> stations = section.list(name, {}, "r/R", {0.0, 1.0, false});
  const bool ascending = std::is_sorted(stations.begin(), stations.end(), [](double a, double b) { return a <= b; });
  if (stations.size() == count && ascending) return stations;
  section.problem(name, "a list of " + std::to_string(count) + " ascending numbers in [0, 1] [r/R], one for each value of " + key);
  stations.clear();
  for (std::size_t i = 0; i < count; ++i) stations.push_back(static_cast<double>(i) / static_cast<double>(count - 1));
  return stations;
}

LinearPolar readLinearPolar(Section& section) {
  LinearPolar polar;
  polar.lift_slope = section.number("lift_slope", polar.lift_slope, "1/rad", positive());
  polar.zero_lift_angle = section.number("zero_lift_angle", polar.zero_lift_angle, "rad", {-0.5, 0.5, false});
  const std::vector<double> drag = section.list("drag", {polar.drag[0]}, "-, 1/rad, 1/rad^2");
  if (drag.size() > 3) section.problem("drag", "at most three coefficients: cd0 [-], cd1 [1/rad], cd2 [1/rad^2]");
  for (std::size_t i = 0; i < 3; ++i) polar.drag[i] = i < drag.size() ? drag[i] : 0.0;
  polar.moment = section.number("moment", polar.moment, "-", {-1.0, 1.0, false});
  return polar;
}

std::vector<C81Deck> readDecks(Section& section, const BuildContext& context, const std::vector<std::string>& paths) {
  std::vector<C81Deck> decks;
  for (const std::string& path : paths) {
    // An absolute path stays what it is.
    C81Reading reading = readC81File((std::filesystem::path(context.configuration.file()).parent_path() / path).string());
    for (const std::string& problem : reading.problems) section.problem("airfoil", "an airfoil in the C81 format, but " + problem);
    if (reading.ok()) decks.push_back(std::move(reading.deck));
  }
  return decks;
}

}  // namespace

BladePolars blendedPolars(const std::vector<C81Deck>& decks, const std::vector<double>& stations, const std::vector<double>& r, TableInterpolation interpolation) {
  BladePolars polars;
  std::vector<std::size_t> unblended(decks.size(), decks.size() + r.size());  // table of each deck alone; not built yet
  for (const double radius : r) {
    const Between at = between(stations, radius);
    const bool alone = at.share == 0.0;
    if (!alone || unblended[at.first] > polars.tables.size()) {
      if (alone) {
        polars.tables.emplace_back(decks[at.first], interpolation);
        unblended[at.first] = polars.tables.size() - 1;
      } else {
        polars.tables.emplace_back(decks[at.first], decks[at.first + 1], at.share, interpolation);
      }
    }
    polars.table_of_section.push_back(alone ? unblended[at.first] : polars.tables.size() - 1);
  }
  return polars;
}

BladePolars readBladePolars(Section& section, const BuildContext& context, const std::vector<double>& r) {
  // The keys of both kinds are accepted with either, so that one line, `polar`, swaps them; decks are opened only when they are used.
  BladePolars polars;
  const bool tabulated = section.word("polar", "linear", {"linear", "table"}) == "table";
  polars.linear = readLinearPolar(section);
  const bool cubic = section.word("interpolation", "linear", {"linear", "monotone_cubic"}) == "monotone_cubic";
  const std::vector<std::string> paths = section.words("airfoil");
  const std::vector<double> stations = readStations(section, "airfoil", paths.empty() ? 1 : paths.size());
  if (!tabulated) return polars;
  if (!section.has("airfoil")) section.problem("airfoil", "the path of a C81 deck, or a list of paths, because polar is table");
  const std::vector<C81Deck> decks = readDecks(section, context, paths);
  if (decks.empty() || decks.size() != paths.size()) return polars;
  return blendedPolars(decks, stations, r, cubic ? TableInterpolation::kMonotoneCubic : TableInterpolation::kLinear);
}

std::vector<double> readChord(Section& section, const std::vector<double>& r) {
  const std::vector<double> values = section.list("chord", {0.27}, "m", positive());
  const std::vector<double> stations = readStations(section, "chord", values.size());
  std::vector<double> chord;
  for (const double radius : r) {
    const Between at = between(stations, radius);
    chord.push_back(at.share == 0.0 ? values[at.first] : (1.0 - at.share) * values[at.first] + at.share * values[at.first + 1]);
  }
  return chord;
}

}  // namespace heerk_rotor
