// The elastic rotor on an elastic mast: states that count from the drive (absolute_lag) say the same as states that count from the hub (printed), and bear
// larger steps.
#include <gtest/gtest.h>

#include "heerk_rotor/models/fe_rotor.hpp"
#include "models/fe_rotor_fixture.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kOmega = 44.4, kBelow = 245.0;  // of the shipped mast [rad/s]

std::unique_ptr<SubsystemModel> rotorOf(const std::string& yaml, double absolute_below) {
  FeRotorParameters p = rotorParameters(yaml, kOmega);
  p.absolute_below = absolute_below;
  return makeFeRotorModel(p);
}

/// Where a port begins in u.
Index inputBegin(const SubsystemModel& model, const std::string& name) {
  Index begin = 0;
  for (const InputPort& port : model.inputs()) {
    if (port.name == name) return begin;
    begin += port.size;
  }
  throw std::runtime_error("no input " + name);
}

/// The largest difference in parts of the largest value.
double difference(const Vector& a, const Vector& b) { return (a - b).cwiseAbs().maxCoeff() / std::max(1e-300, b.cwiseAbs().maxCoeff()); }

TEST(FeRotorFormulation, aChangeOfCoordinatesAndNothingElse) {
  for (const std::string more : {", modes: 12", ", blades: 5, e: 0.01, mass_factor: [1.0, 1.1, 0.95, 1.02, 1.3], modes: 12", ", blades: 3, lag_hinge: true, lag_damper: 900.0"}) {
    const auto relative = rotorOf(bo105Rotor(more), 0.0), absolute = rotorOf(bo105Rotor(more), kBelow);
    const Vector omega = std::get<ModalStiff>(relative->stiffPart()).omega;
    const Index n = omega.size();
    Index inputs = 0;
    for (const InputPort& port : relative->inputs()) inputs += port.size;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);

    // What a twist of 1 rad and 1 rad/s adds to the states, as the model itself says.
    Vector u = Vector::Zero(inputs), share = Vector::Zero(2 * n);
    const Index motion = inputBegin(*absolute, "hub_motion"), acceleration = inputBegin(*absolute, "hub_acceleration");
    u[motion + 2] = u[motion + 3] = 1.0;
    absolute->completeInitialState(in(u), view(share));
    EXPECT_GT(share.cwiseAbs().maxCoeff(), 1.0);
    EXPECT_EQ(share.head(n), share.tail(n));

    double of_outputs = 0.0, of_rates = 0.0, of_remainder = 0.0;
    for (int k = 0; k < 20; ++k) {
      for (Index i = 0; i < inputs; ++i) u[i] = unit(random);
      u[motion + 1] += 40.0;
      u[motion + 2] *= 0.01;
      Vector x(2 * n);
      for (Index i = 0; i < n; ++i) {  // fast modes move little
        const double ratio = 33.0 / std::max(33.0, omega[i]);
        x[i] = 0.1 * ratio * ratio * unit(random), x[n + i] = 3.0 * ratio * unit(random);
      }
      Vector p = x;
      p.head(n) += u[motion + 2] * share.head(n);
      p.tail(n) += u[motion + 3] * share.tail(n);

      const std::vector<OutputPort> ports = relative->outputs();
      for (std::size_t port = 0; port < ports.size(); ++port) {
        Vector a = Vector::Zero(ports[port].size), b = a;
        relative->evalOutput(static_cast<Index>(port), 0.0, in(x), in(u), view(b));
        absolute->evalOutput(static_cast<Index>(port), 0.0, in(p), in(u), view(a));
        of_outputs = std::max(of_outputs, difference(a, b));
      }
      Vector f = Vector::Zero(2 * n), g = f, remainder = f;
      relative->evalDerivatives(0.0, in(x), in(u), view(f));
      f.head(n) += u[motion + 3] * share.head(n);
      f.tail(n) += (u[acceleration] - u[acceleration + 1]) * share.tail(n);
      absolute->evalDerivatives(0.0, in(p), in(u), view(g));
      of_rates = std::max(of_rates, difference(g, f));
      absolute->evalRemainder(0.0, in(p), in(u), view(remainder));
      of_remainder = std::max(of_remainder, difference(remainder + stiffMatrix(absolute->stiffPart()) * p, g));
    }
    report("outputs" + more, of_outputs);
    report("rates" + more, of_rates);
    EXPECT_LE(of_outputs, 1e-11) << more;
    EXPECT_LE(of_rates, 1e-11) << more;
    EXPECT_LE(of_remainder, 1e-11) << more;
  }
}

/// twistFrequency() of the shipped configuration without this connection.
double twistFrequencyWithout(const std::string& connection) {
  std::ifstream file(std::string(HEERK_SOURCE_DIR) + "/config/bo105.yaml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!connection.empty()) {
    const std::size_t at = text.find("  - " + connection);
    if (at == std::string::npos) throw std::runtime_error("no connection " + connection);
    text.erase(at, text.find('\n', at) + 1 - at);
  }
  const Configuration configuration = Configuration::parse(text, std::string(HEERK_SOURCE_DIR) + "/config/bo105.yaml", {"simulation.start=none"});
  Problems problems;
  const SimulationSettings settings = readSimulationSettings(configuration, problems);
  return twistFrequency({configuration, settings, "rotor", problems});
}

TEST(FeRotorFormulation, theMastHoldsTheSlowModesStiffness) {
  // One lag mode per blade is slower than the mast by far: what holds the twist is its share squared times its stiffness, four times over.
  const auto model = rotorOf(bo105Rotor(", modes: 12"), 60.0);
  const auto stiff = std::get<ModalStiff>(model->stiffPart());
  Index inputs = 0;
  for (const InputPort& port : model->inputs()) inputs += port.size;
  Vector u = Vector::Zero(inputs), share = Vector::Zero(2 * stiff.omega.size());
  u[inputBegin(*model, "hub_motion") + 2] = 1.0;
  model->completeInitialState(in(u), view(share));
  double expected = 0.0;
  for (Index i = 0; i < stiff.omega.size(); ++i) expected += share[i] * share[i] * stiff.omega[i] * stiff.omega[i];
  EXPECT_GT(expected, 5e5);

  const double I = 50.0;
  const auto mastFrequency = [&](const std::string& formulation, const Overrides& more = {}) {
    const Configuration c = shipped("bo105.yaml", Overrides{"simulation.formulation=" + formulation, set("subsystems.mast.stiffness", 60.0 * 60.0 * I), "subsystems.rotor.modes=12"} + more);
    const auto simulation = buildSimulation(c);
    for (const CoupledSystem::Subsystem& s : simulation->system().subsystems())
      if (s.name == "mast") return std::get<ModalStiff>(s.stiff).omega[0];
    return 0.0;
  };
  EXPECT_NEAR(mastFrequency("printed"), 60.0, 1e-9);
  const double held = std::sqrt(60.0 * 60.0 + expected / I);
  EXPECT_NEAR(mastFrequency("absolute_lag"), held, 1e-6 * 60.0);
  EXPECT_NEAR(mastFrequency("absolute_lag", {"subsystems.rotor.initial={L1_1: 0.1}"}), held, 1e-6 * 60.0) << "initial values change nothing of it";
  // A rotor whose accelerations are not those of the mast's hub counts from its hub.
  EXPECT_EQ(twistFrequencyWithout("[mast.hub_acceleration, rotor.hub_acceleration]"), 0.0);
  EXPECT_NEAR(twistFrequencyWithout(""), 245.0, 0.1);
}

const std::vector<std::string> kSignals{"mast.twist", "rotor.lag_1", "rotor.flap_1", "fuselage.hub_moment_x"};

/// Signals after a turn and a half of the rotor that begins to turn its mast, steps_per_turn steps per revolution; empty: unstable.
Vector afterwards(const std::string& formulation, int steps_per_turn, double stiffness) {
  auto simulation = buildSimulation(shipped("bo105.yaml", {"simulation.formulation=" + formulation, set("simulation.azimuth_step_deg", 360.0 / steps_per_turn), "simulation.newton_tolerance=1e-12",
                                                           set("subsystems.mast.stiffness", stiffness), "subsystems.airloads.polar=linear"}));
  for (int k = 0; k < 3 * steps_per_turn / 2; ++k)
    if (simulation->step(simulation->system().defaultCommand()) != StepStatus::kOk) return {};
  return look(*simulation, kSignals);
}

TEST(FeRotorFormulation, bothHaveTheSameLimit) {
  const Vector printed = afterwards("printed", 2880, 3e6), absolute = afterwards("absolute_lag", 2880, 3e6);
  ASSERT_GT(printed.size(), 0);
  ASSERT_GT(absolute.size(), 0);
  for (Index i = 0; i < printed.size(); ++i) {
    report("two formulations at 1/8 degree, " + kSignals[static_cast<std::size_t>(i)], std::abs(absolute[i] / printed[i] - 1.0));
    EXPECT_NEAR(absolute[i] / printed[i], 1.0, 1e-7) << kSignals[static_cast<std::size_t>(i)];
  }
}

TEST(FeRotorFormulation, aStiffMastDoesNotNeedSmallSteps) {
  const Vector exact = afterwards("absolute_lag", 2880, 1e8);
  ASSERT_GT(exact.size(), 0);
  const auto error = [&](const std::string& formulation, int steps) {
    const Vector found = afterwards(formulation, steps, 1e8);
    return found.size() == 0 ? HUGE_VAL : std::abs(found[1] - exact[1]) / std::abs(exact[1]);  // lag; the twist itself swings faster than such steps show
  };
  for (const int steps : {12, 36}) {
    const double absolute = error("absolute_lag", steps), printed = error("printed", steps);
    report("lag, stiff mast, absolute_lag, steps per turn " + std::to_string(steps), absolute);
    report("lag, stiff mast, printed, steps per turn " + std::to_string(steps), printed);
    EXPECT_LE(absolute, 0.01) << steps;
    EXPECT_GE(printed, 4.0 * absolute) << steps;
  }
}

}  // namespace
}  // namespace heerk_rotor
