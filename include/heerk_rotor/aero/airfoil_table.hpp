#pragma once
#include <vector>

#include "heerk_rotor/aero/c81_deck.hpp"
#include "heerk_rotor/aero/grid_search.hpp"
#include "heerk_rotor/aero/lanes.hpp"

namespace heerk_rotor {

/// How a table is read between its grid points.
enum class TableInterpolation {
  kLinear,         // bilinear in alpha and Mach, as decks are commonly used; continuous
  kMonotoneCubic,  // PCHIP (Fritsch-Carlson) in alpha, linear in Mach; continuously differentiable in alpha, no overshoot
};

/// Lift, drag and moment coefficients of an airfoil against angle of attack and Mach number, from C81 decks.
///
/// The blocks of a deck have grids of their own. They are brought to their union here, where each block's own interpolant is
/// represented exactly, so that one cell search serves all three coefficients, which lie side by side in memory.
/// alpha is any angle [rad]: the table is periodic if a block spans -180 to 180 deg. Otherwise, and in Mach, values
/// are held constant outside the grid (a block narrower than the others likewise). NaN in, NaN out.
class AirfoilTable {
 public:
  struct Coefficients {
    double lift, drag, moment;
  };

  /// deck: as readC81 gives it without problems; otherwise std::invalid_argument.
  explicit AirfoilTable(const C81Deck& deck, TableInterpolation interpolation = TableInterpolation::kLinear);
  /// (1 - outer_share) inner + outer_share outer, for a section between two airfoils; exact as above.
  AirfoilTable(const C81Deck& inner, const C81Deck& outer, double outer_share, TableInterpolation interpolation = TableInterpolation::kLinear);

  /// At alpha [rad] and mach.
  Coefficients at(double alpha, double mach) const noexcept;
  /// The same for N blades at once; N is 1, 4 or 8.
  template <int N>
  void at(const Lanes<N>& alpha, const Lanes<N>& mach, Lanes<N>& lift, Lanes<N>& drag, Lanes<N>& moment) const noexcept;

  bool periodic() const { return periodic_; }
  TableInterpolation interpolation() const { return interpolation_; }

 private:
  struct alignas(32) Node {
    double lift, drag, moment, unused;
  };
  template <int N, TableInterpolation interpolation>
  void evaluate(const Lanes<N>& alpha, const Lanes<N>& mach, Lanes<N>& lift, Lanes<N>& drag, Lanes<N>& moment) const noexcept;
  void build(const std::vector<const C81Deck*>& decks, const std::vector<double>& shares);

  TableInterpolation interpolation_;
  bool periodic_ = false;
  int mach_count_ = 0;
  GridSearch alpha_search_, mach_search_;
  std::vector<Node> nodes_;  // linear: (alpha x mach) values; cubic: (alpha x mach x 2) values and slopes d/dalpha [1/rad]
};

}  // namespace heerk_rotor
