// The dual-disc rotor against numbers computed elsewhere from separately built matrices (millimetres, tonnes, seconds).
#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "dual_disc.hpp"
#include "heerk_rotor/shaft/diagonal_form.hpp"
#include "heerk_rotor/shaft/energy_coordinates.hpp"
#include "measured.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kRpm = 3.14159265358979323846 / 30.0;

/// Frobenius norm in the paper's units: energies and displacements in N mm and mm, x_m = 1e-3 x_mm, and 1 N mm = 1e-3 J.
double normInMillimetres(ShaftMatrix A) {
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    if (i % kShaftNodeDofs >= kShaftTiltX) continue;
    A.row(i) *= 1e-3L;
    A.col(i) *= 1e-3L;
  }
  return static_cast<double>(A.norm() * 1e3L);
}

void expectDigits(const std::string& name, double value, double printed, double half_a_digit) {
  report(name, value);
  EXPECT_NEAR(value, printed, 1.01 * half_a_digit) << name;
}

TEST(DualDisc, matricesHaveTheNormsInThePapersUnits) {
  const ShaftMatrices shaft = assembleShaft(dualDisc());
  expectDigits("|M|", normInMillimetres(shaft.M), 170.7422065384, 5e-11);
  expectDigits("|K|", normInMillimetres(shaft.K), 7.88185988139e9, 5e-3);
  expectDigits("|G|", normInMillimetres(shaft.G), 331.681190541, 5e-10);
  EXPECT_EQ((shaft.G + shaft.G.transpose()).norm(), 0);
  EXPECT_EQ((shaft.M - shaft.M.transpose()).norm(), 0);
}

TEST(DualDisc, naturalFrequenciesAtRestComeTwice) {
  ShaftProperties p = dualDisc();
  p.mass_damping = 0.0;
  const DiagonalForm modes = diagonalForm(energyCoordinates(assembleShaft(p), 0.0).H);
  const double printed[] = {400.984858, 986.117758, 1838.119612, 2385.876893};
  for (int k = 0; k < 4; ++k)
    for (int twice : {2 * k, 2 * k + 1})
      expectDigits("frequency " + std::to_string(twice + 1), static_cast<double>(modes.eigenvalues[static_cast<std::size_t>(twice)].imag()), printed[k], 5e-7);
}

TEST(DualDisc, largestEigenvalueAtNominalSpeed) {
  const DiagonalForm modes = diagonalForm(energyCoordinates(assembleShaft(dualDisc()), 5000.0 * kRpm).H);
  // Printed 9.94e5, cut off: at rest the pair is 9.9422e5, and turning splits it.
  expectDigits("max |eig H|", static_cast<double>(std::abs(modes.eigenvalues.back())), 9.945e5, 5e2);
  report("max |eig H| at rest", static_cast<double>(std::abs(diagonalForm(energyCoordinates(assembleShaft(dualDisc()), 0.0).H).eigenvalues.back())));
  report("condition of the eigenvectors", modes.condition);
  EXPECT_LE(modes.condition, 1.5);  // 1 for a skew matrix; damping of 20 1/s on frequencies of 400 rad/s and more
}

TEST(DualDisc, dampingIsHalfOfAlphaInEveryMode) {
  // C = alpha M shifts every eigenvalue's real part by -alpha / 2 exactly only at rest.
  const DiagonalForm modes = diagonalForm(energyCoordinates(assembleShaft(dualDisc()), 0.0).H);
  for (const auto& eigenvalue : modes.eigenvalues) EXPECT_NEAR(static_cast<double>(eigenvalue.real()), -10.0, 1e-11);
}

TEST(DualDisc, forwardCriticalSpeeds) {
  // Forward whirl at the speed itself: z = x + i y = v e^{i omega t} with K v = omega^2 (M - G_s) v, of the x plane alone.
  const ShaftMatrices shaft = assembleShaft(dualDisc());
  const Eigen::Index n = shaft.size() / 2;
  ShaftMatrix M(n, n), G(n, n), K(n, n);
  const auto x = [](Eigen::Index i) { return kShaftNodeDofs * (i / 2) + (i % 2 == 0 ? kShaftX : kShaftTiltY); };
  const auto y = [](Eigen::Index i) { return kShaftNodeDofs * (i / 2) + (i % 2 == 0 ? kShaftY : kShaftTiltX); };
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      M(i, j) = shaft.M(x(i), x(j));
      K(i, j) = shaft.K(x(i), x(j));
      G(i, j) = -shaft.G(x(i), y(j)) * (j % 2 == 0 ? 1 : -1);  // tilt of the y plane is -tilt_x
    }
  const Eigen::EigenSolver<ShaftMatrix> solver(ShaftMatrix(K.llt().solve(M - G)));
  std::vector<double> critical;
  for (Eigen::Index i = 0; i < n; ++i)
    if (solver.eigenvalues()[i].real() > 0) critical.push_back(1.0 / std::sqrt(static_cast<double>(solver.eigenvalues()[i].real())) / kRpm);
  std::sort(critical.begin(), critical.end());
  const double printed[] = {4231, 10793, 76576};
  for (std::size_t k = 0; k < 3; ++k) {
    expectDigits("critical speed " + std::to_string(k + 1) + " [rpm]", critical[k], printed[k], 0.5);
    // And the whirl frequency at that speed, of the undamped shaft, is the speed.
    ShaftProperties p = dualDisc();
    p.mass_damping = 0.0;
    const DiagonalForm modes = diagonalForm(energyCoordinates(assembleShaft(p), critical[k] * kRpm).H);
    double nearest = 1e9;
    for (const auto& eigenvalue : modes.eigenvalues) nearest = std::min(nearest, std::abs(static_cast<double>(eigenvalue.imag()) - critical[k] * kRpm));
    EXPECT_LE(nearest, 1e-9 * critical[k]);
  }
}

TEST(DualDisc, diagonalFormGivesTheMatrixBack) {
  const EnergyCoordinates energy = energyCoordinates(assembleShaft(dualDisc()), 40000.0 * kRpm);
  const DiagonalForm modes = diagonalForm(energy.H);
  const Eigen::Index n = energy.H.rows(), m = n / 2;
  ShaftMatrix B = ShaftMatrix::Zero(n, n);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto& block = modes.blocks[static_cast<std::size_t>(i)];
    B(i, i) = block(0, 0);
    B(i, m + i) = block(0, 1);
    B(m + i, i) = block(1, 0);
    B(m + i, m + i) = block(1, 1);
  }
  const double difference = static_cast<double>((modes.T * B * modes.inverse - energy.H).norm() / energy.H.norm());
  report("T B T^-1 - H over H", difference);
  EXPECT_LE(difference, 1e-15);  // B is rounded to double
}

}  // namespace
}  // namespace heerk_rotor
