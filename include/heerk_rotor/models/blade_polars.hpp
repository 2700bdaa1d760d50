#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "heerk_rotor/aero/airfoil_table.hpp"
#include "heerk_rotor/aero/linear_polar.hpp"

namespace heerk_rotor {

class Section;
struct BuildContext;

/// Section polars along a blade: one formula everywhere, or a table per section.
struct BladePolars {
  LinearPolar linear;                         // used if there are no tables
  std::vector<AirfoilTable> tables;
  std::vector<std::size_t> table_of_section;  // (sections), into `tables`; sections of the same airfoil share one

  bool tabulated() const { return !tables.empty(); }
};

/// Tables for sections at the radii r, from decks that hold at `stations` (same unit as r, ascending, as many as decks): blended
/// linearly in r between two stations, constant inside the first and outside the last.
BladePolars blendedPolars(const std::vector<C81Deck>& decks, const std::vector<double>& stations, const std::vector<double>& r, TableInterpolation interpolation);

/// Reads `polar: linear | table` and the keys of either for sections at r [parts of R]:
///   linear  lift_slope, zero_lift_angle, drag (up to three coefficients), moment
///   table   airfoil (path of a C81 deck, or a list of them), airfoil_stations (r/R of each), interpolation
/// Paths are relative to the directory of the configuration file. What is wrong with a deck becomes a problem of the key
/// `airfoil` that names the line of the deck.
BladePolars readBladePolars(Section& section, const BuildContext& context, const std::vector<double>& r);

/// Reads the key `chord` [m], a number or a list, with `chord_stations` (r/R of each, ascending); piecewise linear, constant beyond
/// the ends. Returns the chord at each r [parts of R].
std::vector<double> readChord(Section& section, const std::vector<double>& r);

}  // namespace heerk_rotor
