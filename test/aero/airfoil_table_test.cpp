#include "heerk_rotor/aero/airfoil_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "aero/shipped_deck.hpp"
#include "models/allocation_counter.hpp"

namespace heerk_rotor {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr TableInterpolation kBoth[] = {TableInterpolation::kLinear, TableInterpolation::kMonotoneCubic};

C81Block block(std::vector<double> alpha_deg, std::vector<double> mach, unsigned seed, bool closed = true) {
  C81Block result{std::move(mach), std::move(alpha_deg), {}};
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  const std::size_t n = result.alpha_deg.size(), m = result.mach.size();
  for (std::size_t i = 0; i < n * m; ++i) result.values.push_back(value(random));
  if (closed)
    for (std::size_t j = 0; j < m; ++j) result.value(n - 1, j) = result.value(0, j);
  return result;
}

/// Three blocks with grids that share few points; some nearly coincide.
C81Deck randomDeck(unsigned seed) {
  return {"random",
          block({-180, -120, -33.3, -5, 0, 4.99, 5, 12, 90, 180}, {0, 0.3, 0.7, 0.9}, seed),
          block({-180, -90, -5.001, 0, 5, 7, 180}, {0.1, 0.31, 0.7}, seed + 1),
          block({-180, -33, -1, 0, 1, 2, 3, 170, 179.9, 180}, {0.5}, seed + 2)};
}

C81Deck partialDeck(unsigned seed) {
  return {"partial", block({-20, -10, 0, 7, 15}, {0.2, 0.6}, seed, false), block({-12, 0, 9, 18}, {0.2, 0.5, 0.8}, seed + 1, false),
          block({-15, 0, 15}, {0, 1}, seed + 2, false)};
}

/// One block read by itself, the way a textbook does it: the plain reference for the joint table.
double direct(const C81Block& b, double alpha_deg, double mach) {
  const auto place = [](const std::vector<double>& grid, double x, std::size_t& i) {
    i = 0;
    if (grid.size() == 1) return 0.0;
    x = std::min(std::max(x, grid.front()), grid.back());
    while (i + 2 < grid.size() && x >= grid[i + 1]) ++i;
    return (x - grid[i]) / (grid[i + 1] - grid[i]);
  };
  std::size_t i, j;
  const double s = place(b.alpha_deg, alpha_deg, i), q = place(b.mach, mach, j);
  const std::size_t next = b.mach.size() == 1 ? j : j + 1;
  return (1 - q) * ((1 - s) * b.value(i, j) + s * b.value(i + 1, j)) + q * ((1 - s) * b.value(i, next) + s * b.value(i + 1, next));
}

TEST(AirfoilTable, jointGridIsExactlyEachBlocksOwnInterpolant) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> alpha_deg(-180.0, 180.0), mach(-0.1, 1.1);
  for (const C81Deck& deck : {randomDeck(1), partialDeck(5), test::shippedDeck()}) {
    const AirfoilTable table(deck);
    for (int n = 0; n < 20000; ++n) {
      const double a = n % 2 ? alpha_deg(random) : 0.1 * alpha_deg(random), m = mach(random);
      const AirfoilTable::Coefficients c = table.at(a * kDegree, m);
      // Rounding of alpha (4e-16 rad x slopes up to 2 per 0.001 deg = 1e5 per rad) is part of the 1e-10 near the narrow cells.
      const double tolerance = (a > -5.1 && a < -4.9) || (a > 4.98 && a < 5.01) ? 1e-10 : 1e-13;
      ASSERT_NEAR(c.lift, direct(deck.lift, a, m), tolerance) << a << " deg, Mach " << m;
      ASSERT_NEAR(c.drag, direct(deck.drag, a, m), tolerance) << a << " deg, Mach " << m;
      ASSERT_NEAR(c.moment, direct(deck.moment, a, m), tolerance) << a << " deg, Mach " << m;
    }
  }
}

TEST(AirfoilTable, jointGridAgreesWithShippedBlocksTo1em14) {
  C81Deck deck = test::shippedDeck();
  // Coarser grids for drag and moment, so that the union is not trivial.
  const auto thin = [](const C81Block& full, std::size_t every) {
    C81Block b{full.mach, {}, {}};
    for (std::size_t i = 0; i < full.alpha_deg.size(); ++i)
      if (i % every == 0 || i + 1 == full.alpha_deg.size()) {
        b.alpha_deg.push_back(full.alpha_deg[i]);
        for (std::size_t j = 0; j < full.mach.size(); ++j) b.values.push_back(full.value(i, j));
      }
    return b;
  };
  deck.drag = thin(deck.drag, 2);
  deck.moment = thin(deck.moment, 3);
  const AirfoilTable table(deck);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> alpha_deg(-30.0, 30.0), mach(0.0, 1.0);
  double worst = 0.0;
  for (int n = 0; n < 20000; ++n) {
    const double a = alpha_deg(random), m = mach(random);
    const AirfoilTable::Coefficients c = table.at(a * kDegree, m);
    for (double error : {c.lift - direct(deck.lift, a, m), c.drag - direct(deck.drag, a, m), c.moment - direct(deck.moment, a, m)})
      worst = std::max(worst, std::abs(error));
  }
  EXPECT_LE(worst, 1e-14);
}

TEST(AirfoilTable, gridPointsAreReproduced) {
  for (TableInterpolation interpolation : kBoth) {
    const C81Deck deck = test::shippedDeck();
    const AirfoilTable table(deck, interpolation);
    EXPECT_TRUE(table.periodic());
    for (std::size_t i = 0; i < deck.lift.alpha_deg.size(); ++i)
      for (std::size_t j = 0; j < deck.lift.mach.size(); ++j) {
        const AirfoilTable::Coefficients c = table.at(deck.lift.alpha_deg[i] * kDegree, deck.lift.mach[j]);
        ASSERT_NEAR(c.lift, deck.lift.value(i, j), 1e-14);
        ASSERT_NEAR(c.drag, deck.drag.value(i, j), 1e-14);
        ASSERT_NEAR(c.moment, deck.moment.value(i, j), 1e-14);
      }
  }
}

TEST(AirfoilTable, isContinuousAtCellBordersAndAtHalfATurn) {
  for (TableInterpolation interpolation : kBoth)
    for (const C81Deck& deck : {randomDeck(9), test::shippedDeck()}) {
      const AirfoilTable table(deck, interpolation);
      std::vector<double> borders;
      for (const C81Block* b : {&deck.lift, &deck.drag, &deck.moment}) borders.insert(borders.end(), b->alpha_deg.begin(), b->alpha_deg.end());
      const double step = 1e-12;  // rad; slopes stay below 1e5 per rad
      for (double border : borders)
        for (double mach : {0.0, 0.3, 0.55, 0.7, 1.0}) {
          const auto below = table.at(border * kDegree - step, mach), above = table.at(border * kDegree + step, mach);
          ASSERT_NEAR(below.lift, above.lift, 1e-6) << border;
          ASSERT_NEAR(below.drag, above.drag, 1e-6) << border;
          ASSERT_NEAR(below.moment, above.moment, 1e-6) << border;
        }
      for (double mach : deck.lift.mach) {
        const auto below = table.at(0.05, mach - 1e-12), above = table.at(0.05, mach + 1e-12);
        ASSERT_NEAR(below.lift, above.lift, 1e-9);
      }
    }
}

TEST(AirfoilTable, repeatsEveryTurn) {
  for (TableInterpolation interpolation : kBoth) {
    const AirfoilTable table(test::shippedDeck(), interpolation);
    for (double alpha : {-3.1, -0.2, 0.07, 1.5, 3.0})
      for (int turns : {-2, -1, 1, 3}) EXPECT_NEAR(table.at(alpha + 2.0 * M_PI * turns, 0.42).lift, table.at(alpha, 0.42).lift, 1e-13);
  }
}

TEST(AirfoilTable, holdsTheEndsOfAPartialDeckAndOfMach) {
  for (TableInterpolation interpolation : kBoth) {
    const C81Deck deck = partialDeck(2);
    const AirfoilTable table(deck, interpolation);
    EXPECT_FALSE(table.periodic());
    EXPECT_NEAR(table.at(3.0, 0.1).lift, deck.lift.value(4, 0), 1e-15);
    EXPECT_NEAR(table.at(-1.0, 5.0).lift, deck.lift.value(0, 1), 1e-15);
    EXPECT_NEAR(table.at(-17.0 * kDegree, 0.2).drag, deck.drag.value(0, 0), 1e-15);  // inside lift's range, outside drag's
    EXPECT_NEAR(table.at(4.0, 0.9).moment, table.at(15.0 * kDegree, 0.9).moment, 1e-15);
  }
}

TEST(AirfoilTable, cubicHasAContinuousDerivative) {
  for (const C81Deck& deck : {randomDeck(21), partialDeck(4), test::shippedDeck()}) {
    const AirfoilTable table(deck, TableInterpolation::kMonotoneCubic);
    const auto slope = [&](double alpha, double mach, double step) {  // one-sided, second order
      const double f0 = table.at(alpha, mach).lift, f1 = table.at(alpha + step, mach).lift, f2 = table.at(alpha + 2 * step, mach).lift;
      return (4.0 * f1 - f2 - 3.0 * f0) / (2.0 * step);
    };
    const std::vector<double>& grid = deck.lift.alpha_deg;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      // A cubic through data of size 1 has third derivatives of up to 24/width^3, so the formula errs by 8 step^2/width^3;
      // with step = 1e-4 width the error is below 1e-7/width, rounding below 1e-11/width.
      const double width = kDegree * std::min(i > 0 ? grid[i] - grid[i - 1] : 360.0, i + 1 < grid.size() ? grid[i + 1] - grid[i] : 360.0);
      for (double mach : {0.1, 0.33, 0.66}) {
        const double left = slope(grid[i] * kDegree, mach, -1e-4 * width), right = slope(grid[i] * kDegree, mach, 1e-4 * width);
        ASSERT_NEAR(left, right, 1e-6 / width) << grid[i] << " deg";
      }
    }
  }
}

TEST(AirfoilTable, cubicDoesNotOvershoot) {
  const C81Deck deck = randomDeck(33);
  const AirfoilTable table(deck, TableInterpolation::kMonotoneCubic);
  for (std::size_t i = 0; i + 1 < deck.lift.alpha_deg.size(); ++i) {
    const double a = deck.lift.value(i, 1), b = deck.lift.value(i + 1, 1);
    double last = a;
    for (int n = 0; n <= 100; ++n) {
      const double value = table.at((deck.lift.alpha_deg[i] + 0.01 * n * (deck.lift.alpha_deg[i + 1] - deck.lift.alpha_deg[i])) * kDegree, 0.3).lift;
      ASSERT_GE((value - last) * (b - a), -1e-13) << i << " " << n;  // monotone between its ends
      last = value;
    }
  }
}

TEST(AirfoilTable, cubicFollowsASmoothCurveFarCloserThanLinear) {
  C81Deck deck = test::shippedDeck();
  C81Block sine{{0.0, 1.0}, {}, {}};
  for (int i = 0; i <= 72; ++i) {
    sine.alpha_deg.push_back(-180.0 + 5.0 * i);
    const double value = i == 72 || i == 0 ? 0.0 : std::sin(sine.alpha_deg.back() * kDegree);
    sine.values.insert(sine.values.end(), {value, value});
  }
  deck.lift = sine;
  const AirfoilTable linear(deck), cubic(deck, TableInterpolation::kMonotoneCubic);
  // away from the extrema, where PCHIP is third order: h^3 = (0.087)^3 = 7e-4 times a small factor; linear h^2/8 = 9.5e-4
  double linear_error = 0.0, cubic_error = 0.0;
  for (double alpha = -1.2; alpha < 1.2; alpha += 0.001) {
    linear_error = std::max(linear_error, std::abs(linear.at(alpha, 0.5).lift - std::sin(alpha)));
    cubic_error = std::max(cubic_error, std::abs(cubic.at(alpha, 0.5).lift - std::sin(alpha)));
  }
  EXPECT_NEAR(linear_error, 0.0873 * 0.0873 / 8.0, 2e-4);
  EXPECT_LT(cubic_error, 0.2 * linear_error);
}

TEST(AirfoilTable, naca0012IsAntisymmetric) {
  for (TableInterpolation interpolation : kBoth) {
    const AirfoilTable shipped(test::shippedDeck(), interpolation), exact(test::symmetricDeck(), interpolation);
    for (double alpha = 0.0; alpha < 3.14; alpha += 0.0173)
      for (double mach : {0.0, 0.37, 0.72, 0.95}) {
        // Negative numbers have three decimals in the shipped deck (seven columns), positive ones four: half a unit of the third,
        // doubled by the slopes of the cubic.
        const double rounding = interpolation == TableInterpolation::kLinear ? 5.01e-4 : 1e-3;
        const auto up = shipped.at(alpha, mach), down = shipped.at(-alpha, mach);
        ASSERT_NEAR(up.lift, -down.lift, rounding) << alpha;
        ASSERT_NEAR(up.drag, down.drag, 1e-13) << alpha;
        ASSERT_NEAR(up.moment, -down.moment, rounding) << alpha;
        ASSERT_NEAR(exact.at(alpha, mach).lift, -exact.at(-alpha, mach).lift, 1e-13) << alpha;
        ASSERT_NEAR(exact.at(alpha, mach).moment, -exact.at(-alpha, mach).moment, 1e-13) << alpha;
      }
  }
}

TEST(AirfoilTable, blendIsLinearInTheShare) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> alpha(-3.0, 3.0), mach(0.0, 1.0);
  for (TableInterpolation interpolation : kBoth) {
    const C81Deck inner = randomDeck(40), outer = test::shippedDeck();
    const AirfoilTable a(inner, interpolation), b(outer, interpolation);
    for (double share : {0.0, 0.25, 1.0}) {
      const AirfoilTable blend(inner, outer, share, interpolation);
      for (int n = 0; n < 2000; ++n) {
        const double x = alpha(random), m = mach(random);
        // narrow cells of the random deck amplify the rounding of alpha
        ASSERT_NEAR(blend.at(x, m).lift, (1 - share) * a.at(x, m).lift + share * b.at(x, m).lift, 1e-11);
        ASSERT_NEAR(blend.at(x, m).moment, (1 - share) * a.at(x, m).moment + share * b.at(x, m).moment, 1e-11);
      }
    }
  }
  EXPECT_THROW(AirfoilTable(randomDeck(1), randomDeck(2), 1.5), std::invalid_argument);
}

template <int N>
void expectLanesLikeScalar(const AirfoilTable& table) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> alpha(-7.0, 7.0), mach(-0.2, 1.3);
  for (int n = 0; n < 5000; ++n) {
    Lanes<N> a, m, lift, drag, moment;
    for (int k = 0; k < N; ++k) {
      a[k] = alpha(random);
      m[k] = mach(random);
    }
    table.at(a, m, lift, drag, moment);
    for (int k = 0; k < N; ++k) {
      const auto c = table.at(a[k], m[k]);
      // the same arithmetic except for fused multiply-adds, which the compiler may place differently
      ASSERT_NEAR(lift[k], c.lift, 2e-13);
      ASSERT_NEAR(drag[k], c.drag, 2e-13);
      ASSERT_NEAR(moment[k], c.moment, 2e-13);
    }
  }
}

TEST(AirfoilTable, lanesGiveWhatOneLookupGives) {
  for (TableInterpolation interpolation : kBoth) {
    expectLanesLikeScalar<4>(AirfoilTable(test::shippedDeck(), interpolation));
    expectLanesLikeScalar<8>(AirfoilTable(test::shippedDeck(), interpolation));
    expectLanesLikeScalar<8>(AirfoilTable(partialDeck(3), interpolation));
  }
}

TEST(AirfoilTable, passesNotANumberOnWithoutLeavingTheTable) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (TableInterpolation interpolation : kBoth) {
    for (const C81Deck& deck : {test::shippedDeck(), partialDeck(3)}) {
      const AirfoilTable table(deck, interpolation);
      EXPECT_TRUE(std::isnan(table.at(nan, 0.5).lift));
      EXPECT_TRUE(std::isnan(table.at(0.1, nan).drag));
      // infinite: the wrapped angle is undefined where the table is periodic, otherwise the end value
      EXPECT_EQ(std::isnan(table.at(std::numeric_limits<double>::infinity(), 0.5).lift), table.periodic());
      EXPECT_TRUE(std::isfinite(table.at(0.1, 1e300).drag));
    }
  }
}

TEST(AirfoilTable, findsCellsInConstantTimeOnAnyGrid) {
  std::vector<double> grid{0.0, 1e-9, 2e-9, 0.5, 0.5 + 1e-12, 7.0, 1000.0};
  const GridSearch search(grid);
  std::vector<double> probes = grid;
  for (double x : grid) probes.insert(probes.end(), {std::nextafter(x, -1e9), std::nextafter(x, 1e9)});
  for (double x = 0.0; x < 1000.0; x += 0.37) probes.push_back(x);
  for (double x : probes) {
    const double inside = std::min(std::max(x, 0.0), 1000.0);
    int expected = 0;
    while (expected < 5 && inside >= grid[expected + 1]) ++expected;
    EXPECT_EQ(search.find<1>({{x}}).cell[0], expected) << x;
  }
}

TEST(AirfoilTable, refusesDecksThatAreNotOne) {
  C81Deck deck = partialDeck(1);
  deck.lift.values.pop_back();
  EXPECT_THROW(AirfoilTable{deck}, std::invalid_argument);
  deck = partialDeck(1);
  std::swap(deck.drag.alpha_deg[0], deck.drag.alpha_deg[1]);
  EXPECT_THROW(AirfoilTable{deck}, std::invalid_argument);
  EXPECT_THROW(AirfoilTable{C81Deck()}, std::invalid_argument);
}

TEST(AirfoilTable, doesNotAllocateInEvaluation) {
  if (!test::heapIsCounted()) GTEST_SKIP() << "the heap cannot be counted in this build";
  const AirfoilTable table(test::shippedDeck(), TableInterpolation::kMonotoneCubic);
  Lanes<4> alpha{{0.1, 0.2, -0.1, 3.0}}, mach{{0.2, 0.3, 0.4, 0.5}}, lift, drag, moment;
  const test::HeapCalls heap;
  for (int n = 0; n < 100; ++n) table.at(alpha, mach, lift, drag, moment);
  EXPECT_EQ(heap.count(), 0u);
}

}  // namespace
}  // namespace heerk_rotor
