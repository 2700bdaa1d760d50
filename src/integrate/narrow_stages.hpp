#pragma once
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"
#include "heerk_rotor/integrate/linear_propagator.hpp"

namespace heerk_rotor {

/// result = base + sum over k of column_k values[source_k]: a matrix of few columns, zero columns left out, as sums in registers.
class ColumnSum {
 public:
  ColumnSum() = default;
  explicit ColumnSum(Index rows);
  /// Leaves out a column of zeros.
  void add(const Vector& column, Index source);
  /// base and result: (rows), may be the same.
  void apply(const double* base, const double* values, double* result) const noexcept;

 private:
  template <int N> void applyLanes(Index row, const double* base, const double* values, double* result) const noexcept;

  Index rows_ = 0, pitch_ = 0;  // pitch: rows rounded up to whole cache lines
  std::vector<Index> sources_;
  std::vector<double, Eigen::aligned_allocator<double>> columns_;  // [k][pitch]
};

/// A step of an exponential Runge-Kutta method whose stages carry the z and r of narrow forms (CoupledSystem::stageSize()). With f~ = B r
///   z_i = C e^{c_i hS} x_n + h sum_j (C a_ij(hS) B) r_j,   x_{n+1} = e^{hS} x_n + h sum_j (b_j(hS) B) r_j:
/// all products are tabulated, so a stage costs as much as its z and r are long, and only the step itself touches all states.
class NarrowStages {
 public:
  /// propagators: one per subsystem of the system, null where it has no states; they must outlive this.
  NarrowStages(const CoupledSystem& system, const Tableau& tableau, const std::vector<const LinearPropagator*>& propagators);

  /// z of all stages as far as x_n decides it; call first.
  void begin(const Vector& x) noexcept;
  /// z of stage `row` from the r of the stages before; row 0: of x_n itself.
  const Vector& stage(int row) noexcept;
  /// Where the r of stage `row` belongs.
  double* remainder(int row) noexcept { return r_.data() + row * r_size_; }
  void finish(const Vector& x, Vector& next) const noexcept;

 private:
  struct Part {
    const LinearPropagator* propagator;
    bool narrow;
    Index x_begin, x_size, z_begin, z_size, r_begin;
    ColumnSum free;                  // of x, [node of c][z]
    std::vector<Index> node;         // (stages) which of them a stage takes
    std::vector<ColumnSum> forced;   // (stages) of r
    ColumnSum last;                  // of r, for the step
    Vector free_z;
  };

  int stages_;
  Index r_size_;
  std::vector<Part> parts_;
  Vector x_, z_, r_;  // x_: copy of x_n for parts without narrow form
};

}  // namespace heerk_rotor
