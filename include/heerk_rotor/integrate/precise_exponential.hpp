#pragma once
#include "heerk_rotor/core/types.hpp"

namespace heerk_rotor {

/// e^{H dt} by the precise computation of Zhong with a Pade approximation (Liu & Zhang, eq. 5-8): with tau = dt / 2^20,
///   T_0 = (I + D)^-1 (N - D),  T_i = 2 T_{i-1} + T_{i-1}^2,  e^{H dt} = I + T_20,
/// where I + N and I + D are numerator and denominator of the (4, 4) approximant. Carrying T = e^{H t} - I keeps the digits that I would
/// swallow. H is balanced by powers of two first (phi_functions.hpp): the paper's raw units hold entries of 1e12 and lose eight digits at
/// dt = 2e-6 s; balanced, the error is that of the doublings, some 1e-15 of the norm.
/// The integrators that need more than e^{H dt} use phiFunctions(); this one is here because the paper's method is. Throws std::invalid_argument unless H is
/// square and finite.
Matrix preciseExponential(const Matrix& H, double dt);

}  // namespace heerk_rotor
