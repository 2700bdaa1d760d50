// The methods of Liu & Zhang's comparison under the common Simulation: Newmark and the two precise integration methods, on every kind of stiff part.
#include "heerk_rotor/integrate/step_method.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <Eigen/LU>

#include "../solve/function_model.hpp"
#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/integrate/phi_functions.hpp"
#include "heerk_rotor/integrate/precise_exponential.hpp"
#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {
namespace {

Matrix randomMatrix(Index rows, Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Matrix result(rows, columns);
  for (Index i = 0; i < result.size(); ++i) result.data()[i] = unit(random);
  return result;
}

/// Six states of each kind of S, none growing much.
std::vector<StiffPart> everyKind() {
  const Matrix A = 4.0 * Matrix::Identity(3, 3) + 0.5 * randomMatrix(3, 3, 1), D = 0.3 * randomMatrix(3, 3, 2) + 0.5 * Matrix::Identity(3, 3);
  PairStiff pairs;
  for (int i = 0; i < 3; ++i) {
    Eigen::Matrix2d block;
    if (i == 1) block << -0.5, 0.0, 0.0, -2.0;
    else block << -0.1 * i, 1.5 + i, -1.5 - i, -0.1 * i;
    pairs.blocks.push_back(block);
  }
  BlockStiff blocks;
  blocks.blocks = {{ZeroStiff{1}}, {SecondOrderStiff{A.topLeftCorner(1, 1), D.topLeftCorner(1, 1)}}, {DenseStiff{-A}}};
  return {ZeroStiff{6}, DenseStiff{randomMatrix(6, 6, 3)}, ModalStiff{Vector::LinSpaced(3, 1.0, 3.0), Vector::LinSpaced(3, 0.0, 0.4)}, SecondOrderStiff{A, D}, pairs, blocks};
}

/// x' = S x + r(t, x); the remainder acts on the rates (the lower half) only, or on everything.
CoupledSystem system(const StiffPart& part, std::function<Vector(double t, const Vector& x)> remainder) {
  FunctionModel model;
  const Matrix S = stiffMatrix(part);
  for (Index i = 0; i < S.rows(); ++i) model.state("x" + std::to_string(i + 1), 0.3 + 0.1 * static_cast<double>(i));
  model.output("first", 1, {}, [](double, const In& x, const In&, Out y) { y[0] = x[0]; });
  model.stiff(part).derivatives([S, remainder](double t, const In& x, const In&, Out xdot) { xdot = S * Vector(x) + remainder(t, x); });
  CouplingGraph graph;
  graph.add("m", model.make());
  return std::move(graph).build();
}

Vector none(double, const Vector& x) { return Vector::Zero(x.size()); }
Vector onRates(double t, const Vector& x) {
  Vector r = Vector::Zero(x.size());
  for (Index i = x.size() / 2; i < x.size(); ++i) r[i] = std::sin(2.0 * t + static_cast<double>(i)) - 0.3 * std::pow(x[i - x.size() / 2], 3);
  return r;
}
Vector onAll(double t, const Vector& x) { return (0.2 * x.array().sin() + std::cos(t)).matrix(); }

Vector after(const StiffPart& part, const std::function<Vector(double, const Vector&)>& remainder, const std::string& method, double h, long steps) {
  StepOptions options;
  options.step = h;
  options.method = method;
  options.solver.tolerance = 1e-14;
  Simulation simulation(system(part, remainder), options);
  for (long i = 0; i < steps; ++i) EXPECT_EQ(simulation.step(Vector()), StepStatus::kOk) << method << ": " << simulation.failure().cause;
  return simulation.state();
}

TEST(StepMethod, everyNameMakesItsMethodAndAnUnknownOneListsThem) {
  const CoupledSystem some = system(ZeroStiff{2}, none);
  for (const std::string& name : stepMethodNames()) {
    const auto method = makeStepMethod(name, some, 0.1, 1e-10);
    EXPECT_EQ(method->name(), name);
    EXPECT_EQ(method->order(), orderOfStepMethod(name));
    EXPECT_GE(method->evaluations(), 1);
  }
  try {
    makeStepMethod("newmark", some, 0.1, 1e-10);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("Newmark, precise_1, precise_2"), std::string::npos) << error.what();
  }
}

TEST(StepMethod, everyMethodHasItsOrderOnEveryKindOfStiffPart) {
  for (const StiffPart& part : everyKind())
    for (const auto& remainder : {onRates, onAll}) {
      const Vector exact = after(part, remainder, "HERK4", 1.0 / 3200, 3200);
      for (const std::string& method : stepMethodNames()) {
        const double coarse = (after(part, remainder, method, 1.0 / 10, 10) - exact).norm(), fine = (after(part, remainder, method, 1.0 / 40, 40) - exact).norm();
        // The precise methods gain up to one order where the quadrature's error dominates a small one of the predictor, never lose.
        EXPECT_GE(0.5 * std::log2(coarse / fine), orderOfStepMethod(method) - 0.25) << method << ", kind " << part.index() << ": " << coarse << ", " << fine;
        EXPECT_LE(fine, method == "HEERK2" || method == "Newmark" ? 3e-3 : 1e-4) << method << ", kind " << part.index();
      }
    }
}

TEST(Newmark, isTheTrapezoidalRuleOnALinearSystemWhateverTheKindOfStiffPart) {
  const double h = 0.37;
  for (const StiffPart& part : everyKind()) {
    const Matrix S = stiffMatrix(part), I = Matrix::Identity(6, 6);
    const Vector x = after(part, none, "HEERK4", 1e-3, 0);
    const Vector expected = (I - 0.5 * h * S).inverse() * (I + 0.5 * h * S) * x;
    EXPECT_LE((after(part, none, "Newmark", h, 1) - expected).norm(), 1e-14) << "kind " << part.index();
  }
}

TEST(Newmark, solvesItsEquationsWithAStrongNonlinearityOutsideS) {
  // All of the stiffness in f~: h |f'| / 2 = 3, where a fixed point iteration would diverge. One state's equation by hand: x + 3 tanh(x) = x_n - 3 tanh(x_n).
  const double rate = 6.0, h = 1.0;
  const auto remainder = [rate](double, const Vector& x) -> Vector { return -rate * x.array().tanh().matrix(); };
  const Vector x0 = after(ZeroStiff{2}, none, "HEERK4", h, 0), x = after(ZeroStiff{2}, remainder, "Newmark", h, 1);
  for (Index i = 0; i < 2; ++i) EXPECT_NEAR(x[i] + 0.5 * h * rate * std::tanh(x[i]), x0[i] - 0.5 * h * rate * std::tanh(x0[i]), 1e-10);
}

TEST(Newmark, equationsWithoutSolutionStopTheStepWithItsName) {
  StepOptions options;
  options.step = 1.0;
  options.method = "Newmark";
  Simulation simulation(system(ZeroStiff{1}, [](double, const Vector& x) -> Vector { return (1.0 + 4.0 * x.array().square()).matrix(); }), options);  // x = a + x^2..: no real root
  const Vector before = simulation.state();
  EXPECT_EQ(simulation.step(Vector()), StepStatus::kSolverStalled);
  EXPECT_EQ(simulation.failure().where, "Newmark");
  EXPECT_EQ(simulation.state(), before);
  simulation.reset();
  EXPECT_EQ(simulation.failure().status, StepStatus::kOk);
}

TEST(Newmark, continuesFromACheckpointBitForBit) {
  StepOptions options;
  options.step = 0.05;
  options.method = "Newmark";
  const StiffPart part = everyKind()[3];
  Simulation whole(system(part, onAll), options), half(system(part, onAll), options), rest(system(part, onAll), options);
  for (int i = 0; i < 40; ++i) whole.step(Vector());
  for (int i = 0; i < 20; ++i) half.step(Vector());
  rest.restore(half.checkpoint());
  for (int i = 0; i < 20; ++i) rest.step(Vector());
  EXPECT_EQ(rest.stateHash(), whole.stateHash());
  Simulation::Checkpoint wrong = half.checkpoint();
  wrong.solver_cache.pop_back();
  EXPECT_THROW(rest.restore(wrong), std::invalid_argument);
}

TEST(PreciseIntegration, bothVariantsAgreeToRoundOff) {
  for (const StiffPart& part : everyKind())
    for (const auto& remainder : {onRates, onAll}) {
      const Vector dense = after(part, remainder, "precise_1", 0.05, 100), blocks = after(part, remainder, "precise_2", 0.05, 100);
      EXPECT_LE((dense - blocks).norm(), 1e-13 * dense.norm()) << "kind " << part.index();  // 100 steps of some roundings each
    }
}

TEST(PreciseIntegration, homogeneousEquationsAreExactAtAnyStep) {
  for (const StiffPart& part : everyKind()) {
    const Matrix S = stiffMatrix(part);
    const Vector expected = phiFunctions(1.7 * S, 0)[0] * after(part, none, "HEERK4", 1.0, 0);
    for (const char* method : {"precise_1", "precise_2"}) EXPECT_LE((after(part, none, method, 1.7, 1) - expected).norm(), 1e-13 * (1.0 + expected.norm())) << method << ", kind " << part.index();
  }
}

TEST(PreciseExponential, isTheExponentialAlsoInBadUnits) {
  for (const double norm : {1e-3, 1.0, 30.0}) {
    const Matrix A = norm * randomMatrix(12, 12, 7) - norm * Matrix::Identity(12, 12);
    const Matrix exact = phiFunctions(A, 0)[0];
    EXPECT_LE((preciseExponential(A, 1.0) - exact).norm(), 1e-14 * std::max(1.0, norm) * exact.norm()) << norm;  // 20 doublings, each of some roundings
    Vector units(12);
    for (Index i = 0; i < 12; ++i) units[i] = std::pow(10.0, i - 6.0);
    const Matrix bad = units.asDiagonal() * A * units.cwiseInverse().asDiagonal();
    const Matrix back = units.cwiseInverse().asDiagonal() * preciseExponential(bad, 1.0) * units.asDiagonal();
    EXPECT_LE((back - exact).norm(), 1e-13 * std::max(1.0, norm) * exact.norm()) << norm;
  }
  EXPECT_THROW(preciseExponential(Matrix::Zero(2, 3), 1.0), std::invalid_argument);
  EXPECT_THROW(preciseExponential(Matrix::Constant(2, 2, std::nan("")), 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace heerk_rotor
