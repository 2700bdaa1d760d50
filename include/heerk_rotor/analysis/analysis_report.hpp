#pragma once
#include <string>

#include "heerk_rotor/analysis/stability.hpp"
#include "heerk_rotor/analysis/trim.hpp"

namespace heerk_rotor {

/// The result of a trim for people: targets with what is reached, controls with their range, periodicity, effort.
std::string text(const TrimResult& result, const TrimSettings& settings, const CoupledSystem& system);

/// The same as a JSON object (RFC 8259) on one line.
std::string json(const TrimResult& result, const TrimSettings& settings, const CoupledSystem& system);

/// Spectral radius (with a warning above 1) and the `shown` modes of largest modulus. `what` names the map; frequencies are
/// also given per revolution.
std::string text(const Stability& stability, const std::string& what, double revolution, std::size_t shown = 12);
std::string json(const Stability& stability, double revolution, std::size_t shown = 12);

}  // namespace heerk_rotor
