#include "heerk_rotor/integrate/tableau.hpp"

#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "heerk_rotor/integrate/phi_functions.hpp"

namespace heerk_rotor {
namespace {

constexpr double kWeightError = 1e-14;  // sums of a few weights of size <= 18, each rounded once

/// The classical entry "a number": phi_0(0) = 1.
Coefficient number(double value) { return {{0, 0.0, value}}; }

// clang-format off

/// Classical fourth-order method, integrates the complete f.
Tableau herk4() {
  return {"HERK4", 4, "Kutta 1901; half-explicit: HEERK paper eq. (2)", false,
          {0.0, 0.5, 0.5, 1.0},
          {{},
           {number(1.0 / 2)},
           {{}, number(1.0 / 2)},
           {{}, {}, number(1.0)},
           {number(1.0 / 6), number(1.0 / 3), number(1.0 / 3), number(1.0 / 6)}}};
}

/// Weights (1/2, 1/2) phi_1 are not stiffly consistent: behind a stiff oscillator (h omega >> 1) even a smooth solution is followed to
/// first order only, and near a resonance with errors of order one. Use it where h S is moderate.
Tableau heerk2() {
  return {"HEERK2", 2, "HEERK paper, Appendix B", true,
          {0.0, 1.0},
          {{},
           {{{1, 1.0, 1.0}}},
           {{{1, 1.0, 0.5}}, {{1, 1.0, 0.5}}}}};
}

/// Printed with phi_1 and phi_2 at other arguments in the stages, which is of order 2: stage i needs them at its own node.
/// (The EXPINT package's etd2cf3 has phi_1(z/2) in a_21 and violates the row sum likewise.)
Tableau heerk3() {
  constexpr double c2 = 1.0 / 3, c3 = 2.0 / 3;
  return {"HEERK3", 3, "ETD2CF3; HEERK paper, Appendix B, arguments and b_1 corrected", true,
          {0.0, c2, c3},
          {{},
           {{{1, c2, 1.0 / 3}}},
           {{{1, c3, 2.0 / 3}, {2, c3, -4.0 / 3}}, {{2, c3, 4.0 / 3}}},
           {{{1, 1.0, 1.0}, {2, 1.0, -9.0 / 2}, {3, 1.0, 9.0}},
            {{2, 1.0, 6.0}, {3, 1.0, -18.0}},
            {{2, 1.0, -3.0 / 2}, {3, 1.0, 9.0}}}}};
}

/// Stiff order four. a_51 = phi_1(z/2)/2 - 2 a_52 - a_54 and a_54 = phi_2(z/2)/4 - a_52 are written out.
Tableau heerk4() {
  constexpr double c = 0.5;
  const Coefficient a42 = {{2, 1.0, 1.0}};
  const Coefficient a52 = {{2, c, 1.0 / 2}, {3, 1.0, -1.0}, {2, 1.0, 1.0 / 4}, {3, c, -1.0 / 2}};
  const Coefficient a54 = {{2, c, -1.0 / 4}, {3, 1.0, 1.0}, {2, 1.0, -1.0 / 4}, {3, c, 1.0 / 2}};
  const Coefficient a51 = {{1, c, 1.0 / 2}, {2, c, -3.0 / 4}, {3, 1.0, 1.0}, {2, 1.0, -1.0 / 4}, {3, c, 1.0 / 2}};
  return {"HEERK4", 4, "Hochbruck & Ostermann, SIAM J. Numer. Anal. 43 (2005) 1069, five stages", true,
          {0.0, c, c, 1.0, c},
          {{},
           {{{1, c, 1.0 / 2}}},
           {{{1, c, 1.0 / 2}, {2, c, -1.0}}, {{2, c, 1.0}}},
           {{{1, 1.0, 1.0}, {2, 1.0, -2.0}}, a42, a42},
           {a51, a52, a52, a54},
           {{{1, 1.0, 1.0}, {2, 1.0, -3.0}, {3, 1.0, 4.0}},
            {},
            {},
            {{2, 1.0, -1.0}, {3, 1.0, 4.0}},
            {{2, 1.0, 4.0}, {3, 1.0, -8.0}}}}};
}

/// Printed with a_41 = phi_1(z/2)/2 (e^{z/2} - 1); since phi_1(z) = phi_1(z/2) (e^{z/2} + 1)/2, that is phi_1(z) - phi_1(z/2).
/// Its order drops to about 2.7 on parabolic problems: here as the control.
Tableau etdrk4() {
  constexpr double c = 0.5;
  const Coefficient b2 = {{2, 1.0, 2.0}, {3, 1.0, -4.0}};
  return {"ETDRK4", 4, "Cox & Matthews, J. Comput. Phys. 176 (2002) 430, ETD4RK", true,
          {0.0, c, c, 1.0},
          {{},
           {{{1, c, 1.0 / 2}}},
           {{}, {{1, c, 1.0 / 2}}},
           {{{1, 1.0, 1.0}, {1, c, -1.0}}, {}, {{1, c, 1.0}}},
           {{{1, 1.0, 1.0}, {2, 1.0, -3.0}, {3, 1.0, 4.0}}, b2, b2, {{2, 1.0, -1.0}, {3, 1.0, 4.0}}}}};
}

// clang-format on

bool known(double node, const Tableau& tableau) {
  if (node == 1.0) return true;
  for (double c : tableau.c)
    if (node == c && node != 0.0) return true;
  return false;
}

std::string checkTerms(const Tableau& tableau, int row, const Coefficient& coefficient) {
  std::ostringstream wrong;
  for (const PhiTerm& term : coefficient) {
    if (term.k < 0 || term.k > kMaxPhi)
      wrong << "row " << row << ": phi_" << term.k << ", expected k in 0.." << kMaxPhi << "; ";
    if (tableau.exponential && !known(term.node, tableau))
      wrong << "row " << row << ": phi_" << term.k << " at node " << term.node << ", which is neither one of c nor 1; ";
    if (!tableau.exponential && term.node != 0.0)
      wrong << "row " << row << ": phi_" << term.k << " at node " << term.node << ", a classical method has numbers (node 0); ";
  }
  return wrong.str();
}

/// sum_j a_ij = c_i phi_1(c_i z) for every z, term by term: the phi_k(node z) are linearly independent functions of z.
/// A classical row is a plain sum of numbers.
std::string checkSum(const Tableau& tableau, int row) {
  std::map<std::pair<int, double>, double> rest;
  for (const Coefficient& coefficient : tableau.rows[row])
    for (const PhiTerm& term : coefficient) rest[{term.k, term.node}] += term.weight;
  const double node = tableau.node(row);
  if (tableau.exponential) {
    if (node != 0.0) rest[{1, node}] -= node;
  } else {
    double sum = 0.0;
    for (const auto& [function, weight] : rest) sum += weight / std::tgamma(function.first + 1.0);
    rest = {{{0, 0.0}, sum - node}};
  }

  std::ostringstream wrong;
  for (const auto& [function, weight] : rest)
    if (!(std::abs(weight) <= kWeightError))
      wrong << "row " << row << ": sum_j a_ij - c_i phi_1(c_i z) keeps " << weight << " phi_" << function.first << "("
            << function.second << " z); ";
  return wrong.str();
}

}  // namespace

const std::vector<Tableau>& tableaus() {
  static const std::vector<Tableau> all = {herk4(), heerk2(), heerk3(), heerk4(), etdrk4()};
  return all;
}

const Tableau& tableau(const std::string& name) {
  std::string names;
  for (const Tableau& candidate : tableaus()) {
    if (candidate.name == name) return candidate;
    names += (names.empty() ? "" : ", ") + candidate.name;
  }
  throw std::invalid_argument("integrator '" + name + "': unknown, expected one of " + names);
}

std::string check(const Tableau& tableau) {
  std::ostringstream wrong;
  const int s = tableau.stages();

  // Shape first: nothing below may index past it.
  if (s == 0) return "no stages";
  if (static_cast<int>(tableau.rows.size()) != s + 1) {
    wrong << tableau.rows.size() << " rows, expected " << s + 1 << " (stages and weights)";
    return wrong.str();
  }
  for (int row = 0; row <= s; ++row)
    if (static_cast<int>(tableau.rows[row].size()) != row)
      wrong << "row " << row << " has " << tableau.rows[row].size() << " entries, expected " << row << "; ";
  if (!wrong.str().empty()) return wrong.str();

  // Then values: nodes, terms, row sums.
  if (tableau.order < 1) wrong << "order " << tableau.order << ", expected >= 1; ";
  if (tableau.c[0] != 0.0) wrong << "c_1 = " << tableau.c[0] << ", expected 0 (the first stage is at t_n); ";
  for (double c : tableau.c)
    if (!(c >= 0.0 && c <= 1.0)) wrong << "node " << c << " outside [0, 1]; ";
  for (int row = 0; row <= s; ++row) {
    for (const Coefficient& coefficient : tableau.rows[row]) wrong << checkTerms(tableau, row, coefficient);
    wrong << checkSum(tableau, row);
  }
  return wrong.str();
}

}  // namespace heerk_rotor
