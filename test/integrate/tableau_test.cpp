#include "heerk_rotor/integrate/tableau.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <ostream>
#include <set>
#include <stdexcept>
#include <vector>

namespace heerk_rotor {

inline void PrintTo(const Tableau& tableau, std::ostream* out) { *out << tableau.name; }

namespace {

using Complex = std::complex<long double>;

/// phi_k(z) of a complex number: halve until the series is short, then double.
Complex complexPhi(int k, Complex z) {
  const int halved = std::max(0, static_cast<int>(std::ceil(std::log2(std::abs(z) + 1e-30L))) + 1);
  z = std::ldexp(1.0L, -halved) * z;
  std::vector<Complex> phi(k + 1);
  for (int j = 0; j <= k; ++j)
    for (int i = 30; i >= 0; --i) phi[j] = phi[j] * z + 1 / std::tgamma(static_cast<long double>(i + j + 1));
  for (int n = 0; n < halved; ++n) {
    std::vector<Complex> next(k + 1);
    for (int j = 0; j <= k; ++j) {
      next[j] = phi[0] * phi[j];
      for (int m = 1; m <= j; ++m) next[j] += phi[m] / std::tgamma(static_cast<long double>(j - m + 1));
      next[j] *= std::ldexp(1.0L, -j);
    }
    phi = next;
  }
  return phi[k];
}

Complex value(const Coefficient& coefficient, Complex z) {
  Complex sum = 0;
  for (const PhiTerm& term : coefficient) sum += static_cast<long double>(term.weight) * complexPhi(term.k, static_cast<long double>(term.node) * z);
  return sum;
}

class TableauData : public testing::TestWithParam<Tableau> {};
INSTANTIATE_TEST_SUITE_P(Method, TableauData, testing::ValuesIn(tableaus()), [](const auto& info) { return info.param.name; });

TEST_P(TableauData, isConsistentByItsOwnCheck) { EXPECT_EQ(check(GetParam()), ""); }

TEST_P(TableauData, namesItsSource) { EXPECT_FALSE(GetParam().source.empty()); }

TEST_P(TableauData, rowSumsAreNodeTimesPhi1ForRealAndComplexArguments) {
  const Tableau& t = GetParam();
  std::vector<Complex> arguments = {0.0L};
  if (t.exponential)
    arguments = {0.0L, 1e-6L, -0.7L, 2.0L, -30.0L, -1000.0L, Complex(0, 3), Complex(0, 50), Complex(-2, 5), Complex(-20, -100)};
  for (const Complex z : arguments)
    for (int row = 0; row <= t.stages(); ++row) {
      Complex sum = 0;
      for (const Coefficient& a : t.rows[row]) sum += value(a, z);
      const long double c = t.node(row);
      // Weights are doubles of size <= 18: 1e-14 covers their rounding and that of the series.
      EXPECT_LE(std::abs(sum - c * complexPhi(1, c * z)), 1e-14L) << "row " << row << ", z = " << z;
    }
}

TEST_P(TableauData, satisfiesTheClassicalOrderConditionsWithoutStiffness) {
  const Tableau& t = GetParam();
  const int s = t.stages();
  std::vector<std::vector<double>> a(s + 1, std::vector<double>(s, 0.0));
  for (int i = 0; i <= s; ++i)
    for (int j = 0; j < i; ++j) a[i][j] = static_cast<double>(value(t.rows[i][j], 0.0L).real());
  const std::vector<double>& b = a[s];
  const std::vector<double>& c = t.c;

  // One condition per rooted tree (Hairer, Norsett & Wanner I, table II.2.2).
  std::vector<double> ac(s, 0.0), acc(s, 0.0), aac(s, 0.0);
  for (int i = 0; i < s; ++i)
    for (int j = 0; j < i; ++j) ac[i] += a[i][j] * c[j], acc[i] += a[i][j] * c[j] * c[j];
  for (int i = 0; i < s; ++i)
    for (int j = 0; j < i; ++j) aac[i] += a[i][j] * ac[j];
  const auto sum = [&](auto&& entry) {
    double total = 0.0;
    for (int i = 0; i < s; ++i) total += b[i] * entry(i);
    return total;
  };
  constexpr double kRounding = 1e-14;
  EXPECT_NEAR(sum([&](int) { return 1.0; }), 1.0, kRounding);
  if (t.order >= 2) {
    EXPECT_NEAR(sum([&](int i) { return c[i]; }), 1.0 / 2, kRounding);
  }
  if (t.order >= 3) {
    EXPECT_NEAR(sum([&](int i) { return c[i] * c[i]; }), 1.0 / 3, kRounding);
    EXPECT_NEAR(sum([&](int i) { return ac[i]; }), 1.0 / 6, kRounding);
  }
  if (t.order >= 4) {
    EXPECT_NEAR(sum([&](int i) { return c[i] * c[i] * c[i]; }), 1.0 / 4, kRounding);
    EXPECT_NEAR(sum([&](int i) { return c[i] * ac[i]; }), 1.0 / 8, kRounding);
    EXPECT_NEAR(sum([&](int i) { return acc[i]; }), 1.0 / 12, kRounding);
    EXPECT_NEAR(sum([&](int i) { return aac[i]; }), 1.0 / 24, kRounding);
  }
}

/// Only for matrix arguments and a fixed f~: sum b_j(z) c_j^(q-1)/(q-1)! = phi_q(z), which is what makes an order survive stiffness.
int stiffQuadratureOrder(const Tableau& t) {
  for (int q = 1; q <= 5; ++q)
    for (const Complex z : {Complex(-5), Complex(0, 7), Complex(-100)}) {
      Complex sum = 0;
      for (int j = 0; j < t.stages(); ++j)
        sum += value(t.rows[t.stages()][j], z) * std::pow(static_cast<long double>(t.c[j]), q - 1) / std::tgamma(static_cast<long double>(q));
      if (std::abs(sum - complexPhi(q, z)) > 1e-13L) return q - 1;
    }
  return 5;
}

TEST(Tableau, weightsAreStifflyConsistentToTheKnownOrder) {
  EXPECT_EQ(stiffQuadratureOrder(tableau("HEERK2")), 1);  // the warning in its comment
  EXPECT_EQ(stiffQuadratureOrder(tableau("HEERK3")), 3);
  EXPECT_EQ(stiffQuadratureOrder(tableau("HEERK4")), 3);  // order 4 needs psi_4 = 0 only at z = 0 (Hochbruck & Ostermann 2005, table 2)
  EXPECT_EQ(stiffQuadratureOrder(tableau("ETDRK4")), 3);
}

TEST(Tableau, coxMatthewsFourthStageIsThePrintedProduct) {
  // a_41 = phi_1(z/2)/2 (e^{z/2} - 1), written as phi_1(z) - phi_1(z/2).
  const Tableau& t = tableau("ETDRK4");
  for (const Complex z : {Complex(0), Complex(-3), Complex(1, 4), Complex(-50, 20)})
    EXPECT_LE(std::abs(value(t.rows[3][0], z) - 0.5L * complexPhi(1, 0.5L * z) * (std::exp(0.5L * z) - 1.0L)), 1e-15L);
}

TEST(Tableau, hochbruckOstermannFifthStageIsThePrintedFormula) {
  const Tableau& t = tableau("HEERK4");
  for (const Complex z : {Complex(0), Complex(-3), Complex(1, 4), Complex(-50, 20)}) {
    const Complex a52 = value(t.rows[4][1], z), a54 = value(t.rows[4][3], z);
    EXPECT_LE(std::abs(a54 - (0.25L * complexPhi(2, 0.5L * z) - a52)), 1e-15L);
    EXPECT_LE(std::abs(value(t.rows[4][0], z) - (0.5L * complexPhi(1, 0.5L * z) - 2.0L * a52 - a54)), 1e-15L);
    EXPECT_EQ(value(t.rows[4][2], z), a52);
  }
}

TEST(Tableau, isFoundByNameAndAnUnknownNameListsTheKnownOnes) {
  std::set<std::string> names;
  for (const Tableau& t : tableaus()) {
    EXPECT_EQ(&tableau(t.name), &t);
    names.insert(t.name);
  }
  EXPECT_EQ(names, (std::set<std::string>{"HERK4", "HEERK2", "HEERK3", "HEERK4", "ETDRK4"}));
  try {
    tableau("HEERK5");
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("HEERK5"), std::string::npos);
    for (const std::string& name : names) EXPECT_NE(text.find(name), std::string::npos) << text;
  }
}

TEST(TableauCheck, findsEveryKindOfMistake) {
  const auto broken = [](auto&& change, const char* name = "HEERK3") {
    Tableau t = tableau(name);
    change(t);
    return check(t);
  };
  EXPECT_NE(broken([](Tableau& t) { t.rows[2][1][0].weight += 1e-6; }), "");            // row sum
  EXPECT_NE(broken([](Tableau& t) { t.rows[2][1][0].node = 1.0; }), "");                // the paper's misprint: argument hS instead of c_i hS
  EXPECT_NE(broken([](Tableau& t) { t.rows[2][1][0].node = 0.123; }), "");              // a node that does not exist
  EXPECT_NE(broken([](Tableau& t) { t.rows[1][0][0].k = 9; }), "");                     // no such phi
  EXPECT_NE(broken([](Tableau& t) { t.rows[2].pop_back(); }), "");                      // shape
  EXPECT_NE(broken([](Tableau& t) { t.rows.pop_back(); }), "");                         // no weights
  EXPECT_NE(broken([](Tableau& t) { t.c[0] = 0.1; }), "");                              // first stage not at t_n
  EXPECT_NE(broken([](Tableau& t) { t.c[2] = 1.5; }), "");                              // beyond the step
  EXPECT_NE(broken([](Tableau& t) { t.rows[2][1][0].weight = std::nan(""); }), "");     // not a number
  EXPECT_NE(broken([](Tableau& t) { t.order = 0; }), "");
  EXPECT_NE(broken([](Tableau& t) { t.c.clear(); }), "");
  EXPECT_NE(broken([](Tableau& t) { t.rows[4][0][0].weight *= 2; }, "HERK4"), "");      // classical sum
  EXPECT_NE(broken([](Tableau& t) { t.rows[4][0][0].node = 0.5; }, "HERK4"), "");       // a function in a classical method
}

}  // namespace
}  // namespace heerk_rotor
