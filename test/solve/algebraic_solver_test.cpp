#include "heerk_rotor/solve/algebraic_solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "function_model.hpp"
#include "heerk_rotor/core/coupling_graph.hpp"

namespace heerk_rotor {
namespace {

const Vector kNone = Vector::Zero(0);

SolverOptions tight(bool prune = true) {
  SolverOptions options;
  options.tolerance = 1e-13;
  options.prune = prune;
  return options;
}

/// a.out = (2 x, cos(in), x + 0.1 in), b.out = 0.5 (second + third entry of a): only the last two entries of a and b are in the loop.
CoupledSystem partLoop() {
  CouplingGraph graph;
  graph.add("a", FunctionModel().state("x", 0.3).input("in").output("out", 3, {"in"},
      [](double, const In& x, const In& u, Out y) { y << 2.0 * x[0], std::cos(u[0]), x[0] + 0.1 * u[0]; })
      .derivatives([](double, const In&, const In&, Out xdot) { xdot[0] = 0.0; }).make());
  graph.add("b", FunctionModel().input("in", 3).output("out", 1, {"in"}, [](double, const In&, const In& u, Out y) { y[0] = 0.5 * (u[1] + u[2]); }).make());
  graph.connect("a.out", "b.in");
  graph.connect("b.out", "a.in");
  return std::move(graph).build();
}

TEST(AlgebraicSolver, iteratesOnlyEntriesOfTheLoop) {
  CoupledSystem system = partLoop();
  const Vector x = system.initialState();
  AlgebraicSolver solver(system, tight(), 0.0, x, kNone);
  ASSERT_EQ(solver.loops().size(), 1u);
  EXPECT_EQ(solver.loops()[0].entries, 4);
  EXPECT_EQ(solver.loops()[0].unknowns, (std::vector<Index>{1, 2, 3}));  // a.out_1 depends on the state alone

  double z = 0.5;  // fixed point of z = (cos z + 0.3 + 0.1 z) / 2, contracting
  for (int i = 0; i < 200; ++i) z = 0.5 * (std::cos(z) + 0.3 + 0.1 * z);
  EXPECT_NEAR(solver.y()[3], z, 1e-12);
  EXPECT_EQ(solver.y()[0], 0.6);
}

TEST(AlgebraicSolver, prunedAndUnprunedAgree) {
  CoupledSystem first = partLoop(), second = partLoop();
  Vector x = first.initialState();
  AlgebraicSolver pruned(first, tight(), 0.0, x, kNone), full(second, tight(false), 0.0, x, kNone);
  EXPECT_LT(pruned.loops()[0].unknowns.size(), full.loops()[0].unknowns.size());
  for (int k = 0; k < 50; ++k) {
    x[0] = std::sin(0.1 * k);
    ASSERT_EQ(pruned.solve(0.1 * k, x, kNone).status, SolveStatus::kConverged);
    ASSERT_EQ(full.solve(0.1 * k, x, kNone).status, SolveStatus::kConverged);
    EXPECT_LT((pruned.y() - full.y()).cwiseAbs().maxCoeff(), 1e-12) << k;  // both to 1e-13, gain of the loop below 10
  }
  EXPECT_EQ(pruned.counters().pruning_failures, 0u);
}

TEST(AlgebraicSolver, solvesWhereSweepsDiverge) {
  // y1 = 3 y2 + x, y2 = 2 y1 - 1: loop gain 6, so repeated substitution diverges; y1 = (3 - x) / 5.
  CouplingGraph graph;
  graph.add("a", FunctionModel().state("x", 1.0).input("in").output("out", 1, {"in"}, [](double, const In& x, const In& u, Out y) { y[0] = 3.0 * u[0] + x[0]; })
      .derivatives([](double, const In&, const In&, Out xdot) { xdot[0] = 0.0; }).make());
  graph.add("b", FunctionModel().input("in").output("out", 1, {"in"}, [](double, const In&, const In& u, Out y) { y[0] = 2.0 * u[0] - 1.0; }).make());
  graph.connect("a.out", "b.in");
  graph.connect("b.out", "a.in");
  CoupledSystem system = std::move(graph).build();
  AlgebraicSolver solver(system, tight(), 0.0, system.initialState(), kNone);
  EXPECT_NEAR(solver.y()[0], 0.4, 1e-12);
}

TEST(AlgebraicSolver, refusesLoopsThatAreNotIndexOne) {
  CouplingGraph graph;  // y1 = y2, y2 = y1 + sin x: no unique solution
  graph.add("a", FunctionModel().state("x", 1.0).input("in").output("out", 1, {"in"}, [](double, const In& x, const In& u, Out y) { y[0] = u[0] + std::sin(x[0]); })
      .derivatives([](double, const In&, const In&, Out xdot) { xdot[0] = 0.0; }).make());
  graph.add("b", FunctionModel().input("in").output("out", 1, {"in"}, [](double, const In&, const In& u, Out y) { y[0] = u[0]; }).make());
  graph.connect("a.out", "b.in");
  graph.connect("b.out", "a.in");
  CoupledSystem system = std::move(graph).build();
  const Vector x = system.initialState();
  try {
    AlgebraicSolver solver(system, tight(), 0.0, x, kNone);
    FAIL() << "accepted a singular loop";
  } catch (const CouplingError& error) {
    EXPECT_NE(std::string(error.what()).find("a.out"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("not index 1"), std::string::npos) << error.what();
  }
}

/// The gradient entry d a.out_1 / d in is exactly zero until x exceeds 10, far from where the plan is made.
CoupledSystem lateCoupling() {
  CouplingGraph graph;
  graph.add("a", FunctionModel().state("x", 0.0).input("in").output("out", 2, {"in"},
      [](double, const In& x, const In& u, Out y) { y << 1.0 + std::max(0.0, x[0] - 10.0) * u[0], 0.5 * u[0] + x[0]; })
      .derivatives([](double, const In&, const In&, Out xdot) { xdot[0] = 0.0; }).make());
  graph.add("b", FunctionModel().input("in", 2).output("out", 1, {"in"}, [](double, const In&, const In& u, Out y) { y[0] = 0.2 * u[0] + 0.3 * u[1]; }).make());
  graph.connect("a.out", "b.in");
  graph.connect("b.out", "a.in");
  return std::move(graph).build();
}

TEST(AlgebraicSolver, detectsAPrunedZeroThatBecameNonzeroAndStaysRight) {
  CoupledSystem system = lateCoupling();
  Vector x = system.initialState();
  AlgebraicSolver solver(system, tight(), 0.0, x, kNone);
  EXPECT_EQ(solver.loops()[0].unknowns.size(), 2u);
  EXPECT_EQ(solver.counters().pruning_failures, 0u);

  x[0] = 11.0;
  ASSERT_EQ(solver.solve(1.0, x, kNone).status, SolveStatus::kConverged);
  EXPECT_EQ(solver.counters().pruning_failures, 1u);
  // z = 0.2 (1 + z) + 0.3 (0.5 z + 11)
  const double z = (0.2 + 3.3) / (1.0 - 0.2 - 0.15);
  EXPECT_NEAR(solver.y()[2], z, 1e-12);
  EXPECT_NEAR(solver.y()[0], 1.0 + z, 1e-12);
}

TEST(AlgebraicSolver, keepsFactorizationWhileContracting) {
  CoupledSystem system = partLoop();
  Vector x = system.initialState();
  AlgebraicSolver solver(system, tight(), 0.0, x, kNone);
  const auto before = solver.counters().factorizations;
  for (int k = 1; k <= 200; ++k) {
    x[0] = 0.3 + 1e-3 * k;
    solver.solve(k, x, kNone);
  }
  EXPECT_EQ(solver.counters().factorizations, before);
  EXPECT_EQ(solver.counters().solves, 201u);
}

TEST(AlgebraicSolver, refreshesTheJacobianWhenContractionIsLost) {
  // y = x sin(3 y') through a pass-through: the slope turns over as x grows.
  CouplingGraph graph;
  graph.add("a", FunctionModel().state("x", 0.1).input("in").output("out", 1, {"in"}, [](double, const In& x, const In& u, Out y) { y[0] = 1.0 - x[0] * std::exp(u[0]); })
      .derivatives([](double, const In&, const In&, Out xdot) { xdot[0] = 0.0; }).make());
  graph.add("b", FunctionModel().input("in").output("out", 1, {"in"}, [](double, const In&, const In& u, Out y) { y[0] = u[0]; }).make());
  graph.connect("a.out", "b.in");
  graph.connect("b.out", "a.in");
  CoupledSystem system = std::move(graph).build();
  Vector x = system.initialState();
  AlgebraicSolver solver(system, tight(), 0.0, x, kNone);
  const auto before = solver.counters().factorizations;
  x[0] = 40.0;
  ASSERT_EQ(solver.solve(1.0, x, kNone).status, SolveStatus::kConverged);
  EXPECT_GT(solver.counters().factorizations, before);
  EXPECT_NEAR(solver.y()[0], 1.0 - 40.0 * std::exp(solver.y()[0]), 1e-11);
}

TEST(AlgebraicSolver, evaluatesEachPortOnceWhereALoopIsSolvedAlready) {
  CoupledSystem system = partLoop();
  const Vector x = system.initialState();
  AlgebraicSolver solver(system, tight(), 0.0, x, kNone);
  ASSERT_EQ(solver.solve(0.0, x, kNone).status, SolveStatus::kConverged);
  const auto before = solver.outputEvaluations();
  ASSERT_EQ(solver.solve(0.0, x, kNone).status, SolveStatus::kConverged);  // the same instant: the start value is the solution
  std::uint64_t evaluated = 0;
  for (std::size_t k = 0; k < before.size(); ++k) evaluated += solver.outputEvaluations()[k] - before[k];
  std::uint64_t ports = 0;
  for (const CoupledSystem::Output& output : system.outputs()) ports += output.size > 0;
  EXPECT_LE(evaluated, ports);  // the check after convergence and the ports behind the loop find all of them up to date
}

/// Keeps a state, and reads one more input for an output alone.
class Reader : public SubsystemModel {
 public:
  explicit Reader(bool only_for_outputs) : only_for_outputs_(only_for_outputs) {}
  std::vector<State> states() const override { return {{"x", "-", ""}}; }
  std::vector<InputPort> inputs() const override {
    InputPort port{"in", 1, "-", ""};
    port.only_for_outputs = only_for_outputs_;
    return {port};
  }
  std::vector<OutputPort> outputs() const override { return {{"out", 1, "-", "", {"in"}}}; }
  void evalOutput(Index, double, const In&, const In& u, Out y) noexcept override { y[0] = 2.0 * u[0]; }
  void evalDerivatives(double, const In& x, const In&, Out xdot) noexcept override { xdot[0] = -x[0]; }

 private:
  bool only_for_outputs_;
};

TEST(AlgebraicSolver, whatOnlyOutputsReadIsEvaluatedWhenTheyAre) {
  for (const bool only_for_outputs : {false, true}) {
    CouplingGraph graph;
    graph.add("source", FunctionModel().output("out", 1, {}, [](double t, const In&, const In&, Out y) { y[0] = t; }).make());
    graph.add("reader", std::make_unique<Reader>(only_for_outputs));
    graph.connect("source.out", "reader.in");
    CoupledSystem system = std::move(graph).build();
    const Vector x = system.initialState();
    AlgebraicSolver solver(system, tight(), 0.0, x, kNone);
    const auto before = solver.outputEvaluations();
    ASSERT_EQ(solver.solve(3.0, x, kNone).status, SolveStatus::kConverged);
    EXPECT_EQ(solver.outputEvaluations()[0] - before[0], only_for_outputs ? 0u : 1u);
    solver.evalObserved(3.0, x, kNone);
    EXPECT_EQ(solver.outputEvaluations()[0] - before[0], 1u);
    EXPECT_EQ(solver.y()[1], 6.0);
  }
}

/// y_i = q(t) + sum_j A_ij y_j with q_i = (1 + i) (1 + 0.4 t - 0.3 t^2), A small and without structure; gains of y_0 grow with x.
struct LinearLoop {
  explicit LinearLoop(Index n) : A(n, n) {
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) A(i, j) = 0.4 / static_cast<double>(n) * std::sin(3.0 * static_cast<double>(i) + 7.0 * static_cast<double>(j) + 1.0);
  }
  Matrix gains(double x) const {
    Matrix G = A;
    G.row(0) *= 1.0 + x;
    return G;
  }
  static double drive(double t) { return 1.0 + 0.4 * t - 0.3 * t * t; }
  Vector solution(double t, double x) const {
    const Index n = A.rows();
    return (Matrix::Identity(n, n) - gains(x)).partialPivLu().solve(Vector(Vector::LinSpaced(n, 1.0, static_cast<double>(n)) * drive(t)));
  }
  CoupledSystem system() const {
    const Index n = A.rows();
    CouplingGraph graph;
    graph.add("loop", FunctionModel().state("x", 0.0).input("in", n).output("out", n, {"in"},
        [*this](double t, const In& x, const In& u, Out y) {
          y = gains(x[0]) * u;
          for (Index i = 0; i < y.size(); ++i) y[i] += static_cast<double>(1 + i) * drive(t);
        })
        .derivatives([](double, const In&, const In&, Out xdot) { xdot[0] = 0.0; }).make());
    graph.connect("loop.out", "loop.in");
    return std::move(graph).build();
  }
  Matrix A;
};

TEST(AlgebraicSolver, solvesLoopsOfEverySize) {  // small ones with an explicit inverse, large ones by their factors
  for (const Index n : {1, 2, 3, 4, 5, 8, 9, 12, 17, 31, 32, 33, 40}) {
    const LinearLoop loop(n);
    CoupledSystem system = loop.system();
    Vector x = system.initialState();
    AlgebraicSolver solver(system, tight(), 0.0, x, kNone);
    ASSERT_EQ(static_cast<Index>(solver.loops()[0].unknowns.size()), n);
    for (const double t : {0.3, 0.35, 2.0}) {
      x[0] = t;
      ASSERT_EQ(solver.solve(t, x, kNone).status, SolveStatus::kConverged);
      EXPECT_LE((solver.y() - loop.solution(t, x[0])).cwiseAbs().maxCoeff(), 1e-11 * loop.solution(t, x[0]).cwiseAbs().maxCoeff()) << n << " unknowns at " << t;
    }
  }
}

TEST(AlgebraicSolver, beginsWhereTheLastInstantsPoint) {
  const LinearLoop loop(6);
  CoupledSystem system = loop.system();
  const Vector x = system.initialState();
  AlgebraicSolver solver(system, tight(), 0.0, x, kNone);
  const auto iterations = [&](double t) {
    const auto before = solver.counters().newton_iterations;
    EXPECT_EQ(solver.solve(t, x, kNone).status, SolveStatus::kConverged);
    EXPECT_LE((solver.y() - loop.solution(t, 0.0)).cwiseAbs().maxCoeff(), 1e-11 * loop.solution(t, 0.0).cwiseAbs().maxCoeff());
    return solver.counters().newton_iterations - before;
  };
  EXPECT_GE(iterations(0.1), 1u);
  EXPECT_GE(iterations(0.2), 1u);
  for (const double t : {0.3, 0.35, 0.5}) EXPECT_EQ(iterations(t), 0u) << "the parabola is the solution at " << t;
  EXPECT_EQ(iterations(0.35), 0u) << "an instant that was solved before";
  EXPECT_GE(iterations(-50.0), 1u) << "out of reach";
  EXPECT_GE(iterations(-49.9), 1u) << "nothing is left of what was before";
}

TEST(AlgebraicSolver, learnsHowTheJacobianHasChanged) {
  // All gains of one row have grown by half since the Jacobian was taken.
  const LinearLoop loop(6);
  CoupledSystem system = loop.system();
  Vector x = system.initialState();
  SolverOptions options;
  AlgebraicSolver solver(system, options, 0.0, x, kNone);
  const auto factorizations = solver.counters().factorizations;
  x[0] = 0.5;
  const auto iterations = [&](double t) {
    const auto before = solver.counters().newton_iterations;
    EXPECT_EQ(solver.solve(t, x, kNone).status, SolveStatus::kConverged);
    EXPECT_LE((solver.y() - loop.solution(t, 0.5)).cwiseAbs().maxCoeff(), 1e-8 * loop.solution(t, 0.5).cwiseAbs().maxCoeff());
    return solver.counters().newton_iterations - before;
  };
  // With the Jacobian alone each iteration leaves this part of the error: from a start that tells nothing, so many of them.
  const Matrix old = Matrix::Identity(6, 6) - loop.gains(0.0), now = Matrix::Identity(6, 6) - loop.gains(0.5);
  const double left = (Matrix::Identity(6, 6) - old.partialPivLu().solve(now)).eigenvalues().cwiseAbs().maxCoeff();
  const double needed = std::log(options.tolerance) / std::log(left);
  std::uint64_t taken = 0;
  double t = 1.0;
  for (int k = 0; k < 10; ++k, t *= -3.0) taken += iterations(t);  // ever further away, so that the start tells nothing
  EXPECT_LE(static_cast<double>(taken), 0.6 * 10.0 * needed) << "needed without learning: 10 times " << needed;
  EXPECT_EQ(solver.counters().factorizations, factorizations);
}

/// y = 0.3 cos(2 y) + sin(x + t), through a pass-through.
CoupledSystem cosineLoop() {
  CouplingGraph graph;
  graph.add("a", FunctionModel().state("x", 0.0).input("in").output("out", 1, {"in"}, [](double t, const In& x, const In& u, Out y) { y[0] = 0.3 * std::cos(2.0 * u[0]) + std::sin(x[0] + t); })
      .derivatives([](double, const In&, const In&, Out xdot) { xdot[0] = 0.0; }).make());
  graph.add("b", FunctionModel().input("in").output("out", 1, {"in"}, [](double, const In&, const In& u, Out y) { y[0] = u[0]; }).make());
  graph.connect("a.out", "b.in");
  graph.connect("b.out", "a.in");
  return std::move(graph).build();
}

double cosineSolution(double t, double x) {
  double y = std::sin(x + t);
  for (int k = 0; k < 200; ++k) y -= (y - 0.3 * std::cos(2.0 * y) - std::sin(x + t)) / (1.0 + 0.6 * std::sin(2.0 * y));
  return y;
}

TEST(AlgebraicSolver, withinStepsACorrectionIsTrustedThatEarlierOnesSayIsGoodEnough) {
  CoupledSystem system = cosineLoop();
  Vector x = system.initialState();
  SolverOptions options;
  AlgebraicSolver solver(system, options, 0.0, x, kNone);
  CoupledSystem same = cosineLoop();
  AlgebraicSolver always_checked(same, options, 0.0, x, kNone);
  constexpr double h = 1e-4;
  int in_a_row = 0, longest = 0, trusted = 0;
  double of_trusted = 0.0, of_others = 0.0, of_checked = 0.0, t = 0.0;
  for (int k = 1; k <= 4000; ++k) {
    t += k % 2 == 0 ? h : 0.5 * h;  // uneven, so that the prediction is not exact
    const SolverCounters before = solver.counters();
    ASSERT_EQ(solver.solveWithin(t, x, kNone).status, SolveStatus::kConverged);
    ASSERT_EQ(always_checked.solve(t, x, kNone).status, SolveStatus::kConverged);
    const bool corrected = solver.counters().newton_iterations > before.newton_iterations, checked = solver.counters().residual_evaluations - before.residual_evaluations > 1;
    const bool is_trusted = corrected && !checked;
    trusted += is_trusted;
    in_a_row = is_trusted ? in_a_row + 1 : 0;
    longest = std::max(longest, in_a_row);
    const double exact = cosineSolution(t, 0.0), scale = std::max(1.0, std::abs(exact));
    double& largest = is_trusted ? of_trusted : of_others;
    largest = std::max(largest, std::abs(solver.y()[0] - exact) / scale);
    of_checked = std::max(of_checked, std::abs(always_checked.y()[0] - exact) / scale);
    ASSERT_EQ(solver.u()[0], solver.y()[1]) << "inputs are those of the corrected solution";
  }
  EXPECT_GE(trusted, 1000);
  EXPECT_LE(longest, 7);
  EXPECT_LE(of_trusted, options.tolerance);
  EXPECT_LE(of_others, std::max(options.tolerance, 1.5 * of_checked));  // ended as always

  // A jump makes the first correction large, of which nothing is known: it is checked.
  x[0] = 1.0;
  ASSERT_EQ(solver.solveWithin(t, x, kNone).status, SolveStatus::kConverged);
  EXPECT_NEAR(solver.y()[0], cosineSolution(t, 1.0), options.tolerance);

  // What everybody sees is always checked, down to the residual.
  for (int k = 1; k <= 50; ++k) {
    t += h;
    ASSERT_EQ(solver.solve(t, x, kNone).status, SolveStatus::kConverged);
    EXPECT_NEAR(solver.y()[0], 0.3 * std::cos(2.0 * solver.y()[0]) + std::sin(1.0 + t), 2.0 * options.tolerance);
  }
}

/// y at x = 10.001, after a hundred solves within steps below 10, where what pruning assumes still holds.
Vector lateSolution(CoupledSystem system, std::uint64_t pruning_failures) {
  Vector x = system.initialState();
  AlgebraicSolver solver(system, SolverOptions(), 0.0, x, kNone);
  double t = 0.0;
  for (; t < 1.0; t += 0.01) {
    x[0] = 9.0 + std::sin(t);
    EXPECT_EQ(solver.solveWithin(t, x, kNone).status, SolveStatus::kConverged);
  }
  EXPECT_EQ(solver.counters().pruning_failures, 0u);
  x[0] = 10.001;
  EXPECT_EQ(solver.solveWithin(t, x, kNone).status, SolveStatus::kConverged);
  EXPECT_EQ(solver.counters().pruning_failures, pruning_failures);
  return solver.y();
}

TEST(AlgebraicSolver, withinStepsAPrunedZeroThatBecameNonzeroIsDetectedToo) {
  const double z = (0.2 + 0.3 * 10.001) / (1.0 - 0.2 * 0.001 - 0.15);
  EXPECT_NEAR(lateSolution(lateCoupling(), 1)[2], z, 10.0 * SolverOptions().tolerance);
}

TEST(AlgebraicSolver, withinStepsAPortThatBeginsToReadWhatFollowsFromTheLoopIsDetectedToo) {
  // a = 0.5 b_1 + x + max(0, x - 10) b_2, b = (0.4 a, 3 a): until x exceeds 10, b_2 follows from the loop and nothing in it reads b_2.
  CouplingGraph graph;
  graph.add("a", FunctionModel().state("x", 0.0).input("in", 2).output("out", 1, {"in"}, [](double, const In& x, const In& u, Out y) { y[0] = 0.5 * u[0] + x[0] + std::max(0.0, x[0] - 10.0) * u[1]; })
      .derivatives([](double, const In&, const In&, Out xdot) { xdot[0] = 0.0; }).make());
  graph.add("b", FunctionModel().input("in").output("out", 2, {"in"}, [](double, const In&, const In& u, Out y) { y << 0.4 * u[0], 3.0 * u[0]; }).make());
  graph.connect("a.out", "b.in");
  graph.connect("b.out", "a.in");
  EXPECT_NEAR(lateSolution(std::move(graph).build(), 1)[0], 10.001 / (1.0 - 0.2 - 0.003), 10.0 * SolverOptions().tolerance);
}

TEST(AlgebraicSolver, evaluatesPortsOfOneModelTogetherAndIntoTheirReader) {
  /// Counts calls; "reader" alone reads its ports.
  struct Wide : SubsystemModel {
    std::vector<State> states() const override { return {}; }
    std::vector<InputPort> inputs() const override { return {{"in", 1, "-", ""}}; }
    std::vector<OutputPort> outputs() const override { return {{"a", 20, "-", ""}, {"b", 20, "-", "", {"in"}}, {"c", 1, "-", ""}}; }
    void evalOutput(Index port, double t, const In&, const In& u, Out y) noexcept override { y.setConstant(port == 1 ? t + u[0] : t - static_cast<double>(port)); }
    void evalOutputs(const PortValue* values, Index count, double t, const In& x, const In& u) noexcept override {
      together = std::max(together, count);
      SubsystemModel::evalOutputs(values, count, t, x, u);
    }
    void evalDerivatives(double, const In&, const In&, Out) noexcept override {}
    Index together = 0;
  };
  CouplingGraph graph;
  auto wide = std::make_unique<Wide>();
  const Wide& asked = *wide;
  graph.add("source", FunctionModel().output("out", 1, {}, [](double t, const In&, const In&, Out y) { y[0] = 10.0 * t; }).make());
  graph.add("wide", std::move(wide));
  graph.add("reader", FunctionModel().state("x", 0.0).input("a", 20).input("b", 20).input("c").derivatives([](double, const In&, const In& u, Out xdot) { xdot[0] = u.sum(); }).make());
  graph.connect("source.out", "wide.in");
  for (const char* port : {"a", "b", "c"}) graph.connect(std::string("wide.") + port, std::string("reader.") + port);
  CoupledSystem system = std::move(graph).build();
  const Vector x = system.initialState();
  AlgebraicSolver solver(system, tight(), 0.0, x, kNone);
  for (const double t : {1.0, 2.0}) {
    ASSERT_EQ(solver.solve(t, x, kNone).status, SolveStatus::kConverged);
    EXPECT_EQ(solver.u().tail(41).sum(), 20.0 * t + 20.0 * 11.0 * t + t - 2.0);
    solver.evalObserved(t, x, kNone);
    EXPECT_TRUE((solver.y().segment(1, 20).array() == t).all()) << "an observer sees them, too";
    EXPECT_TRUE((solver.y().segment(21, 20).array() == 11.0 * t).all());
    EXPECT_EQ(solver.y()[0], 10.0 * t);
    EXPECT_EQ(solver.y()[41], t - 2.0);
  }
  EXPECT_EQ(asked.together, 3);
}

TEST(AlgebraicSolver, reportsALoopWithoutSolution) {
  // y = y^2 + 1 + x has no real root for x >= 0.
  CouplingGraph graph;
  graph.add("a", FunctionModel().state("x", -2.0).input("in").output("out", 1, {"in"}, [](double, const In& x, const In& u, Out y) { y[0] = u[0] * u[0] + 1.0 + x[0]; })
      .derivatives([](double, const In&, const In&, Out xdot) { xdot[0] = 0.0; }).make());
  graph.connect("a.out", "a.in");
  CoupledSystem system = std::move(graph).build();
  Vector x = system.initialState();
  AlgebraicSolver solver(system, tight(), 0.0, x, kNone);  // y^2 - y - 1 = 0 is fine
  EXPECT_NEAR(solver.y()[0] * solver.y()[0] - 1.0, solver.y()[0], 1e-12);
  x[0] = 1.0;
  const SolveReport report = solver.solve(1.0, x, kNone);
  EXPECT_NE(report.status, SolveStatus::kConverged);
  EXPECT_EQ(report.entry, 0);
}

TEST(AlgebraicSolver, restoredCacheContinuesBitwise) {
  CoupledSystem first = partLoop(), second = partLoop();
  Vector x = first.initialState();
  AlgebraicSolver a(first, tight(), 0.0, x, kNone), b(second, tight(), 0.0, x, kNone);
  for (int k = 0; k < 30; ++k) {
    x[0] = std::sin(0.3 * k);
    a.solve(k, x, kNone);
  }
  b.restoreCache(a.cache());
  for (int k = 30; k < 60; ++k) {
    x[0] = std::sin(0.3 * k);
    a.solve(k, x, kNone);
    b.solve(k, x, kNone);
    ASSERT_EQ(a.y(), b.y()) << k;
  }
  EXPECT_THROW(b.restoreCache({1.0}), std::invalid_argument);
}

TEST(AlgebraicSolver, restoredCacheContinuesBitwiseAmidTrustedSolves) {
  CoupledSystem first = partLoop(), second = partLoop();
  Vector x = first.initialState();
  SolverOptions options;
  AlgebraicSolver a(first, options, 0.0, x, kNone), b(second, options, 0.0, x, kNone);
  int trusted = 0;
  const auto solve = [&](AlgebraicSolver& solver, int k) {
    x[0] = 0.3 + 1e-5 * std::sin(0.3 * k);
    const SolverCounters before = solver.counters();
    k % 5 == 0 ? solver.solve(k, x, kNone) : solver.solveWithin(k, x, kNone);
    const auto spent = [&](std::uint64_t SolverCounters::*counter) { return solver.counters().*counter - before.*counter; };
    trusted += spent(&SolverCounters::newton_iterations) == 1 && spent(&SolverCounters::residual_evaluations) == 1;
  };
  for (int k = 0; k < 33; ++k) solve(a, k);
  b.restoreCache(a.cache());
  for (int k = 33; k < 90; ++k) {
    solve(a, k);
    solve(b, k);
    ASSERT_EQ(a.y(), b.y()) << k;
  }
  EXPECT_GE(trusted, 20) << "trusted solves are among them";
}

TEST(AlgebraicSolver, solvesTwoLoopsInOrderOfDependency) {
  // Loop 1: z = 0.5 z + x; loop 2 reads it: v = 0.25 v + z. Declared in the wrong order on purpose.
  CouplingGraph graph;
  graph.add("late", FunctionModel().input("own").input("z").output("v", 1, {"own", "z"}, [](double, const In&, const In& u, Out y) { y[0] = 0.25 * u[0] + u[1]; }).make());
  graph.add("early", FunctionModel().state("x", 3.0).input("own").output("z", 1, {"own"}, [](double, const In& x, const In& u, Out y) { y[0] = 0.5 * u[0] + x[0]; })
      .derivatives([](double, const In&, const In&, Out xdot) { xdot[0] = 0.0; }).make());
  graph.connect("late.v", "late.own");
  graph.connect("early.z", "late.z");
  graph.connect("early.z", "early.own");
  CoupledSystem system = std::move(graph).build();
  AlgebraicSolver solver(system, tight(), 0.0, system.initialState(), kNone);
  ASSERT_EQ(solver.loops().size(), 2u);
  EXPECT_NEAR(solver.y()[1], 6.0, 1e-12);
  EXPECT_NEAR(solver.y()[0], 8.0, 1e-12);
}

}  // namespace
}  // namespace heerk_rotor
