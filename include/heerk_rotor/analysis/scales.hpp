#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"

namespace heerk_rotor {

/// Typical magnitudes, by which residuals are judged and differences are sized. A quantity that is nearly zero in this
/// motion borrows from its kin, the entries of the same subsystem with the same unit: cyclic pitch from collective, a high
/// mode from the largest mode, a rate from 2 pi / T times what it is the rate of. No scale is below 1e-4 of the unit (0.1 mm).

/// From the largest |x_i| over a revolution T [s]: max(|x_i|, share of the largest kin). With the default share a scale is small enough
/// for differences even of the highest mode; with share 1 it says how far the states of that kind move at all.
Vector stateScales(const CoupledSystem& system, const Vector& magnitudes, double revolution, double share_of_kin = 1e-3);

/// From the largest |x_i| and |y_i| over a revolution, for signals with given target values:
/// max(|target|, |signal|, 1e-3 of the largest kin, and for outputs the port's nominal).
Vector targetScales(const CoupledSystem& system, const std::vector<Signal>& signals, const std::vector<double>& targets,
                    const Vector& state_magnitudes, const Vector& output_magnitudes);

/// A tenth of the travel where the command has one, otherwise max(|w|, 1).
Vector controlScales(const CoupledSystem& system, const Vector& w, const std::vector<Index>& controls);

}  // namespace heerk_rotor
