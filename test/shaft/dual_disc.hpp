#pragma once
#include "heerk_rotor/shaft/shaft_matrices.hpp"

namespace heerk_rotor::test {

/// The dual-disc rotor of config/dual_disc.yaml.
inline ShaftProperties dualDisc() {
  ShaftProperties p;
  p.segments = {0.026, 0.118, 0.069, 0.069, 0.069, 0.069, 0.118, 0.026};
  p.diameter = {0.033};
  p.mass_damping = 20.0;
  p.discs = {{2, 18.745, 0.0966, 0.1882, 2.6e-4, 0.0}, {6, 16.098, 0.0721, 0.1399, 2.23e-4, 0.0}};
  p.bearings = {{1, 1e9, 1e9, 0.0, 0.0}, {7, 5.7e6, 5.7e6, 0.0, 0.0}};
  return p;
}

/// A uniform shaft of n equal segments, 2 m long and 0.1 m thick, on stiff bearings at its ends that stop displacement but not tilt.
inline ShaftProperties uniformShaft(int n, double length = 2.0, double diameter = 0.1, double bearing = 1e15) {
  ShaftProperties p;
  p.segments.assign(static_cast<std::size_t>(n), length / n);
  p.diameter = {diameter};
  p.bearings = {{0, bearing, bearing, 0.0, 0.0}, {n, bearing, bearing, 0.0, 0.0}};
  return p;
}

}  // namespace heerk_rotor::test
