#include "heerk_rotor/aero/unsteady_lift.hpp"

#include <cmath>

namespace heerk_rotor {

double IndicialLag::response(double s) const noexcept { return 1.0 - A[0] * std::exp(-b[0] * s) - A[1] * std::exp(-b[1] * s); }

std::complex<double> IndicialLag::frequencyResponse(double k) const noexcept {
  std::complex<double> result = 1.0 - A[0] - A[1];
  for (int i = 0; i < 2; ++i) result += A[i] * b[i] / std::complex<double>(b[i], k);
  return result;
}

}  // namespace heerk_rotor
