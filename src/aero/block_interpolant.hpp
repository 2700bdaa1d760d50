#pragma once
#include <vector>

#include "heerk_rotor/aero/airfoil_table.hpp"

namespace heerk_rotor {

/// One block of a deck as a function of alpha and Mach on its own grid. Used to build tables, not in the step.
class BlockInterpolant {
 public:
  struct Sample {
    double value;
    double slope;  // d/dalpha [1/rad], of the cubic only
  };

  /// Throws std::invalid_argument for a block with missing values or grids that do not increase.
  BlockInterpolant(const C81Block& block, TableInterpolation interpolation);
  /// alpha [rad]; both are held at the ends of the grid.
  Sample at(double alpha, double mach) const;

 private:
  Sample inColumn(std::size_t cell, double alpha, std::size_t column) const;

  const C81Block& block_;
  TableInterpolation interpolation_;
  std::vector<double> alpha_;   // [rad]
  std::vector<double> slopes_;  // (alpha x mach) [1/rad]
};

/// The angle of a deck in radians; one place, so that equal angles of two blocks stay equal.
double deckRadians(double alpha_deg);

}  // namespace heerk_rotor
