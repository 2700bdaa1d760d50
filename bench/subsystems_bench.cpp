// How the cost of a step grows with the number of coupled subsystems: oscillators that hand a force on at once, in a chain (no loop: evaluated in
// order) and in a ring (one algebraic loop through all of them: Newton with a sparse LU in every stage).
#include <cmath>

#include "heerk_rotor/core/coupling_graph.hpp"
#include "step_benchmark.hpp"

namespace heerk_rotor {
namespace {

/// q'' = -omega^2 q - damping q' + push, the first two terms in S. Hands on force = q + 0.9 tanh(push), so that push reaches the next one at once.
/// The gain is below one: a ring of any size has one solution.
class Link final : public SubsystemModel {
 public:
  explicit Link(double displacement) : displacement_(displacement) {}
  std::vector<State> states() const override { return {{"q", "m", "displacement", displacement_}, {"v", "m/s", "velocity"}}; }
  std::vector<InputPort> inputs() const override {
    InputPort push;
    push.name = "push";
    push.unit = "N";
    push.unconnected = Unconnected::kDefault;
    return {push};
  }
  std::vector<OutputPort> outputs() const override { return {{"force", 1, "N", "on the next one", {"push"}}}; }
  StiffPart stiffPart() const override { return ModalStiff{Vector::Constant(1, kOmega), Vector::Constant(1, kDamping)}; }
  void evalOutput(Index, double, const In& x, const In& u, Out y) noexcept override { y[0] = x[0] + 0.9 * std::tanh(u[0]); }
  void evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept override {
    xdot[0] = x[1];
    xdot[1] = -kOmega * kOmega * x[0] - kDamping * x[1] + u[0];
  }

 private:
  static constexpr double kOmega = 30.0;   // [rad/s]
  static constexpr double kDamping = 0.6;  // [1/s], 1 % of critical
  double displacement_;                    // at the start [m]
};

void stepOf(benchmark::State& state, bool ring) {
  const int count = static_cast<int>(state.range(0));
  const auto name = [](int i) { return "link_" + std::to_string(i); };
  CouplingGraph graph;
  for (int i = 0; i < count; ++i) graph.add(name(i), std::make_unique<Link>(0.1 * (1 + i % 5)));
  for (int i = 0; i < (ring ? count : count - 1); ++i) graph.connect(name(i) + ".force", name((i + 1) % count) + ".push");
  StepOptions options;
  options.step = 1e-3;
  Simulation simulation(std::move(graph).build(), options);
  stepOn(state, simulation);
}

void chain(benchmark::State& state) { stepOf(state, false); }
void ring(benchmark::State& state) { stepOf(state, true); }

BENCHMARK(chain)->RangeMultiplier(2)->Range(2, 64);
BENCHMARK(ring)->RangeMultiplier(2)->Range(2, 64);

}  // namespace
}  // namespace heerk_rotor
