#include <cmath>
#include <complex>
#include <sstream>
#include <stdexcept>
#include <string>

#include <Eigen/LU>

#include "heerk_rotor/shaft/diagonal_form.hpp"
#include "heerk_rotor/shaft/energy_coordinates.hpp"
#include "shaft_form.hpp"

namespace heerk_rotor {
namespace {

using Complex = std::complex<ShaftReal>;
using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;
using ComplexVector = Eigen::Matrix<Complex, Eigen::Dynamic, 1>;

/// Y with eta = Re(Y e^{i omega t}) for the unbalance of constant speed.
ComplexVector steadyResponse(const EnergyCoordinates& energy, const ShaftMatrices& shaft, const DiagonalForm& modes, double omega) {
  constexpr ShaftReal kResonance = 1e-9L;  // relative distance that still leaves the response ten digits
  const ComplexVector load = (energy.from_force * shaft.unbalance.col(0)).cast<Complex>() - Complex(0, 1) * (energy.from_force * shaft.unbalance.col(1)).cast<Complex>();
  if (shaft.unbalance.isZero(0)) return ComplexVector::Zero(load.size());
  for (const Complex& eigenvalue : modes.eigenvalues) {
    if (std::abs(eigenvalue - Complex(0, omega)) > kResonance * omega) continue;
    std::ostringstream text;
    text << "an undamped whirl mode of " << std::abs(eigenvalue) << " rad/s stands at the nominal speed of " << omega << " rad/s, where the steady response to the unbalance is infinite; expected damping, or coordinates: physical";
    throw std::runtime_error(text.str());
  }
  ComplexMatrix A = -energy.H.cast<Complex>();
  A.diagonal().array() += Complex(0, omega);
  const ShaftReal square = static_cast<ShaftReal>(omega) * omega;
  return A.partialPivLu().solve(ComplexVector(square * load));
}

DiagonalForm diagonalised(const ShaftMatrix& H) {
  try {
    return diagonalForm(H);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string(error.what()) + "; expected other damping, or coordinates: physical");
  }
}

}  // namespace

ShaftForm modalShaftForm(const ShaftMatrices& shaft, double omega, bool unbalance_inside) {
  const EnergyCoordinates energy = energyCoordinates(shaft, omega);
  const DiagonalForm modes = diagonalised(energy.H);
  const Eigen::Index m = shaft.size(), n = 2 * m;                    // pairs, coordinates without the phasor
  const Eigen::Index phasor = unbalance_inside ? 1 : 0, pairs = m + phasor;  // pairs with it

  // eta = T z + Re(steady) cos - Im(steady) sin, columns in the order of the states.
  ShaftMatrix eta(n, 2 * pairs);
  eta.leftCols(m) = modes.T.leftCols(m);
  eta.middleCols(pairs, m) = modes.T.rightCols(m);
  ComplexVector steady = ComplexVector::Zero(n);
  ShaftForm form;
  if (unbalance_inside) {
    steady = steadyResponse(energy, shaft, modes, omega);
    form.phasor_cos = m;
    form.phasor_sin = n + 1;
    eta.col(form.phasor_cos) = steady.real();
    eta.col(form.phasor_sin) = -steady.imag();
  }
  form.observe = (energy.to_physical * eta).cast<double>();
  form.energy = eta.cast<double>();
  const Matrix force = (modes.inverse * energy.from_force).cast<double>();
  form.force.setZero(2 * pairs, m);
  form.force.topRows(m) = force.topRows(m);
  form.force.middleRows(pairs, m) = force.bottomRows(m);
  const Vector start = -(modes.inverse * steady.real()).cast<double>();
  form.start.setZero(2 * pairs);
  form.start.head(m) = start.head(m);
  form.start.segment(pairs, m) = start.tail(m);
  if (unbalance_inside) form.start[form.phasor_cos] = 1.0;

  PairStiff S;
  S.blocks.assign(modes.blocks.begin(), modes.blocks.end());
  if (unbalance_inside) S.blocks.push_back((Eigen::Matrix2d() << 0.0, -omega, omega, 0.0).finished());
  form.S = std::move(S);

  for (const char* part : {"re", "im"}) {
    for (Eigen::Index i = 1; i <= m; ++i)
      form.states.push_back({"mode_" + std::to_string(i) + "_" + part, "sqrt(J)", unbalance_inside ? "whirl mode at nominal speed, counted from the steady unbalance response" : "whirl mode at nominal speed"});
    if (!unbalance_inside) continue;
    const bool real = form.states.size() == static_cast<std::size_t>(m);
    form.states.push_back({real ? "nominal_cos" : "nominal_sin", "-", real ? "cos of Omega t" : "sin of Omega t"});
  }
  return form;
}

}  // namespace heerk_rotor
