#include "heerk_rotor/integrate/simulation.hpp"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "../solve/function_model.hpp"
#include "heerk_rotor/core/coupling_graph.hpp"

namespace heerk_rotor {
namespace {

/// A damped pendulum whose acceleration goes through an algebraic loop, driven by a command:
///   p: q'' = acc; a: acc = -sin q - 0.1 q' + command - 0.5 acc (loop), i.e. acc = (...)/1.5
CoupledSystem pendulum() {
  CouplingGraph graph;
  graph.add("p", FunctionModel().state("q", 0.7).state("v", 0.0).input("acc")
      .output("angle", 1, {}, [](double, const In& x, const In&, Out y) { y[0] = x[0]; })
      .output("rate", 1, {}, [](double, const In& x, const In&, Out y) { y[0] = x[1]; })
      .derivatives([](double, const In& x, const In& u, Out xdot) { xdot << x[1], u[0]; }).make());
  graph.add("a", FunctionModel().input("angle").input("rate").input("own").input("command", 1, "-", Unconnected::kCommand)
      .output("acc", 1, {"angle", "rate", "own", "command"}, [](double, const In&, const In& u, Out y) { y[0] = -std::sin(u[0]) - 0.1 * u[1] + u[3] - 0.5 * u[2]; }).make());
  graph.connect("p.angle", "a.angle");
  graph.connect("p.rate", "a.rate");
  graph.connect("a.acc", "a.own");
  graph.connect("a.acc", "p.acc");
  return std::move(graph).build();
}

StepOptions options(const std::string& method = "HEERK4", double h = 0.01) {
  StepOptions o;
  o.step = h;
  o.method = method;
  o.solver.tolerance = 1e-12;
  return o;
}

Vector command(double value) { return Vector::Constant(1, value); }

struct Recorder : Observer {
  void observe(const Sample& sample) noexcept override {
    steps.push_back(sample.step);
    times.push_back(sample.t);
    states.push_back(sample.x);
    outputs.push_back(sample.y);
    commands.push_back(sample.w.size() > 0 ? sample.w[0] : 0.0);
    epochs.push_back(sample.epoch);
  }
  std::vector<std::uint64_t> steps;
  std::vector<double> times, commands;
  std::vector<Vector> states, outputs;
  std::vector<std::uint32_t> epochs;
};

TEST(Simulation, observersSeeConsistentInstants) {
  Simulation simulation(pendulum(), options());
  Recorder recorder;
  simulation.addObserver(recorder);
  for (int k = 0; k < 20; ++k) ASSERT_EQ(simulation.step(command(0.01 * k)), StepStatus::kOk);
  simulation.observe(command(0.2));
  ASSERT_EQ(recorder.steps.size(), 21u);
  for (std::size_t k = 0; k < 21; ++k) {
    EXPECT_EQ(recorder.steps[k], k);
    EXPECT_EQ(recorder.times[k], static_cast<double>(k) * 0.01);  // never accumulated
    const Vector& x = recorder.states[k];
    // The outputs belong to this very state and command.
    EXPECT_NEAR(recorder.outputs[k][2], (-std::sin(x[0]) - 0.1 * x[1] + recorder.commands[k]) / 1.5, 1e-11) << k;
  }
}

TEST(Simulation, observingInBetweenChangesNothing) {
  Simulation plain(pendulum(), options()), observed(pendulum(), options());
  for (int k = 0; k < 200; ++k) {
    plain.step(command(0.1));
    observed.observe(command(0.1));
    observed.step(command(0.1));
  }
  EXPECT_EQ(plain.stateHash(), observed.stateHash());
}

TEST(Simulation, continuesBitwiseFromACheckpoint) {
  Simulation whole(pendulum(), options()), first(pendulum(), options()), second(pendulum(), options());
  for (int k = 0; k < 300; ++k) whole.step(command(std::sin(0.1 * k)));
  for (int k = 0; k < 150; ++k) first.step(command(std::sin(0.1 * k)));
  second.restore(first.checkpoint());
  EXPECT_EQ(second.stepCount(), 150u);
  for (int k = 150; k < 300; ++k) second.step(command(std::sin(0.1 * k)));
  EXPECT_EQ(whole.stateHash(), second.stateHash());
  EXPECT_EQ(whole.state(), second.state());
}

TEST(Simulation, resetRepeatsTheRunWhileStepAndTimeGoOn) {
  Simulation simulation(pendulum(), options());
  for (int k = 0; k < 100; ++k) simulation.step(command(0.3));
  const Vector end = simulation.state();
  const auto hash = simulation.stateHash();
  simulation.reset();
  EXPECT_EQ(simulation.epoch(), 1u);
  EXPECT_EQ(simulation.stepCount(), 100u);
  EXPECT_EQ(simulation.time(), 100 * 0.01);
  EXPECT_EQ(simulation.modelTime(), 0.0);
  for (int k = 0; k < 100; ++k) simulation.step(command(0.3));
  EXPECT_EQ(simulation.state(), end);
  EXPECT_EQ(simulation.stateHash(), hash);
  EXPECT_EQ(simulation.stepCount(), 200u);
}

TEST(Simulation, aLoadedCheckpointWithNewEpochKeepsCounting) {
  Simulation source(pendulum(), options()), target(pendulum(), options());
  for (int k = 0; k < 40; ++k) source.step(command(0.3));
  const auto checkpoint = source.checkpoint();
  for (int k = 0; k < 7; ++k) target.step(command(0.0));
  target.restore(checkpoint, true);
  EXPECT_EQ(target.stepCount(), 7u);
  EXPECT_EQ(target.epoch(), 1u);
  EXPECT_EQ(target.modelTime(), source.modelTime());
  for (int k = 0; k < 10; ++k) {
    source.step(command(0.3));
    target.step(command(0.3));
  }
  EXPECT_EQ(source.state(), target.state());
  EXPECT_EQ(target.stepCount(), 17u);
}

TEST(Simulation, refusesCheckpointsOfAnotherSystem) {
  Simulation simulation(pendulum(), options()), coarse(pendulum(), options("HEERK4", 0.02));
  auto checkpoint = coarse.checkpoint();
  EXPECT_THROW(simulation.restore(checkpoint), std::invalid_argument);  // other step
  checkpoint = simulation.checkpoint();
  checkpoint.x = Vector::Zero(3);
  EXPECT_THROW(simulation.restore(checkpoint), std::invalid_argument);
  checkpoint = simulation.checkpoint();
  checkpoint.x[0] = NAN;
  EXPECT_THROW(simulation.restore(checkpoint), std::invalid_argument);
}

TEST(Simulation, aDivergingRunStopsAtTheLastGoodInstantAndSaysWhere) {
  CouplingGraph graph;
  graph.add("s", FunctionModel().state("blowup", 1.0).derivatives([](double, const In& x, const In&, Out xdot) { xdot[0] = x[0] * x[0]; }).make());
  Simulation simulation(std::move(graph).build(), options("HERK4", 0.1));
  StepStatus status = StepStatus::kOk;
  int steps = 0;
  while (status == StepStatus::kOk && steps < 1000) {
    status = simulation.step(Vector());
    ++steps;
  }
  EXPECT_EQ(status, StepStatus::kNonFinite);
  EXPECT_TRUE(std::isfinite(simulation.state()[0]));
  const StepFailure failure = simulation.failure();
  EXPECT_EQ(failure.where, "s.blowup");
  EXPECT_EQ(failure.step, simulation.stepCount());
  EXPECT_NE(failure.cause.find("HERK4"), std::string::npos);
  EXPECT_EQ(simulation.step(Vector()), StepStatus::kNonFinite);  // stays failed
  simulation.reset();
  EXPECT_EQ(simulation.step(Vector()), StepStatus::kOk);
}

TEST(Simulation, everyMethodIntegratesThePendulumAtItsOrder) {
  // Reference: the same system at a step 40 times smaller with a method of order 4.
  Simulation reference(pendulum(), options("HERK4", 0.0005));
  for (int k = 0; k < 4000; ++k) reference.step(command(0.2));
  for (const std::string& method : stepMethodNames()) {
    double error[2];
    for (int i = 0; i < 2; ++i) {
      const double h = i == 0 ? 0.04 : 0.02;
      Simulation simulation(pendulum(), options(method, h));
      for (int k = 0; k < std::lround(2.0 / h); ++k) simulation.step(command(0.2));
      error[i] = (simulation.state() - reference.state()).norm();
    }
    EXPECT_NEAR(std::log2(error[0] / error[1]), orderOfStepMethod(method), 0.15) << method;  // at these steps the next term is below 10 %
  }
}

TEST(Simulation, paperToleranceFollowsTheStep) {
  StepOptions o = options("HEERK4", 0.001);
  o.paper_tolerance = true;
  o.revolution = 1.0;  // h_ref = 0.01
  Simulation simulation(pendulum(), o);
  EXPECT_NEAR(simulation.options().solver.tolerance, 1e-3 * std::pow(0.1, 4), 1e-20);
}

/// Looks at every n-th step only, and keeps what each instant says the solver spent.
struct SpentRecorder : Observer {
  explicit SpentRecorder(std::uint64_t every) : every(every) {}
  bool wants(std::uint64_t step) const noexcept override { return step % every == 0; }
  void observe(const Sample& sample) noexcept override { spent[sample.step] = {sample.newton_iterations, sample.residual_evaluations}; }
  std::uint64_t every;
  std::map<std::uint64_t, std::pair<std::uint64_t, std::uint64_t>> spent;
};

TEST(Simulation, whatTheSolverSpentIsCountedPerStepHoweverRarelyOneLooks) {
  Simulation simulation(pendulum(), options());
  SpentRecorder often(1), seldom(10);
  simulation.addObserver(often);
  simulation.addObserver(seldom);
  for (int k = 0; k < 50; ++k) simulation.step(command(0.2));
  for (const auto& [step, spent] : seldom.spent) EXPECT_EQ(spent, often.spent[step]) << step;
  std::uint64_t total = 0;
  for (const auto& [step, spent] : often.spent) total += spent.second;
  EXPECT_GT(total, 200u);  // five solutions a step, each looks at the residual at least once
  EXPECT_LE(total, simulation.solver().counters().residual_evaluations);
}

TEST(Simulation, anOutputThatIsNotFiniteStopsTheRunEvenWhenOnlyObserversReadIt) {
  CouplingGraph graph;
  graph.add("s", FunctionModel().state("x", 1.0).derivatives([](double, const In&, const In&, Out xdot) { xdot[0] = -10.0; })
      .output("root", 1, {}, [](double, const In& x, const In&, Out y) { y[0] = std::sqrt(x[0]); }).make());
  Simulation simulation(std::move(graph).build(), options("HERK4", 0.04));
  Recorder recorder;
  simulation.addObserver(recorder);
  StepStatus status = StepStatus::kOk;
  for (int k = 0; k < 10 && status == StepStatus::kOk; ++k) status = simulation.step(Vector());
  EXPECT_EQ(status, StepStatus::kNonFinite);
  EXPECT_EQ(simulation.failure().where, "s.root");
  EXPECT_EQ(simulation.stepCount(), 3u);  // x = -0.2 there
  for (const Vector& y : recorder.outputs) EXPECT_TRUE(std::isfinite(y[0]));
  simulation.removeObserver(recorder);
}

}  // namespace
}  // namespace heerk_rotor
