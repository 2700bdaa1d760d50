#include "row_plan.hpp"

#include <algorithm>

namespace heerk_rotor {
namespace {

bool same(const Coefficient& a, const Coefficient& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const PhiTerm& s, const PhiTerm& t) {
    return s.k == t.k && s.node == t.node && s.weight == t.weight;
  });
}

}  // namespace

RowPlan::RowPlan(const Tableau& tableau) {
  for (int row = 0; row <= tableau.stages(); ++row) {
    const int begin = static_cast<int>(products.size());
    if (row > 0) products.push_back({entryOf({{0, tableau.node(row), 1.0}}, false), kState, kNone});

    for (int column = 0; column < row; ++column) {
      const Coefficient& terms = tableau.rows[row][column];
      if (terms.empty()) continue;
      const int entry = entryOf(terms, true);
      const auto partner = std::find_if(products.begin() + begin, products.end(), [&](const Product& product) {
        return product.entry == entry && product.second == kNone && product.first != kState;
      });
      if (partner != products.end())
        partner->second = column;
      else
        products.push_back({entry, column, kNone});
    }
    rows.push_back({begin, static_cast<int>(products.size())});
  }
}

int RowPlan::highestK(double node) const {
  int highest = 0;
  for (const Entry& entry : entries)
    for (const PhiTerm& term : entry.terms)
      if (term.node == node) highest = std::max(highest, term.k);
  return highest;
}

int RowPlan::entryOf(const Coefficient& terms, bool times_h) {
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i].times_h == times_h && same(entries[i].terms, terms)) return static_cast<int>(i);
  entries.push_back({terms, times_h});
  return static_cast<int>(entries.size()) - 1;
}

}  // namespace heerk_rotor
