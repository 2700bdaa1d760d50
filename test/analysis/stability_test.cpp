#include "heerk_rotor/analysis/stability.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/integrate/tableau.hpp"

namespace heerk_rotor {
namespace {

/// q'' = -omega^2 q - damping q', entirely in S: the exponential method steps it exactly.
class Oscillator : public SubsystemModel {
 public:
  Oscillator(double omega, double damping) : omega_(omega), damping_(damping) {}
  std::vector<State> states() const override { return {{"q", "m", "deflection"}, {"rate", "m/s", "its rate"}}; }
  std::vector<InputPort> inputs() const override { return {}; }
  std::vector<OutputPort> outputs() const override { return {}; }
  StiffPart stiffPart() const override { return ModalStiff{Vector::Constant(1, omega_), Vector::Constant(1, damping_)}; }
  void evalOutput(Index, double, const In&, const In&, Out) noexcept override {}
  void evalDerivatives(double, const In& x, const In&, Out xdot) noexcept override {
    xdot[0] = x[1];
    xdot[1] = -omega_ * omega_ * x[0] - damping_ * x[1];
  }

 private:
  double omega_, damping_;
};

constexpr double kStep = 1e-3;

std::unique_ptr<Simulation> oscillators(const std::string& method) {
  CouplingGraph graph;
  graph.add("slow", std::make_unique<Oscillator>(20.0, 0.0));
  graph.add("damped", std::make_unique<Oscillator>(300.0, 2.0 * 0.05 * 300.0));
  StepOptions options;
  options.step = kStep;
  options.method = method;
  return std::make_unique<Simulation>(std::move(graph).build(), options);
}

Stability stabilityWith(const std::string& method) {
  return stepStability([&] { return oscillators(method); }, Vector::Zero(4), Vector(), Vector::Ones(4));
}

TEST(StepStability, modesOfAnExponentialMethodAreThoseOfTheSystem) {
  const Stability stability = stabilityWith("HEERK4");
  // Differences of a linear map are exact to round-off over their width: 1e-16 / 1e-4.
  EXPECT_NEAR(stability.spectral_radius, 1.0, 1e-12);
  EXPECT_FALSE(stability.unstable());
  ASSERT_EQ(stability.modes.size(), 2u);
  EXPECT_NEAR(stability.modes[0].frequency, 20.0 / (2.0 * M_PI), 1e-8);
  EXPECT_NEAR(stability.modes[0].damping_ratio, 0.0, 1e-9);
  EXPECT_EQ(stability.modes[0].state.substr(0, 5), "slow.");
  EXPECT_NEAR(stability.modes[1].frequency, 300.0 * std::sqrt(1.0 - 0.05 * 0.05) / (2.0 * M_PI), 1e-7);
  EXPECT_NEAR(stability.modes[1].damping_ratio, 0.05, 1e-9);
  EXPECT_NEAR(std::abs(stability.modes[1].mu), std::exp(-0.05 * 300.0 * kStep), 1e-11);
  EXPECT_EQ(stability.modes[1].state.substr(0, 7), "damped.");
}

TEST(StepStability, showsWhatTheMethodMakesOfTheSystem) {
  // HERK4 is the classical Runge-Kutta method: |R(i z)|^2 = 1 - z^6/72 + z^8/576, z = omega h.
  const double z = 20.0 * kStep;
  const Stability stability = stabilityWith("HERK4");
  EXPECT_NEAR(stability.spectral_radius, std::sqrt(1.0 - std::pow(z, 6) / 72.0 + std::pow(z, 8) / 576.0), 1e-12);
}

TEST(Multipliers, sayHowFastAMotionGrows) {
  Matrix map(1, 1);
  map << 1.5;
  const std::vector<Multiplier> modes = multipliers(map, 0.5, {"a.x"});
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_EQ(modes[0].damping_ratio, -1.0);
  EXPECT_EQ(modes[0].frequency, 0.0);
  EXPECT_TRUE(floquetStability(map, 0.5, {"a.x"}).unstable());
}

}  // namespace
}  // namespace heerk_rotor
