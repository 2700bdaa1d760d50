#include "heerk_rotor/integrate/linear_propagator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <ostream>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "heerk_rotor/integrate/phi_functions.hpp"

namespace heerk_rotor {

inline void PrintTo(const Tableau& tableau, std::ostream* out) { *out << tableau.name; }

namespace {

std::vector<Tableau> exponentialTableaus() {
  std::vector<Tableau> result;
  for (const Tableau& t : tableaus())
    if (t.exponential) result.push_back(t);
  return result;
}

class PropagatorOfMethod : public testing::TestWithParam<Tableau> {};
class PropagatorOfExponentialMethod : public testing::TestWithParam<Tableau> {};
const auto tableauName = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Tableau, PropagatorOfMethod, testing::ValuesIn(tableaus()), tableauName);
INSTANTIATE_TEST_SUITE_P(Tableau, PropagatorOfExponentialMethod, testing::ValuesIn(exponentialTableaus()), tableauName);

ModalStiff modes(int m, double omega_max, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  ModalStiff modal = {Vector(m), Vector(m)};
  for (int i = 0; i < m; ++i) {
    modal.omega[i] = omega_max * std::max(0.05, unit(random));
    modal.damping[i] = 2 * 1.5 * unit(random) * modal.omega[i];  // zeta 0..1.5
  }
  return modal;
}

Matrix randomMatrix(Index rows, Index columns, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Matrix result(rows, columns);
  for (Index i = 0; i < result.size(); ++i) result.data()[i] = unit(random);
  return result;
}

/// Complex and real pairs in turn, |h block| up to `size` with h = 1, none growing.
PairStiff pairBlocks(int m, double size, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  PairStiff part;
  for (int i = 0; i < m; ++i) {
    const double a = -size * unit(random), b = i % 3 == 2 ? -size * unit(random) : size * (unit(random) - 0.5);
    Eigen::Matrix2d block;
    if (i % 3 == 2) block << a, 0.0, 0.0, b;
    else block << 0.1 * a, b, -b, 0.1 * a;
    part.blocks.push_back(block);
  }
  return part;
}

/// Largest deviation of any row from the formula of linear_propagator.hpp, written out with matrices of S; x and F are of size 1.
double worstRow(const StiffPart& part, const Matrix& S, double h, const Tableau& t, std::mt19937& random) {
  std::map<double, std::vector<Matrix>> known;
  const auto phi = [&](int k, double node) -> const Matrix& {
    if (known.count(node) == 0) known[node] = phiFunctions(node * h * S, kMaxPhi);
    return known[node][k];
  };
  const Index n = stiffSize(part);
  const auto propagator = makePropagator(part, h, t);
  const Vector x = randomMatrix(n, 1, random);
  const Matrix F = randomMatrix(n, t.stages(), random);
  double worst = 0.0;
  for (int row = 0; row <= t.stages(); ++row) {
    Vector expected = phi(0, t.node(row)) * x;
    for (int j = 0; j < row; ++j)
      for (const PhiTerm& term : t.rows[row][j]) expected += h * term.weight * phi(term.k, term.node) * F.col(j);
    Vector result(n);
    propagator->combine(row, x.data(), F.data(), n, result.data());
    worst = std::max(worst, (result - expected).cwiseAbs().maxCoeff());
  }
  return worst;
}

// ------------------------------------------------------------------------------------------------------ rows and structure

TEST_P(PropagatorOfExponentialMethod, denseRowsAreTheTableauWrittenOutForEverySize) {
  std::mt19937 random(1);
  for (int n : {1, 2, 3, 4, 5, 7, 8, 15, 16, 17, 33}) {
    const Matrix S = randomMatrix(n, n, random) * (3.0 / std::sqrt(n));
    EXPECT_LE(worstRow(DenseStiff{S}, S, 0.4, GetParam(), random), 1e-14) << "n = " << n;  // O(10) roundings of numbers of size 1..3
  }
}

TEST_P(PropagatorOfExponentialMethod, modalRowsAreTheDenseOnesForEveryNumberOfPairs) {
  std::mt19937 random(2);
  for (int m : {1, 2, 3, 4, 5, 15, 16, 17, 21}) {
    const ModalStiff modal = modes(m, 3.0, random);
    EXPECT_LE(worstRow(modal, stiffMatrix(modal), 0.7, GetParam(), random), 1e-14) << m << " pairs";
  }
}

TEST_P(PropagatorOfExponentialMethod, pairRowsAreTheDenseOnesForEveryNumberOfPairs) {
  std::mt19937 random(22);
  for (int m : {1, 2, 3, 4, 5, 15, 16, 17, 21})
    for (double size : {0.01, 3.0, 400.0}) {
      const PairStiff part = pairBlocks(m, size, random);
      EXPECT_LE(worstRow(part, stiffMatrix(part), 0.7, GetParam(), random), 2e-14) << m << " pairs, size " << size;
    }
}

TEST_P(PropagatorOfExponentialMethod, secondOrderRowsAreTheDenseOnes) {
  std::mt19937 random(23);
  const SecondOrderStiff part{randomMatrix(3, 3, random) + 3.0 * Matrix::Identity(3, 3), randomMatrix(3, 3, random)};
  EXPECT_LE(worstRow(part, stiffMatrix(part), 0.4, GetParam(), random), 1e-14);
}

TEST_P(PropagatorOfExponentialMethod, stiffModalRowsAreTheDenseOnesInTheEnergyNorm) {
  // h omega to 600. In (omega q, q') every number is of size one; both sides are good to 1e-15 there, weights of up to 18 multiply that.
  std::mt19937 random(3);
  const int m = 6;
  const double h = 1e-3;
  const Tableau& t = GetParam();
  const ModalStiff modal = modes(m, 6e5, random);
  const auto propagator = makePropagator(modal, h, t);
  const auto dense = makePropagator(DenseStiff{stiffMatrix(modal)}, h, t);
  Vector energy = Vector::Ones(2 * m);
  energy.head(m) = modal.omega;
  const Vector x = energy.cwiseInverse().cwiseProduct(Vector(randomMatrix(2 * m, 1, random)));
  const Matrix F = energy.cwiseInverse().asDiagonal() * randomMatrix(2 * m, t.stages(), random) / h;
  for (int row = 0; row <= t.stages(); ++row) {
    Vector a(2 * m), b(2 * m);
    propagator->combine(row, x.data(), F.data(), 2 * m, a.data());
    dense->combine(row, x.data(), F.data(), 2 * m, b.data());
    EXPECT_LE(energy.cwiseProduct(a - b).cwiseAbs().maxCoeff(), 1e-13) << "row " << row;
  }
}

TEST_P(PropagatorOfMethod, withoutStiffnessIsTheClassicalRungeKuttaMethod) {
  std::mt19937 random(4);
  const Tableau& t = GetParam();
  const double h = 0.3;
  for (int n : {1, 2, 12, 19}) {
    const Vector x = randomMatrix(n, 1, random);
    const Matrix F = randomMatrix(n, t.stages(), random);
    for (const StiffPart& part : {StiffPart(ZeroStiff{n}), StiffPart(DenseStiff{Matrix::Zero(n, n)})}) {
      const auto propagator = makePropagator(part, h, t);
      for (int row = 0; row <= t.stages(); ++row) {
        Vector expected = x;
        for (int j = 0; j < row; ++j)
          for (const PhiTerm& term : t.rows[row][j]) expected += h * term.weight / std::tgamma(term.k + 1) * F.col(j);
        Vector result(n);
        propagator->combine(row, x.data(), F.data(), n, result.data());
        EXPECT_LE((result - expected).cwiseAbs().maxCoeff(), 1e-14) << "row " << row << ", n = " << n;
      }
    }
  }
}

TEST(LinearPropagator, classicalTableauIgnoresS) {
  std::mt19937 random(5);
  const Tableau& t = tableau("HERK4");
  BlockStiff block;
  block.blocks.push_back({modes(2, 1e6, random)});
  block.blocks.push_back({DenseStiff{Matrix::Constant(3, 3, 1e9)}});
  const auto with = makePropagator(block, 0.1, t);
  const auto without = makePropagator(ZeroStiff{7}, 0.1, t);
  const Vector x = randomMatrix(7, 1, random);
  const Matrix F = randomMatrix(7, 4, random);
  for (int row = 0; row <= 4; ++row) {
    Vector a(7), b(7);
    with->combine(row, x.data(), F.data(), 7, a.data());
    without->combine(row, x.data(), F.data(), 7, b.data());
    EXPECT_EQ(a, b);
  }
}

TEST_P(PropagatorOfMethod, blocksPropagateLikeTheirPieces) {
  // Neighbouring zero blocks, an empty one and a nested block: what a coupled system hands over.
  std::mt19937 random(6);
  const Tableau& t = GetParam();
  const double h = 0.05;
  const std::vector<StiffPart> pieces = {ZeroStiff{12}, ZeroStiff{3}, modes(1, 40.0, random), ModalStiff{}, DenseStiff{randomMatrix(2, 2, random)},
                                         DenseStiff{randomMatrix(9, 9, random)}, ZeroStiff{0}, modes(20, 10.0, random), ZeroStiff{5}};
  BlockStiff inner, outer;
  for (std::size_t i = 0; i < pieces.size(); ++i) (i >= 1 && i < 5 ? inner : outer).blocks.push_back({pieces[i]});
  outer.blocks.insert(outer.blocks.begin() + 1, {inner});
  const Index n = stiffSize(outer);
  const auto whole = makePropagator(outer, h, t);
  const Vector x = randomMatrix(n, 1, random);
  const Matrix F = randomMatrix(n, t.stages(), random);
  for (int row = 0; row <= t.stages(); ++row) {
    Vector result(n), expected(n);
    whole->combine(row, x.data(), F.data(), n, result.data());
    Index offset = 0;
    for (const StiffPart& piece : pieces) {
      makePropagator(piece, h, t)->combine(row, x.data() + offset, F.data() + offset, n, expected.data() + offset);
      offset += stiffSize(piece);
    }
    EXPECT_LE((result - expected).cwiseAbs().maxCoeff(), 1e-15);  // merged zero blocks may round differently in their last bit
  }
}

TEST_P(PropagatorOfMethod, readsWithTheGivenStrideAndWritesNothingBeyondTheResult) {
  std::mt19937 random(7);
  const Tableau& t = GetParam();
  BlockStiff block;
  block.blocks = {{ZeroStiff{5}}, {modes(18, 4.0, random)}, {DenseStiff{randomMatrix(7, 7, random)}}};
  const Index n = stiffSize(block), stride = n + 5;
  const auto propagator = makePropagator(block, 0.1, t);
  const Vector x = randomMatrix(n, 1, random);
  const Matrix F = randomMatrix(n, t.stages(), random);
  Matrix wide = Matrix::Constant(stride, t.stages(), std::nan(""));
  wide.topRows(n) = F;
  for (int row = 0; row <= t.stages(); ++row) {
    Vector a(n), b = Vector::Constant(n + 16, 7.0);
    propagator->combine(row, x.data(), F.data(), n, a.data());
    propagator->combine(row, x.data(), wide.data(), stride, b.data());
    EXPECT_EQ(a, b.head(n));
    EXPECT_EQ(b.tail(16), Vector::Constant(16, 7.0));
  }
}

TEST_P(PropagatorOfMethod, remaindersOnRatesAloneActLikeOthersWhoseFirstHalfIsZero) {
  std::mt19937 random(12);
  const Tableau& t = GetParam();
  for (const int m : {1, 2, 5, 23}) {
    ModalStiff part = modes(m, 30.0, random);
    const Vector x = randomMatrix(2 * m, 1, random);
    Matrix F = randomMatrix(2 * m, t.stages(), random);
    F.topRows(m).setZero();
    for (int row = 0; row <= t.stages(); ++row) {
      Vector expected(2 * m), result(2 * m);
      part.remainder_on_rates = false;
      makePropagator(part, 0.1, t)->combine(row, x.data(), F.data(), 2 * m, expected.data());
      part.remainder_on_rates = true;
      if (m > 1 && t.exponential) F.topRows(m).setConstant(std::nan(""));  // not even read
      makePropagator(part, 0.1, t)->combine(row, x.data(), F.data(), 2 * m, result.data());
      F.topRows(m).setZero();
      EXPECT_LE((result - expected).cwiseAbs().maxCoeff(), 1e-15) << "row " << row << ", " << m << " modes";
    }
  }
}

TEST_P(PropagatorOfMethod, laterRemaindersAreNotRead) {
  std::mt19937 random(8);
  const Tableau& t = GetParam();
  BlockStiff block;
  block.blocks = {{ZeroStiff{3}}, {modes(2, 4.0, random)}, {DenseStiff{randomMatrix(5, 5, random)}}};
  const Index n = stiffSize(block);
  const auto propagator = makePropagator(block, 0.1, t);
  const Vector x = Vector::Ones(n);
  for (int row = 0; row <= t.stages(); ++row) {
    Matrix F = Matrix::Constant(n, t.stages(), std::nan(""));
    F.leftCols(row).setOnes();
    Vector result(n);
    propagator->combine(row, x.data(), F.data(), n, result.data());
    EXPECT_TRUE(result.allFinite()) << "row " << row;
  }
}

TEST(LinearPropagator, firstStageIsTheStateBitForBit) {
  std::mt19937 random(9);
  for (const Tableau& t : tableaus())
    for (const StiffPart& part : {StiffPart(ZeroStiff{6}), StiffPart(modes(3, 1e5, random)), StiffPart(DenseStiff{randomMatrix(6, 6, random)})}) {
      const Vector x = randomMatrix(6, 1, random);
      Vector result(6);
      makePropagator(part, 0.1, t)->combine(0, x.data(), nullptr, 0, result.data());
      EXPECT_EQ(result, x);
    }
}

TEST(LinearPropagator, refusesWrongPartsByTheirPath) {
  const Tableau& t = tableau("HEERK4");
  const auto message = [&](const StiffPart& part, double h = 0.1) -> std::string {
    try {
      makePropagator(part, h, t);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(ZeroStiff{2}, 0.0).find("h = 0"), std::string::npos);
  EXPECT_NE(message(ZeroStiff{2}, std::nan("")), "");
  EXPECT_NE(message(DenseStiff{Matrix::Zero(2, 3)}).find("2 x 3, expected square"), std::string::npos);
  EXPECT_NE(message(DenseStiff{Matrix::Constant(2, 2, INFINITY)}), "");
  EXPECT_NE(message(ModalStiff{Vector::Ones(2), Vector::Ones(1)}).find("2 omega"), std::string::npos);
  EXPECT_NE(message(SecondOrderStiff{Matrix::Zero(2, 2), Matrix::Zero(3, 3)}).find("damping 3 x 3"), std::string::npos);
  PairStiff skewed;
  skewed.blocks.push_back((Eigen::Matrix2d() << 1.0, 2.0, 2.0, 1.0).finished());
  EXPECT_NE(message(skewed).find("pair 0"), std::string::npos);
  BlockStiff inner, outer;
  inner.blocks.push_back({ZeroStiff{1}});
  inner.blocks.push_back({ModalStiff{Vector::Ones(1), -Vector::Ones(1)}});
  outer.blocks.push_back({ZeroStiff{1}});
  outer.blocks.push_back({inner});
  EXPECT_NE(message(outer).find("stiff part.blocks[1].blocks[1]: mode 0"), std::string::npos) << message(outer);

  Tableau broken = t;
  broken.rows[1][0][0].weight = 0.3;
  EXPECT_THROW(makePropagator(ZeroStiff{1}, 0.1, broken), std::invalid_argument);
}

// ------------------------------------------------------------------------------------------------------------- integration

using Rhs = std::function<void(double t, const Vector& x, Vector& f)>;

/// x at t0 + steps * h. f is the complete right-hand side.
Vector integrate(const StiffPart& part, const Tableau& method, const Rhs& f, Vector x, double h, int steps) {
  const Index n = x.size();
  const auto propagator = makePropagator(part, h, method);
  Matrix F(n, method.stages());
  Vector stage(n), xdot(n);
  for (int step = 0; step < steps; ++step) {
    for (int i = 0; i < method.stages(); ++i) {
      propagator->combine(i, x.data(), F.data(), n, stage.data());
      f((step + method.c[i]) * h, stage, xdot);
      if (method.exponential)
        subtractStiff(part, view(std::as_const(stage)), view(std::as_const(xdot)), Out(F.col(i).data(), n));
      else
        F.col(i) = xdot;
    }
    propagator->combine(method.stages(), x.data(), F.data(), n, stage.data());
    x = stage;
  }
  return x;
}

/// Errors for h = t_end / steps; prints them and returns the slope of the last `fit` + 1 points in log-log, least squares.
double measuredOrder(const char* problem, const Tableau& method, const std::vector<int>& steps, const std::function<double(int)>& error) {
  std::printf("%-22s %-7s", problem, method.name.c_str());
  double s0 = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int n : steps) {
    const double e = error(n), lx = -std::log(n), ly = std::log(e);
    std::printf(" %.1e", e);
    s0 += 1, sx += lx, sy += ly, sxx += lx * lx, sxy += lx * ly;
  }
  const double order = (s0 * sxy - sx * sy) / (s0 * sxx - sx * sx);
  std::printf("  order %.2f\n", order);
  return order;
}

TEST_P(PropagatorOfExponentialMethod, constantForcingIsExactForAnyStep) {
  // x' = S x + g: x(t) = x* + e^{tS} (x0 - x*), S x* = -g. Oscillators and a rotated decay, h omega up to 1e4, 50 steps.
  std::mt19937 random(10);
  const Tableau& t = GetParam();
  const int m = 3, steps = 50;
  ModalStiff modal = {Vector(m), Vector(m)};
  modal.omega << 1.0, 30.0, 1e4;
  modal.damping << 0.2, 60.0 * (1 + 1e-9), 0.0;  // under-, nearly critically and not damped
  Matrix decay = randomMatrix(4, 4, random);
  decay = -(decay * decay.transpose()) - Matrix::Identity(4, 4);
  BlockStiff part;
  part.blocks = {{modal}, {DenseStiff{decay}}, {DenseStiff{Matrix::Constant(1, 1, -3e3)}}};
  const Matrix S = stiffMatrix(part);
  const Index n = S.rows();
  Vector scale = Vector::Ones(n);  // velocities of fast modes are large
  scale.segment(m, m) = modal.omega.cwiseMax(1.0);
  const Vector x0 = scale.cwiseProduct(Vector(randomMatrix(n, 1, random)));
  const Vector rest = Vector::Constant(n, 0.3).cwiseProduct((Vector(n) << Vector::Ones(m), Vector::Zero(m), Vector::Ones(n - 2 * m)).finished());
  const Vector g = -(S * rest);
  for (double h : {1e-4, 0.01, 1.0}) {
    const auto propagator = makePropagator(part, h, t);
    const auto forced = [&](const Vector& x) -> Vector {  // one step with f~ = g in all stages
      const Matrix F = g.replicate(1, t.stages());
      Vector result(n);
      propagator->combine(t.stages(), x.data(), F.data(), n, result.data());
      return result;
    };
    Vector x = x0;
    for (int step = 0; step < steps; ++step) x = forced(x);
    // Reference of the modes: closed solution in long double at t = steps * h; of the rest: phi_0.
    Vector expected = rest + phiFunctions(steps * h * S, 0)[0] * (x0 - rest);
    for (int i = 0; i < m; ++i) {
      const Eigen::Vector2d start(x0[i] - rest[i], x0[m + i]);
      const Eigen::Vector2d end = ModalPhi(modal.omega[i], modal.damping[i], steps * h)[0] * start;
      expected[i] = rest[i] + end[0];
      expected[m + i] = end[1];
    }
    // 50 steps, a few roundings each of h phi_1 g (of size 18 * scale): 1e-12.
    EXPECT_LE((x - expected).cwiseQuotient(scale).cwiseAbs().maxCoeff(), 1e-12) << "h = " << h;

    // Every stage lies on the solution, too: sum_j a_ij = c_i phi_1(c_i hS).
    const Matrix F = g.replicate(1, t.stages());
    for (int row = 1; row < t.stages(); ++row) {
      Vector stage(n);
      propagator->combine(row, x0.data(), F.data(), n, stage.data());
      const Vector at = rest + phiFunctions(t.c[row] * h * S, 0)[0] * (x0 - rest);
      EXPECT_LE((stage - at).cwiseQuotient(scale).cwiseAbs().maxCoeff(), 1e-12) << "stage " << row << ", h = " << h;
    }
  }
}

TEST_P(PropagatorOfMethod, hasItsClassicalOrderOnANonstiffProblem) {
  // Brusselator, S = its Jacobian at the start (2 x 2, full): x' = 1 + x^2 y - 2.7 x, y' = 1.7 x - x^2 y.
  const Tableau& method = GetParam();
  const Rhs f = [](double, const Vector& x, Vector& xdot) {
    const double reaction = x[0] * x[0] * x[1];
    xdot[0] = 1.0 + reaction - 2.7 * x[0];
    xdot[1] = 1.7 * x[0] - reaction;
  };
  Vector x0(2);
  x0 << 1.2, 1.5;
  Matrix S(2, 2);
  S << 2 * x0[0] * x0[1] - 2.7, x0[0] * x0[0], 1.7 - 2 * x0[0] * x0[1], -x0[0] * x0[0];
  // Reference: classical fourth order, 40 times finer than the finest run.
  const double t_end = 4.0;
  static const Vector reference = integrate(ZeroStiff{2}, tableau("HERK4"), f, x0, t_end / 12800, 12800);
  const double order = measuredOrder("non-stiff", method, {40, 80, 160, 320}, [&](int steps) {
    return (integrate(DenseStiff{S}, method, f, x0, t_end / steps, steps) - reference).norm();
  });
  EXPECT_NEAR(order, method.order, 0.15);  // slopes of four finite steps
}

// The parabolic problem of Hochbruck & Ostermann (2005), example 6.1: u_t = u_xx + 1/(1 + u^2) + Phi(x, t), u = x (1 - x) e^t, u(0) = u(1) = 0.
// Central differences are exact for it (u is quadratic in x), so u on the grid solves the semidiscrete system.
struct Heat {
  int cells;
  Vector x;       // (cells - 1) grid points
  Vector lambda;  // eigenvalues of the second difference, down to -4 cells^2
  Matrix sine;    // its orthonormal eigenvectors, symmetric

  explicit Heat(int n) : cells(n), x(n - 1), lambda(n - 1), sine(n - 1, n - 1) {
    for (int j = 1; j < n; ++j) {
      x[j - 1] = static_cast<double>(j) / n;
      lambda[j - 1] = -4.0 * n * n * std::pow(std::sin(M_PI * j / (2.0 * n)), 2);
      for (int i = 1; i < n; ++i) sine(i - 1, j - 1) = std::sqrt(2.0 / n) * std::sin(M_PI * i * j / n);
    }
  }
  Vector exact(double t) const { return std::exp(t) * (x.array() * (1.0 - x.array())).matrix(); }
  /// 1/(1 + u^2) + Phi
  Vector reaction(double t, const Vector& u) const {
    const Eigen::ArrayXd e = exact(t).array();
    return (1.0 / (1.0 + u.array().square()) + e + 2.0 * std::exp(t) - 1.0 / (1.0 + e.square())).matrix();
  }
  /// In the sine basis S is diagonal: 1 x 1 blocks, cheap to tabulate for any step.
  StiffPart stiff() const {
    BlockStiff part;
    for (double l : lambda) part.blocks.push_back({DenseStiff{Matrix::Constant(1, 1, l)}});
    return part;
  }
  Vector solve(const Tableau& method, int steps) const {
    const Rhs f = [this](double t, const Vector& y, Vector& ydot) {
      ydot.noalias() = sine * reaction(t, sine * y);
      ydot += lambda.cwiseProduct(y);
    };
    return sine * integrate(stiff(), method, f, sine * exact(0.0), 1.0 / steps, steps);
  }
};

TEST_P(PropagatorOfExponentialMethod, hasTheKnownOrderOnTheStiffHeatProblem) {
  // Stiff orders: 2, 3, 4; Cox-Matthews drops from 4 (lag_rotor notes and Hochbruck & Ostermann: 1.92, 3.02, 4.05, about 2.7).
  const std::map<std::string, double> expected = {{"HEERK2", 1.92}, {"HEERK3", 3.02}, {"HEERK4", 4.05}, {"ETDRK4", 2.7}};
  const Tableau& method = GetParam();
  static const Heat heat(200);
  const double order = measuredOrder("heat, N = 200", method, {16, 32, 64, 128}, [&](int steps) {
    return (heat.solve(method, steps) - heat.exact(1.0)).cwiseAbs().maxCoeff();
  });
  ASSERT_EQ(expected.count(method.name), 1u) << "a new method needs its expected stiff order here";
  EXPECT_NEAR(order, expected.at(method.name), 0.1);  // measured 1.92, 3.02, 4.03, 2.63; ETDRK4's slope moves with the steps
}

TEST_P(PropagatorOfExponentialMethod, gridAndSineBasisGiveTheSameHeatSolution) {
  // The same problem with a dense S of norm 1e4 (h lambda to -2500), where the dense phi functions carry it.
  const Heat heat(50);
  const int n = heat.cells - 1;
  Matrix S = Matrix::Zero(n, n);
  S.diagonal().setConstant(-2.0 * heat.cells * heat.cells);
  S.diagonal(1).setConstant(1.0 * heat.cells * heat.cells);
  S.diagonal(-1).setConstant(1.0 * heat.cells * heat.cells);
  const Rhs f = [&](double t, const Vector& u, Vector& udot) { udot = S * u + heat.reaction(t, u); };
  const Vector dense = integrate(DenseStiff{S}, GetParam(), f, heat.exact(0.0), 0.25, 4);
  // f - S u cancels numbers of size 1e4: 1e-12 in the remainder, and that is what four steps keep.
  EXPECT_LE((dense - heat.solve(GetParam(), 4)).cwiseAbs().maxCoeff(), 1e-11);
}

TEST_P(PropagatorOfExponentialMethod, hasTheOrderItsWeightsAllowBehindAStiffOscillator) {
  // q'' = -omega^2 (q - cos t) - cos t + (q^2 - cos^2 t), q = cos t, undamped, omega = 1e4: forcing of size omega^2 = 1e8,
  // h omega = 2 pi k + 1 with k = 4..64 (equal phases, otherwise resonance decides). Errors in (q, q'/omega).
  // The local error is h^p f~^(p-1) psi_p(z), psi_p = phi_p - sum b_j c_j^(p-1)/(p-1)! for the first p where this is not zero; it does not
  // add up over the steps. HEERK2: p = 2, psi_2 ~ 1/z: h. HEERK3: p = 4, 1/z: h^3. HEERK4 and ETDRK4: p = 4, but the node at the end of
  // the step removes 1/z and leaves 1/z^2: h^2 / omega, a lower order with a much smaller error.
  const std::map<std::string, double> expected = {{"HEERK2", 1.0}, {"HEERK3", 3.0}, {"HEERK4", 2.0}, {"ETDRK4", 2.0}};
  const Tableau& method = GetParam();
  const double omega = 1e4, t_end = 2.0;
  const ModalStiff modal = {Vector::Constant(1, omega), Vector::Zero(1)};
  const Rhs f = [&](double t, const Vector& x, Vector& xdot) {
    xdot[0] = x[1];
    xdot[1] = -omega * omega * (x[0] - std::cos(t)) - std::cos(t) + x[0] * x[0] - std::cos(t) * std::cos(t);
  };
  Vector x0(2);
  x0 << 1.0, 0.0;
  std::vector<int> steps;
  for (int k : {64, 32, 16, 8, 4}) steps.push_back(static_cast<int>(t_end * omega / (2 * M_PI * k + 1)));
  const double order = measuredOrder("stiff oscillator", method, steps, [&](int n) {
    const double k = std::round((t_end * omega / n - 1) / (2 * M_PI));
    const double h = (2 * M_PI * k + 1) / omega;
    const Vector x = integrate(modal, method, f, x0, h, n);
    return std::hypot(x[0] - std::cos(n * h), (x[1] + std::sin(n * h)) / omega);
  });
  ASSERT_EQ(expected.count(method.name), 1u) << "a new method needs its expected order here";
  EXPECT_NEAR(order, expected.at(method.name), 0.15);  // measured 1.03, 3.04, 1.90, 1.98: the last terms of psi have not died out at k = 4
}

}  // namespace
}  // namespace heerk_rotor
