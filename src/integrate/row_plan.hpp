#pragma once
#include <algorithm>
#include <vector>

#include "heerk_rotor/core/types.hpp"
#include "heerk_rotor/integrate/tableau.hpp"

namespace heerk_rotor {

/// A tableau rewritten as what `combine` has to multiply: every distinct coefficient once, zeros gone.
struct RowPlan {
  static constexpr int kState = -1;  // column of x itself
  static constexpr int kNone = -2;   // no second column

  /// A matrix that has to be tabulated: sum weight * phi_k(node * h S), times h unless it propagates the state.
  struct Entry {
    Coefficient terms;
    bool times_h;
  };
  /// matrix[entry] * (column first + column second): a coefficient that stands twice in a row is applied to the sum.
  struct Product {
    int entry;
    int first;
    int second;
  };
  struct Row {
    int begin;  // products [begin, end); none: the row is x itself
    int end;
  };

  /// The arguments of `combine` as columns.
  struct Columns {
    const double* x;
    const double* remainders;
    Index stride;
    const double* first(const Product& product) const { return product.first == kState ? x : remainders + product.first * stride; }
    const double* second(const Product& product) const { return product.second == kNone ? nullptr : remainders + product.second * stride; }
  };

  std::vector<Entry> entries;
  std::vector<Product> products;
  std::vector<Row> rows;

  explicit RowPlan(const Tableau& tableau);

  /// The row without remainders: its first product propagates the state.
  Row stateOf(int row) const { return {rows[row].begin, std::min(rows[row].begin + 1, rows[row].end)}; }

  /// Largest k of the phi_k needed at this node.
  int highestK(double node) const;

 private:
  int entryOf(const Coefficient& terms, bool times_h);
};

}  // namespace heerk_rotor
