// Steps that carry z = C x instead of x: exponential methods and Newmark's must come to the same states with and without them.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "../solve/function_model.hpp"
#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {
namespace {

constexpr Index kStates = 11, kZ = 3, kR = 2;  // z + r of no convenient size

/// x' = S x + B r(t, C x, u): a stiff linear system with a nonlinear spring between few of its combinations. Counts how it is asked.
class Narrow : public SubsystemModel {
 public:
  struct Calls {
    int narrow = 0, complete = 0;
  };

  Narrow(bool has_form, std::shared_ptr<Calls> calls, double wide_from, double wide_to) : has_form_(has_form), calls_(std::move(calls)), wide_from_(wide_from), wide_to_(wide_to) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    form_.C = Matrix::NullaryExpr(kZ, kStates, [&] { return unit(random); });
    form_.B = Matrix::NullaryExpr(kStates, kR, [&] { return unit(random); });
    form_.B.col(0).head(4).setZero();
    const Matrix A = Matrix::NullaryExpr(kStates, kStates, [&] { return unit(random); });
    S_ = 40.0 * (A - A.transpose()) - 3.0 * A * A.transpose();
  }

  std::vector<State> states() const override {
    std::vector<State> list;
    for (Index i = 0; i < kStates; ++i) list.push_back({"x" + std::to_string(i), "-", "", 0.3 * std::cos(2.0 * static_cast<double>(i))});
    return list;
  }
  std::vector<InputPort> inputs() const override { return {{"load", 1, "-", ""}}; }
  std::vector<OutputPort> outputs() const override { return {{"motion", kZ, "-", ""}, {"everything", 1, "-", ""}}; }
  StiffPart stiffPart() const override { return DenseStiff{S_}; }
  void evalOutput(Index port, double, const In& x, const In&, Out y) noexcept override {
    if (port == 0) y.noalias() = form_.C * x;
    else y[0] = x.squaredNorm();
  }
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override {
    evalRemainder(t, x, u, xdot);
    xdot.noalias() += S_ * x;
  }
  bool providesRemainder() const override { return true; }
  void evalRemainder(double t, const In& x, const In& u, Out remainder) noexcept override {
    ++calls_->complete;
    const Eigen::Matrix<double, kZ, 1> z = form_.C * x;
    remainder.noalias() = form_.B * force(t, z.data(), u[0]);
  }
  const NarrowForm* narrowForm() const override { return has_form_ ? &form_ : nullptr; }
  bool narrowOutput(Index port) const override { return port == 0; }
  void evalNarrowOutput(Index, double, const In& z, const In&, Out y) noexcept override { y = z; }
  bool evalNarrowRemainder(double t, const In& z, const In& u, Out r) noexcept override {
    if (t >= wide_from_ && t < wide_to_) return false;
    ++calls_->narrow;
    r = force(t, z.data(), u[0]);
    return true;
  }

 private:
  static Eigen::Vector2d force(double t, const double* z, double load) { return {load - z[0] * z[0] * z[1] + 0.4 * std::sin(3.0 * t), std::cos(z[2]) - z[1]}; }

  bool has_form_;
  std::shared_ptr<Calls> calls_;
  double wide_from_, wide_to_;
  NarrowForm form_;
  Matrix S_;
};

struct Options {
  bool has_form = true;
  bool everything_is_needed = false;
  double wide_from = HUGE_VAL, wide_to = HUGE_VAL;
};

/// The narrow model beside one with S = 0, in a loop of feedthrough with a third one.
std::unique_ptr<Simulation> simulation(const std::string& method, const Options& o, std::shared_ptr<Narrow::Calls> calls, double h = 0.01) {
  CouplingGraph graph;
  graph.add("narrow", std::make_unique<Narrow>(o.has_form, calls, o.wide_from, o.wide_to));
  graph.add("slow", FunctionModel().state("q", 0.2).input("motion", kZ).input("energy")
      .output("q", 1, {}, [](double, const In& x, const In&, Out y) { y[0] = x[0]; })
      .derivatives([](double, const In& x, const In& u, Out xdot) { xdot[0] = u[0] - x[0] - 0.1 * u[3]; }).make());
  graph.add("loop", FunctionModel().input("motion", kZ).input("q").input("own")
      .output("load", 1, {"motion", "q", "own"}, [](double, const In&, const In& u, Out y) { y[0] = std::sin(u[0] + u[3]) - 0.3 * std::tanh(u[4]) * u[1]; }).make());
  graph.add("zero", FunctionModel().output("zero", 1, {}, [](double, const In&, const In&, Out y) { y[0] = 0.0; }).make());
  graph.connect("narrow.motion", "slow.motion");
  graph.connect("narrow.motion", "loop.motion");
  graph.connect("slow.q", "loop.q");
  graph.connect("loop.load", "loop.own");
  graph.connect("loop.load", "narrow.load");
  graph.connect(o.everything_is_needed ? "narrow.everything" : "zero.zero", "slow.energy");
  StepOptions options;
  options.step = h;
  options.method = method;
  options.solver.tolerance = 1e-13;
  return std::make_unique<Simulation>(std::move(graph).build(), options);
}

Vector after(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k) EXPECT_EQ(simulation.step(Vector()), StepStatus::kOk);
  return simulation.state();
}

class NarrowStagesOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, NarrowStagesOf, testing::Values("HEERK2", "HEERK3", "HEERK4"));

TEST_P(NarrowStagesOf, takeTheSameSteps) {
  for (const double h : {0.002, 0.05}) {
    auto narrow = std::make_shared<Narrow::Calls>(), complete = std::make_shared<Narrow::Calls>();
    const Vector expected = after(*simulation(GetParam(), {false}, complete, h), 200), x = after(*simulation(GetParam(), {}, narrow, h), 200);
    EXPECT_LE((x - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
    EXPECT_EQ(narrow->complete, 0);
    EXPECT_EQ(narrow->narrow, complete->complete);
    EXPECT_EQ(complete->narrow, 0);
  }
}

TEST_P(NarrowStagesOf, giveWayWhereTheModelHasNoNarrowForm) {
  // Between 0.1005 s and 0.2005 s: the first step that meets it is halfway through its stages, and begins anew.
  auto mixed = std::make_shared<Narrow::Calls>(), complete = std::make_shared<Narrow::Calls>();
  const Vector expected = after(*simulation(GetParam(), {false}, complete), 40), x = after(*simulation(GetParam(), {true, false, 0.1005, 0.2005}, mixed), 40);
  EXPECT_LE((x - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff());
  const int stages = complete->complete / 40;
  EXPECT_EQ(mixed->complete, 11 * stages);
  EXPECT_GT(mixed->narrow, 29 * stages);
}

class NarrowStepsOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Methods, NarrowStepsOf, testing::Values("HEERK2", "HEERK3", "HEERK4", "Newmark"));

TEST_P(NarrowStepsOf, areNotUsedWhereAnotherModelNeedsMore) {
  auto narrow = std::make_shared<Narrow::Calls>(), complete = std::make_shared<Narrow::Calls>();
  const Vector expected = after(*simulation(GetParam(), {false, true}, complete), 50), x = after(*simulation(GetParam(), {true, true}, narrow), 50);
  EXPECT_EQ(x, expected);
  EXPECT_EQ(narrow->narrow, 0);
}

TEST_P(NarrowStepsOf, continueBitwiseEqualFromACheckpoint) {
  auto calls = std::make_shared<Narrow::Calls>();
  const Options options{true, false, 0.1005, 0.2005};
  auto whole = simulation(GetParam(), options, calls), part = simulation(GetParam(), options, calls);
  after(*whole, 10);
  const Simulation::Checkpoint half = whole->checkpoint();
  after(*whole, 30);
  part->restore(half);
  after(*part, 30);
  EXPECT_EQ(part->stateHash(), whole->stateHash());
}

// Newmark's equations are solved to a tolerance, so the two differ by that and not by round-off alone.
TEST(NarrowNewmark, comesToTheSameStates) {
  for (const double h : {0.002, 0.05}) {
    auto narrow = std::make_shared<Narrow::Calls>(), complete = std::make_shared<Narrow::Calls>();
    const Vector expected = after(*simulation("Newmark", {false}, complete, h), 200), x = after(*simulation("Newmark", {}, narrow, h), 200);
    EXPECT_LE((x - expected).cwiseAbs().maxCoeff(), 2e-11 * expected.cwiseAbs().maxCoeff());
    EXPECT_EQ(narrow->complete, 0);
    EXPECT_GT(narrow->narrow, 0);
    EXPECT_LE(narrow->narrow, complete->complete) << "h = " << h;
  }
}

TEST(NarrowNewmark, givesWayWhereTheModelHasNoNarrowForm) {
  auto mixed = std::make_shared<Narrow::Calls>(), complete = std::make_shared<Narrow::Calls>();
  const Vector expected = after(*simulation("Newmark", {false}, complete), 40), x = after(*simulation("Newmark", {true, false, 0.1005, 0.2005}, mixed), 40);
  EXPECT_LE((x - expected).cwiseAbs().maxCoeff(), 2e-11 * expected.cwiseAbs().maxCoeff());
  EXPECT_GT(mixed->complete, 11);
  EXPECT_GT(mixed->narrow, 2 * 29);
}

TEST(NarrowStages, otherMethodsDoNotAskForThem) {
  for (const char* method : {"HERK4", "precise_2"}) {
    auto narrow = std::make_shared<Narrow::Calls>(), complete = std::make_shared<Narrow::Calls>();
    EXPECT_EQ(after(*simulation(method, {}, narrow, 0.002), 20), after(*simulation(method, {false}, complete, 0.002), 20)) << method;
    EXPECT_EQ(narrow->narrow, 0) << method;
  }
}

}  // namespace
}  // namespace heerk_rotor
