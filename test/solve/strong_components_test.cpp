#include "heerk_rotor/solve/strong_components.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

TEST(StrongComponents, putsDependenciesFirstAndKeepsCyclesTogether) {
  // 0 -> 1 <-> 2 -> 3, 4 alone with a loop on itself
  const auto components = strongComponents({{1}, {2}, {1, 3}, {}, {4}});
  ASSERT_EQ(components.size(), 4u);
  const auto place = [&](Index v) {
    return std::find_if(components.begin(), components.end(), [&](const auto& c) { return std::find(c.begin(), c.end(), v) != c.end(); }) - components.begin();
  };
  EXPECT_EQ(place(1), place(2));
  EXPECT_LT(place(3), place(1));
  EXPECT_LT(place(1), place(0));
}

TEST(StrongComponents, survivesAChainOfAMillion) {
  std::vector<std::vector<Index>> chain(1000000);
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) chain[i].push_back(static_cast<Index>(i + 1));
  EXPECT_EQ(strongComponents(chain).size(), chain.size());
}

}  // namespace
}  // namespace heerk_rotor
