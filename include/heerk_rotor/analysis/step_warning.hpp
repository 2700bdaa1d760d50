#pragma once
#include <cstdint>
#include <string>

#include "heerk_rotor/config/configuration.hpp"
#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// One sentence when the method is wrong for its step at the start (x, w) of a run: one step, linearised there, multiplies small deviations that
/// it does not resolve (|h s| > 0.5) by more than 1 + 1e-4. What it resolves and still grows is the rotor's own, with the coefficients of this azimuth. Shows the windows of HEERK3 where damping stays outside S, the limit of an explicit
/// predictor, and the stability limit of classical methods, each with modulus, mode and frequency. Empty when all is well, when a perturbed step fails (the run
/// will tell), or when the 2 n steps that it takes would cost more than a twentieth of the run.
std::string stepWarning(const Configuration& configuration, const Simulation& simulation, const Vector& command, double revolution, std::uint64_t run_steps);

}  // namespace heerk_rotor
