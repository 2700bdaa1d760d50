#pragma once
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "models/rotor_runs.hpp"

/// Growth rates and Floquet multipliers taken from simulations.
namespace heerk_rotor::test {

/// Growth rate [1/s] of a signal vector that one pair of complex eigenvalues dominates, z = Re(c e^{(sigma + i w) t}): the
/// parallelogram of two successive samples has the area |Im(c)|..|sin(w dt)| e^{sigma (2 t + dt)}, free of the oscillation,
/// so half the slope of its logarithm is sigma, by least squares. `from`: samples before are left out (other modes).
inline double growthRate(const std::vector<double>& t, const std::vector<Vector>& z, double from) {
  double n = 0, st = 0, sl = 0, stt = 0, stl = 0;
  for (std::size_t k = 0; k + 1 < z.size(); ++k) {
    if (t[k] < from) continue;
    const double dot = z[k].dot(z[k + 1]);
    const double area = z[k].squaredNorm() * z[k + 1].squaredNorm() - dot * dot;
    const double log_area = 0.25 * std::log(area);  // area is squared here
    n += 1;
    st += t[k];
    sl += log_area;
    stt += t[k] * t[k];
    stl += t[k] * log_area;
  }
  return (n * stl - st * sl) / (n * stt - st * st);
}

/// The matrix of one-revolution differences: column j is d x(T) / d x_j(0) about `orbit`, by central differences of the
/// simulation itself; exact for linear systems. The simulation is left at the end of a revolution.
inline Matrix revolutionMap(Simulation& simulation, long steps, const Vector& orbit, const Vector& disturbance, const Vector& w) {
  Matrix map(orbit.size(), orbit.size());
  const auto end = [&](Index j, double sign) {
    simulation.reset();
    Vector x = orbit;
    x[j] += sign * disturbance[j];
    simulation.setState(x);
    EXPECT_TRUE(advance(simulation, steps, w));
    return simulation.state();
  };
  for (Index j = 0; j < orbit.size(); ++j) {
    const Vector up = end(j, 1.0);
    map.col(j) = (up - end(j, -1.0)) / (2.0 * disturbance[j]);
  }
  return map;
}

/// Eigenvalues by falling modulus.
inline std::vector<std::complex<double>> eigenvalues(const Matrix& matrix) {
  const Eigen::EigenSolver<Matrix> solver(matrix, false);
  std::vector<std::complex<double>> values(solver.eigenvalues().begin(), solver.eigenvalues().end());
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return std::abs(a) > std::abs(b); });
  return values;
}

/// Largest Floquet exponent of a linear periodic system about rest [1/s].
inline double floquetGrowth(Simulation& simulation, double rotor_speed) {
  const double revolution = 2.0 * M_PI / rotor_speed;
  const long steps = std::lround(revolution / simulation.stepSize());
  EXPECT_NEAR(static_cast<double>(steps) * simulation.stepSize(), revolution, 1e-9 * revolution);
  const Index n = simulation.system().stateSize();
  const Matrix map = revolutionMap(simulation, steps, Vector::Zero(n), Vector::Constant(n, 0.01), simulation.system().defaultCommand());
  return std::log(std::abs(eigenvalues(map).front())) / revolution;
}

}  // namespace heerk_rotor::test
