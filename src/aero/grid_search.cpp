#include "heerk_rotor/aero/grid_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace heerk_rotor {

GridSearch::GridSearch(const std::vector<double>& grid) : front_(grid.front()), back_(grid.back()) {
  const int cells = static_cast<int>(grid.size()) - 1;
  double narrowest = back_ - front_;
  for (int i = 0; i < cells; ++i) {
    const double width = grid[i + 1] - grid[i];
    narrowest = std::min(narrowest, width);
    cells_.push_back({grid[i], grid[i + 1], 1.0 / width, width});
  }
  cells_.back().upper = std::numeric_limits<double>::infinity();

  // Buckets as wide as the narrowest cell hold one grid point each; their number is limited for the sake of the cache.
  const int buckets = static_cast<int>(std::min(std::ceil(1.01 * (back_ - front_) / narrowest), 4096.0));
  bucket_scale_ = buckets / (back_ - front_);
  last_bucket_ = buckets - 1;
  // bucket() is monotone in x, rounding included: in bucket b, x lies above all grid points of lower buckets.
  std::vector<int> points(buckets, 0);
  for (int i = 0; i < cells; ++i) ++points[bucket(grid[i])];
  int below = 0;
  for (int b = 0; b < buckets; ++b) {
    first_cell_.push_back(std::max(below - 1, 0));
    comparisons_ = std::max(comparisons_, below == 0 ? points[b] - 1 : points[b]);
    below += points[b];
  }
}

}  // namespace heerk_rotor
