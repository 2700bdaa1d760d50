#include "heerk_rotor/config/problems.hpp"

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

TEST(Problems, writesOneLineWithPlaceKeyValueAndExpectation) {
  Problems problems;
  problems.add({"a.yaml:3", "simulation.step", "-1", "a number > 0 [s]"});
  problems.add({"a.yaml:7", "subsystems.mast.type", "", "one of elastic_mast"});
  problems.add({"b.yaml", "", "no such file", "a file"});
  EXPECT_EQ(problems.text(),
            "a.yaml:3: simulation.step = -1: expected a number > 0 [s]\n"
            "a.yaml:7: subsystems.mast.type = (missing): expected one of elastic_mast\n"
            "b.yaml: no such file: expected a file");
}

TEST(Problems, travelWithTheException) {
  Problems problems;
  EXPECT_TRUE(problems.empty());
  problems.add({"a.yaml:3", "x", "1", "2"});
  const ConfigurationError error(problems);
  EXPECT_EQ(error.what(), problems.text());
  ASSERT_EQ(error.problems.list().size(), 1u);
  EXPECT_EQ(error.problems.list()[0].key, "x");
}

}  // namespace
}  // namespace heerk_rotor
