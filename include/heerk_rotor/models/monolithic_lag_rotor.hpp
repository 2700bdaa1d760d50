#pragma once
#include <array>

#include <Eigen/Dense>

#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/models/lag_rotor_parameters.hpp"

namespace heerk_rotor {

/// Lag rotor and elastic mast as one ordinary differential equation, M(u) u'' + K(u') u = F(u, u'), u = (x, y, phi_1..4,
/// twist): the monolithic form of the HEERK paper, A.2. It shares no equation code with LagRotor and ElasticMast and is
/// their independent check; with a linear part S_mon it is also the paper's EERK4 study (Table 4).
///
/// S_mon = [[0, I], [C, 0]], C zero but for the twist column: `paper` omega_s^2 (0, 0, 705, 705, 705, 705, -680),
/// `exact` the column of -M^-1 K at the reference lag angles, `zero` none.
/// No dampers, equal blades, no airloads, no second-order hub terms; states as in the paper, then their rates.
class MonolithicLagRotor : public SubsystemModel {
 public:
  enum class LinearPart { kZero, kPaper, kExact };
  struct Parameters {
    LagRotorParameters rotor;
    double mast_stiffness = 3e6;                            // K_s [N m/rad]
    double rotor_speed = 6.63;                              // Omega [rad/s]
    LinearPart linear_part = LinearPart::kExact;
    std::array<double, kLagBlades> reference_lag{{0.01, 0.0, 0.0, 0.0}};  // where the exact column is taken [rad]
  };
  explicit MonolithicLagRotor(const Parameters& parameters);

  std::vector<State> states() const override;
  std::vector<InputPort> inputs() const override { return {}; }
  std::vector<OutputPort> outputs() const override;
  StiffPart stiffPart() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;

 private:
  using Matrix7 = Eigen::Matrix<double, 7, 7>;
  using Vector7 = Eigen::Matrix<double, 7, 1>;
  Matrix7 massMatrix(double azimuth, const double* lag) const noexcept;

  Parameters p_;
  double r_m_, r_b_, r_a2_, r_sb_, omega_s2_;
};

}  // namespace heerk_rotor
