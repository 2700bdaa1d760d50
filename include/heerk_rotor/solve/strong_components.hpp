#pragma once
#include <vector>

#include "heerk_rotor/core/types.hpp"

namespace heerk_rotor {

/// Strongly connected components of a directed graph (Tarjan). successors[v] lists what v depends on;
/// a component comes after all components it depends on.
std::vector<std::vector<Index>> strongComponents(const std::vector<std::vector<Index>>& successors);

}  // namespace heerk_rotor
