#include "heerk_rotor/solve/sparse_lu.hpp"

#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

/// Random sparse matrix with a full diagonal, as pattern, values and dense copy.
struct Example {
  SparsityPattern pattern;
  std::vector<double> values;
  Matrix dense;

  Example(Index n, double density, unsigned seed, double diagonal) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0), chance(0.0, 1.0);
    dense = Matrix::Zero(n, n);
    pattern.size = n;
    pattern.start.push_back(0);
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < n; ++i) {
        if (i != j && chance(random) > density) continue;
        dense(i, j) = i == j ? diagonal * unit(random) : unit(random);
        pattern.rows.push_back(i);
        values.push_back(dense(i, j));
      }
      pattern.start.push_back(static_cast<Index>(pattern.rows.size()));
    }
  }
};

TEST(SparseLu, agreesWithDenseSolution) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Index n = 1 + seed % 37;
    const Example e(n, 0.2, seed, 3.0);
    const Vector b = Vector::LinSpaced(n, -1.0, 2.0);
    SparseLu lu(e.pattern);
    ASSERT_TRUE(lu.factorize(e.values));
    Vector x = b;
    lu.solve(x.data());
    // Backward stable: the residual is round-off of |A| |x|.
    EXPECT_LT((e.dense * x - b).cwiseAbs().maxCoeff(), 1e-13 * (1.0 + e.dense.cwiseAbs().rowwise().sum().maxCoeff() * x.cwiseAbs().maxCoeff())) << "seed " << seed;
  }
}

TEST(SparseLu, pivotsWhereTheDiagonalVanishes) {
  SparsityPattern pattern;
  pattern.size = 2;
  pattern.start = {0, 2, 4};
  pattern.rows = {0, 1, 0, 1};
  SparseLu lu(pattern);
  ASSERT_TRUE(lu.factorize({0.0, 2.0, 4.0, 0.0}));
  double b[2] = {8.0, 6.0};
  lu.solve(b);
  EXPECT_DOUBLE_EQ(b[0], 3.0);
  EXPECT_DOUBLE_EQ(b[1], 2.0);
}

TEST(SparseLu, reportsSingularMatrices) {
  SparsityPattern pattern;
  pattern.size = 2;
  pattern.start = {0, 2, 4};
  pattern.rows = {0, 1, 0, 1};
  SparseLu lu(pattern);
  EXPECT_FALSE(lu.factorize({1.0, 2.0, 2.0, 4.0}));
  EXPECT_FALSE(lu.factorize({1.0, NAN, 2.0, 4.0}));
  ASSERT_TRUE(lu.factorize({1.0, 0.0, 0.0, 1.0}));  // and is usable afterwards
  double b[2] = {5.0, 7.0};
  lu.solve(b);
  EXPECT_DOUBLE_EQ(b[0], 5.0);
  EXPECT_DOUBLE_EQ(b[1], 7.0);
}

TEST(SparseLu, keepsAnArrowMatrixSparse) {
  // First row, first column and diagonal: eliminating the head first would fill everything.
  const Index n = 30;
  SparsityPattern pattern;
  pattern.size = n;
  pattern.start.push_back(0);
  std::vector<double> values;
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      if (i != j && i != 0 && j != 0) continue;
      pattern.rows.push_back(i);
      values.push_back(i == j ? 10.0 : 1.0);
    }
    pattern.start.push_back(static_cast<Index>(pattern.rows.size()));
  }
  SparseLu lu(pattern);
  ASSERT_TRUE(lu.factorize(values));
  EXPECT_LE(lu.factorNonzeros(), 2 * n);
}

}  // namespace
}  // namespace heerk_rotor
