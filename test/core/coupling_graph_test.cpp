#include "heerk_rotor/core/coupling_graph.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "../solve/function_model.hpp"

namespace heerk_rotor {
namespace {

FunctionModel source(const std::string& unit = "N") {
  return FunctionModel().output("load", 3, {}, [](double, const In&, const In&, Out y) { y << 1.0, 2.0, 3.0; }, unit)
      .output("torque", 1, {}, [](double, const In&, const In&, Out y) { y[0] = 5.0; }, "N m");
}
FunctionModel sink() {
  return FunctionModel().state("x", 0.0).input("load", 3, "N").input("moment", 1, "N m", Unconnected::kDefault)
      .derivatives([](double, const In&, const In& u, Out xdot) { xdot[0] = u[0]; });
}

/// The message of the CouplingError that `action` throws.
template <class Action>
std::string message(Action action) {
  try {
    action();
  } catch (const CouplingError& error) {
    return error.what();
  }
  return "nothing thrown";
}

struct Graph : ::testing::Test {
  Graph() {
    graph.add("aero", source().make());
    graph.add("hub", sink().make());
  }
  CouplingGraph graph;
};

TEST_F(Graph, sizeMismatchNamesBothPortsAndAFittingOne) {
  EXPECT_EQ(message([&] { graph.connect("aero.load", "hub.moment"); }),
            "connect aero.load (3, N) -> hub.moment (1, N m): sizes differ; aero.torque would fit");
}

TEST_F(Graph, unitMismatchNamesBothUnits) {
  graph.add("odd", source("lbf").make());
  EXPECT_EQ(message([&] { graph.connect("odd.load", "hub.load"); }), "connect odd.load (3, lbf) -> hub.load (3, N): units differ");
}

TEST_F(Graph, unknownNamesComeWithTheNearestOne) {
  EXPECT_NE(message([&] { graph.connect("aeroo.load", "hub.load"); }).find("did you mean 'aero'"), std::string::npos);
  EXPECT_NE(message([&] { graph.connect("aero.loads", "hub.load"); }).find("did you mean 'load'"), std::string::npos);
  EXPECT_NE(message([&] { graph.connect("aero", "hub.load"); }).find("expected subsystem.output"), std::string::npos);
}

TEST_F(Graph, reversedConnectionsAreRecognised) {
  EXPECT_NE(message([&] { graph.connect("hub.load", "hub.load"); }).find("is an input, expected an output"), std::string::npos);
  EXPECT_NE(message([&] { graph.connect("aero.load", "aero.load"); }).find("is an output, expected an input"), std::string::npos);
}

TEST_F(Graph, connectingTwiceIsAnError) {
  graph.connect("aero.load", "hub.load");
  EXPECT_NE(message([&] { graph.connect("aero.load", "hub.load"); }).find("connected already"), std::string::npos);
}

TEST_F(Graph, unconnectedInputsAreListed) {
  EXPECT_EQ(graph.unconnectedInputs(), std::vector<std::string>{"hub.load"});
  EXPECT_NE(message([&] { std::move(graph).build(); }).find("hub.load"), std::string::npos);
}

TEST_F(Graph, inputsAreSumsOfTheirSources) {
  graph.add("more", source().make());
  graph.connect("aero.load", "hub.load");
  graph.connect("more.load", "hub.load");
  CoupledSystem system = std::move(graph).build();
  Vector x = system.initialState(), u = Vector::Zero(system.inputSize()), y = Vector::Zero(system.outputSize());
  for (Index o = 0; o < 4; ++o) system.evalOutput(o, 0.0, x, u, y.data() + system.outputs()[o].begin);
  EXPECT_TRUE(system.gather(0, y, Vector(), u));
  EXPECT_EQ(u.head(3), Vector(Eigen::Vector3d(2.0, 4.0, 6.0)));
  EXPECT_FALSE(system.gather(0, y, Vector(), u));  // nothing changed
}

TEST_F(Graph, namesMustBeNewIdentifiers) {
  EXPECT_NE(message([&] { graph.add("hub", sink().make()); }).find("exists already"), std::string::npos);
  EXPECT_NE(message([&] { graph.add("2nd", sink().make()); }).find("expected a letter"), std::string::npos);
  EXPECT_NE(message([&] { graph.add("b", sink().make(), {{"y", 1.0}}); }).find("no initial value is called y"), std::string::npos);
}

TEST_F(Graph, modelsThatContradictThemselvesAreRefused) {
  EXPECT_NE(message([&] { graph.add("m", FunctionModel().output("y", 1, {"nothing"}, {}).make()); }).find("unknown input nothing"), std::string::npos);
  EXPECT_NE(message([&] { graph.add("m", FunctionModel().input("u").input("u").make()); }).find("declared twice"), std::string::npos);
  EXPECT_NE(message([&] { graph.add("m", FunctionModel().state("x", 0.0).stiff(DenseStiff{Matrix::Zero(2, 2)}).make()); }).find("expected 1"), std::string::npos);
}

TEST(CoupledSystem, unconnectedCommandsBecomeW) {
  CouplingGraph graph;
  graph.add("plate", FunctionModel().state("x", 0.0).input("command", 2, "rad", Unconnected::kCommand)
      .derivatives([](double, const In&, const In& u, Out xdot) { xdot[0] = u[1]; }).make());
  const CoupledSystem system = std::move(graph).build();
  EXPECT_EQ(system.commandNames(), (std::vector<std::string>{"plate.command_1", "plate.command_2"}));
  EXPECT_EQ(system.commandLow()[0], -HUGE_VAL);  // no range stated
  Vector u = Vector::Zero(2);
  system.gather(0, Vector(), Vector(Eigen::Vector2d(3.0, 4.0)), u);
  EXPECT_EQ(u[1], 4.0);
}

TEST(CoupledSystem, signalsAreFoundAndMisspeltOnesHinted) {
  CouplingGraph graph;
  graph.add("hub", sink().make());
  graph.add("aero", source().make());
  graph.connect("aero.load", "hub.load");
  const CoupledSystem system = std::move(graph).build();
  EXPECT_EQ(system.signal("aero.load_2").index, 1);
  EXPECT_EQ(system.signal("hub.x").kind, Signal::Kind::kState);
  EXPECT_EQ(system.findSignal("aero.nothing"), nullptr);
  try {
    system.signal("aero.laod_2");
    FAIL();
  } catch (const std::out_of_range& error) {
    EXPECT_NE(std::string(error.what()).find("aero.load_2"), std::string::npos) << error.what();
  }
}

TEST(CoupledSystem, evaluatesAModelThatTookThePlaceOfAnother) {
  CouplingGraph graph;
  graph.add("aero", source().make());
  graph.add("hub", sink().make());
  graph.connect("aero.load", "hub.load");
  CoupledSystem system = std::move(graph).build();
  const auto twice = [](double, const In&, const In& u, Out xdot) { xdot[0] = 2.0 * u[0]; };
  const auto old = system.exchangeModel(1, FunctionModel().state("x", 0.0).input("load", 3, "N").input("moment", 1, "N m", Unconnected::kDefault).derivatives(twice).make());
  Vector u = Vector::Zero(system.inputSize()), xdot = Vector::Zero(1);
  u[0] = 3.0;
  system.evalRemainder(0.0, system.initialState(), u, true, xdot.data());
  EXPECT_EQ(xdot[0], 6.0);
  old->evalDerivatives(0.0, In(u.data(), 0), In(u.data(), 4), view(xdot));
  EXPECT_EQ(xdot[0], 3.0);
}

}  // namespace
}  // namespace heerk_rotor
