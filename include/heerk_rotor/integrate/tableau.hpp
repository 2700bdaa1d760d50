#pragma once
#include <string>
#include <vector>

namespace heerk_rotor {

/// One term weight * phi_k(node * h S) of a Runge-Kutta coefficient.
struct PhiTerm {
  int k;
  double node;
  double weight;
};

/// A Runge-Kutta coefficient a_ij(hS) or b_j(hS); no terms means zero.
using Coefficient = std::vector<PhiTerm>;

/// An explicit (exponential) Runge-Kutta method as data.
/// With S = 0 every phi_k is 1/k!, so the same table is the classical method that the exponential one reduces to.
/// Row i < s is stage i, row s holds the weights b:
///   X_i = e^{c_i hS} x_n + h sum_j a_ij(hS) f~(t_n + c_j h, X_j, Y_j),  c_s = 1.
/// This equals eq. (6) of the HEERK paper because sum_j a_ij = c_i phi_1(c_i hS), which `check` verifies.
struct Tableau {
  std::string name;
  int order;
  std::string source;
  bool exponential;                              // false: the method ignores S and integrates the complete f
  std::vector<double> c;                         // (s) nodes
  std::vector<std::vector<Coefficient>> rows;    // (s + 1) rows; row i has i entries, row s has s

  int stages() const { return static_cast<int>(c.size()); }
  double node(int row) const { return row < stages() ? c[row] : 1.0; }
};

/// All known methods: HERK4, HEERK2, HEERK3, HEERK4, ETDRK4.
const std::vector<Tableau>& tableaus();

/// The method of that name; throws std::invalid_argument that lists the known names.
const Tableau& tableau(const std::string& name);

/// Empty when the table is consistent, otherwise what is wrong (row sums, shape, node values).
std::string check(const Tableau& tableau);

}  // namespace heerk_rotor
