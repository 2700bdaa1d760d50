#pragma once
#include <vector>

#include "heerk_rotor/config/configuration.hpp"

namespace heerk_rotor {

/// Sizes for drawing a shaft [m]; z along it from its left end.
struct ShaftGeometry {
  std::vector<double> nodes;             // z of each node
  double diameter = 0.03;
  struct Disc {
    double z, radius, thickness;
  };
  std::vector<Disc> discs;
  std::vector<double> bearings;          // z of each bearing
  double journal = 0.0;                  // z of the journal in the film damper
  double clearance = 0.0;                // radial; 0: there is no film damper
  double housing_x = 0.0, housing_y = 0.0;  // centre of the damper's housing from the journal's static position

  double length() const { return nodes.empty() ? 0.0 : nodes.back(); }
  /// Displacements are drawn this many times as large: a round number with which the clearance becomes about a seventh of the
  /// shaft's length.
  double magnification() const;
};

/// Reads the sizes from the subsystems of the types shaft_rotor and squeeze_film_damper; without them a plain line without discs.
/// A disc's radius and thickness are those of a solid cylinder with its mass and moments of inertia.
ShaftGeometry readShaftGeometry(const Configuration& configuration);

}  // namespace heerk_rotor
