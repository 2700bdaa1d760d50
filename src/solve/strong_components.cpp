#include "heerk_rotor/solve/strong_components.hpp"

#include <algorithm>

namespace heerk_rotor {

std::vector<std::vector<Index>> strongComponents(const std::vector<std::vector<Index>>& successors) {
  const auto n = successors.size();
  std::vector<Index> number(n, -1), low(n, 0), stack;
  std::vector<char> on_stack(n, 0);
  std::vector<std::vector<Index>> components;
  Index counter = 0;

  // Depth-first search with an explicit stack of (node, next successor), since graphs may be long chains.
  std::vector<std::pair<Index, std::size_t>> path;
  const auto enter = [&](Index v) {
    number[v] = low[v] = counter++;
    stack.push_back(v);
    on_stack[v] = 1;
    path.push_back({v, 0});
  };
  for (std::size_t root = 0; root < n; ++root) {
    if (number[root] >= 0) continue;
    enter(static_cast<Index>(root));
    while (!path.empty()) {
      const Index v = path.back().first;
      if (path.back().second < successors[v].size()) {
        const Index w = successors[v][path.back().second++];
        if (number[w] < 0) enter(w);
        else if (on_stack[w]) low[v] = std::min(low[v], number[w]);
        continue;
      }
      path.pop_back();
      if (!path.empty()) low[path.back().first] = std::min(low[path.back().first], low[v]);
      if (low[v] != number[v]) continue;
      components.emplace_back();
      Index w;
      do {
        w = stack.back();
        stack.pop_back();
        on_stack[w] = 0;
        components.back().push_back(w);
      } while (w != v);
      std::reverse(components.back().begin(), components.back().end());
    }
  }
  return components;
}

}  // namespace heerk_rotor
