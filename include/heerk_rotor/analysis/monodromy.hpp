#pragma once
#include <complex>
#include <memory>
#include <string>
#include <vector>

#include "heerk_rotor/analysis/revolution_map.hpp"

namespace heerk_rotor {

/// Differences of the revolution map about (x, w), in units of the scales: entry (i, j) is the change of the i-th result
/// [x_i(T) / state scale, then mean / target scale] per change of the j-th argument [x_j(0) / state scale, then control / control scale].
struct MapGradient {
  Matrix scaled;                 // (n + targets) x (n + controls)
  long revolutions = 0;          // spent
  bool complete = false;         // false: a perturbed revolution failed
};

struct MapScales {
  Vector states, targets, controls;
  Vector motion = {};            // (n) or empty: coarser scale of the states, see stateScales()
};

/// A difference: one perturbed revolution per argument, or two when central. The revolution map's own result at (x, w) is the
/// reference of one-sided ones; a control at its upper limit is moved downward.
struct DifferenceOptions {
  double width = 1e-6;   // of the scale: truncation and the round-off 1e-12 of a revolution are then both about 1e-6 of an entry
  bool central = false;
};

/// Maps that share the work of a gradient, one per thread; all must be of the same configuration and base. The result does
/// not depend on their number.
using MapTeam = std::vector<std::unique_ptr<RevolutionMap>>;
MapGradient differenceMap(const MapTeam& maps, const Vector& x, const Vector& w, const std::vector<Index>& controls, const MapScales& scales,
                          const DifferenceOptions& options = {});

/// One eigenvalue mu of the map over a time dt, as motion e^{s t}, s = ln(mu) / dt. The frequency is the principal one: a
/// sampled motion does not tell w from w + 2 pi / dt.
struct Multiplier {
  std::complex<double> mu;
  double frequency = 0.0;       // |Im s| / 2 pi [Hz]
  double damping_ratio = 0.0;   // -Re s / |s|; negative: growing. 1 for a motion that vanishes within dt
  std::string state;            // of largest participation |v_k w_k|, right times left eigenvector
};

/// Eigenvalues of a (scaled) map by falling modulus, one of each conjugate pair.
std::vector<Multiplier> multipliers(const Matrix& map, double dt, const std::vector<std::string>& state_names);

}  // namespace heerk_rotor
