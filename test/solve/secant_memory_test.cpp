// Broyden's memory on linear equations, where theory says what it must do.
#include "heerk_rotor/solve/secant_memory.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

/// A = I + c a'.
struct RankOne {
  explicit RankOne(Index n) : c(n), a(n) {
    for (Index i = 0; i < n; ++i) {
      c[i] = 0.3 * std::cos(static_cast<double>(i));
      a[i] = std::sin(1.0 + 2.0 * static_cast<double>(i));
    }
  }
  Vector apply(const Vector& x) const { return x + c * a.dot(x); }
  Vector c, a;
};

class SecantMemoryOf : public testing::TestWithParam<Index> {};
INSTANTIATE_TEST_SUITE_P(Unknowns, SecantMemoryOf, testing::Values(1, 2, 3, 4, 5, 8, 17));

TEST_P(SecantMemoryOf, satisfiesTheSecantEquation) {
  const Index n = GetParam();
  const RankOne A(n);
  SecantMemory memory(n);
  Vector s = Vector::LinSpaced(n, 1.0, 2.0);
  const Vector r_new = s - A.apply(s);  // after the step s = H r, H = I
  Vector left = r_new;
  memory.learn(s.data(), r_new.data(), left.data());
  // Secant equation: H A s = s. And `left` has become H r_new.
  Vector image = A.apply(s), improved = r_new;
  memory.improve(image.data());
  memory.improve(improved.data());
  EXPECT_LE((image - s).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LE((improved - left).cwiseAbs().maxCoeff(), 1e-13);
}

/// r = b - A x by steps of H: never more than n for each direction that A - I has (Gay 1979: 2 n in all).
TEST_P(SecantMemoryOf, solvesLinearEquationsInFinitelyManySteps) {
  const Index n = GetParam();
  const RankOne A(n);
  const Vector b = Vector::LinSpaced(n, 1.0, 3.0);
  SecantMemory memory(n);
  Vector x = Vector::Zero(n), s;
  double first = 0.0;
  for (int k = 0; k < 4; ++k) {
    const Vector r_new = b - A.apply(x);
    Vector left = r_new;
    memory.improve(left.data());
    if (k > 0) memory.learn(s.data(), r_new.data(), left.data());
    else first = r_new.norm();
    s = left;
    x += s;
  }
  EXPECT_LE((b - A.apply(x)).norm(), 1e-12 * first);
}

TEST(SecantMemory, keepsSecantEquationsUntilItIsFullAndBeginsAnew) {
  constexpr Index n = 7, pairs = 4;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Matrix A = Matrix::Identity(n, n) + 0.2 * Matrix::NullaryExpr(n, n, [&] { return unit(random); });
  SecantMemory memory(n);
  for (int k = 0; k < 11; ++k) {
    const Vector s = Vector::NullaryExpr(n, [&] { return unit(random); });
    Vector y = A * s, image = y;
    memory.improve(image.data());
    Vector left = s - image;  // of any residual for which s was the step
    const Vector r_new = Vector::Constant(n, 0.1 * k);
    memory.learn(s.data(), r_new.data(), left.data());
    image = y;
    memory.improve(image.data());
    if (k % (pairs + 1) == pairs) {
      EXPECT_EQ(image, y) << "H = I again";
      EXPECT_EQ(left, r_new);
    } else {
      EXPECT_LE((image - s).cwiseAbs().maxCoeff(), 1e-12) << "step " << k;
    }
  }
}

TEST(SecantMemory, refusesToBecomeSingular) {
  SecantMemory memory(3);
  const Vector s = Vector::Ones(3);
  const Vector r_new = s;
  Vector left = s;  // the step has changed nothing: y = 0
  memory.learn(s.data(), r_new.data(), left.data());
  EXPECT_EQ(left, s);
  Vector r = Vector::Unit(3, 1);
  memory.improve(r.data());
  EXPECT_EQ(r, Vector::Unit(3, 1));
  left.setConstant(std::nan(""));
  memory.learn(s.data(), r_new.data(), left.data());
  memory.improve(r.data());
  EXPECT_EQ(r, Vector::Unit(3, 1));
}

TEST(SecantMemory, comesBackFromACheckpoint) {
  const RankOne A(5);
  SecantMemory memory(5), other(5);
  const Vector s = Vector::LinSpaced(5, -1.0, 2.0);
  const Vector r_new = s - A.apply(s);
  Vector left = r_new;
  memory.learn(s.data(), r_new.data(), left.data());
  other.restore(memory.values());
  Vector one = s, two = s;
  memory.improve(one.data());
  other.improve(two.data());
  EXPECT_EQ(one, two);
  EXPECT_THROW(other.restore({1.0, 2.0}), std::invalid_argument);
  std::vector<double> values = memory.values();
  values[0] = 99.0;
  EXPECT_THROW(other.restore(values), std::invalid_argument);
  values[0] = std::nan("");
  EXPECT_THROW(other.restore(values), std::invalid_argument);
  memory.clear();
  one = s;
  memory.improve(one.data());
  EXPECT_EQ(one, s);
}

}  // namespace
}  // namespace heerk_rotor
