#include "heerk_rotor/tools/sweep.hpp"

#include <gtest/gtest.h>

#include "test_files.hpp"

namespace heerk_rotor {
namespace {

using Words = std::vector<std::string>;

Words valuesOf(const std::string& text) {
  Problems problems;
  const SweepAxis axis = parseSweepAxis(text, problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  Words values;
  for (const Words& point : axis.points) values.push_back(point.front());
  return values;
}

SimulateOptions sweeping(const Words& sweeps, const Words& overrides = {}) {
  SimulateOptions options;
  options.sweeps = sweeps;
  options.overrides = overrides;
  return options;
}

/// What readSweep() says about it.
std::string complaint(const SimulateOptions& options) {
  try {
    readSweep(options);
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "";
}

TEST(Sweep, aListKeepsItsValuesAsWritten) {
  EXPECT_EQ(valuesOf("a.b=3e4,3.0e+6,-1"), (Words{"3e4", "3.0e+6", "-1"}));
  EXPECT_EQ(valuesOf("a.b=one"), Words{"one"});
}

TEST(Sweep, bracketsAndQuotesKeepCommasAndColons) {
  EXPECT_EQ(valuesOf("a=[1, 2],{x: 1, y: 2},\"3:4,5\""), (Words{"[1, 2]", "{x: 1, y: 2}", "\"3:4,5\""}));
}

TEST(Sweep, aRangeHasBothEndsAndShortNumbersBetween) {
  EXPECT_EQ(valuesOf("a=0:1:11"), (Words{"0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1"}));
  EXPECT_EQ(valuesOf("a=1e-5:-1e-5:2"), (Words{"1e-5", "-1e-5"}));
}

TEST(Sweep, aLogarithmicRangeHasEqualRatios) {
  EXPECT_EQ(valuesOf("a=3e4:3e8:5:log"), (Words{"3e4", "300000", "3000000", "30000000", "3e8"}));
  EXPECT_EQ(valuesOf("a=-1:-4:3:log"), (Words{"-1", "-2", "-4"}));
}

TEST(Sweep, rangesAndValuesMixInOneList) { EXPECT_EQ(valuesOf("a=0:2:3,10"), (Words{"0", "1", "2", "10"})); }

TEST(Sweep, theLastAxisVariesFastest) {
  const Sweep sweep = readSweep(sweeping({"a=1,2", "b.c=x,y,z"}));
  ASSERT_EQ(sweep.size(), 6u);
  EXPECT_EQ(sweep.keys(), (Words{"a", "b.c"}));
  EXPECT_EQ(sweep.values(0), (Words{"1", "x"}));
  EXPECT_EQ(sweep.values(1), (Words{"1", "y"}));
  EXPECT_EQ(sweep.values(3), (Words{"2", "x"}));
  EXPECT_EQ(sweep.overrides(5), (Words{"a=2", "b.c=z"}));
}

TEST(Sweep, aFileIsTheOutermostAxis) {
  const TestFolder folder;
  SimulateOptions options = sweeping({"c=7,8"});
  options.sweep_file = folder.write("runs.csv", "a,b\n1,\n,2\n");
  const Sweep sweep = readSweep(options);
  ASSERT_EQ(sweep.size(), 4u);
  EXPECT_EQ(sweep.overrides(1), (Words{"a=1", "c=8"})) << "an empty cell sets nothing";
  EXPECT_EQ(sweep.overrides(2), (Words{"b=2", "c=7"}));
  EXPECT_EQ(sweep.firstRunWith(0), 0u);
  EXPECT_EQ(sweep.firstRunWith(1), 2u) << "key b is set from the file's second row on";
}

TEST(Sweep, everyMistakeIsSaidWithPlaceFoundAndExpected) {
  const std::vector<std::pair<Words, Words>> cases = {
      {{"a.b"}, {"--sweep: 'a.b'", "KEY=VALUE,VALUE"}},
      {{"=1,2"}, {"'=1,2'", "KEY=VALUE"}},
      {{"a.b="}, {"--sweep a.b: a.b = (empty)", "at least one value"}},
      {{"a.b=1,,2"}, {"a.b = 1,,2", "single commas"}},
      {{"a.b=1,2,"}, {"a.b = 1,2,", "single commas"}},
      {{"a.b=1:2"}, {"a.b = 1:2", "FROM:TO:COUNT"}},
      {{"a.b=1:2:3:log:5"}, {"FROM:TO:COUNT"}},
      {{"a.b=x:2:3"}, {"a.b = x:2:3", "beginning", "'x'"}},
      {{"a.b=1:0x10:3"}, {"end", "'0x10'"}},
      {{"a.b=1:2:1"}, {"a.b = 1:2:1", "from 2 to 1000000", "'1'"}},
      {{"a.b=1:2:0"}, {"from 2 to"}},
      {{"a.b=1:2:-3"}, {"from 2 to", "'-3'"}},
      {{"a.b=1:2:2.5"}, {"from 2 to", "'2.5'"}},
      {{"a.b=1:2:99999999999999999999999"}, {"from 2 to"}},
      {{"a.b=1:2:1000001"}, {"from 2 to 1000000"}},
      {{"a.b=1:2:3:lin"}, {"'log'", "'lin'"}},
      {{"a.b=1:1:3"}, {"two different ends"}},
      {{"a.b=0:1:3:log"}, {"one sign"}},
      {{"a.b=-1:1:3:log"}, {"one sign"}},
      {{"a.b=1:2:1001", "c=1:2:1000"}, {"a grid of 1001 x 1000 runs", "at most 1000000 runs"}},
      {{"a=1:2:5000", "b=1:2:5000", "c=1:2:5000", "d=1:2:5000", "e=1:2:5000", "f=1:2:5000"}, {"a grid of 5000 x 5000 x 5000 x 5000 x 5000 x 5000 runs", "at most 1000000 runs"}},
      {{"a.b=1,2", "a.b=3,4"}, {"--sweep a.b: a.b = set twice", "nothing else sets"}},
      {{"a.b=1,2", "a={b: 1},{b: 2}"}, {"--sweep a: a = set twice", "--sweep a.b does"}},
      {{"simulation.step=1e-3,1e-4", "simulation.azimuth_step_deg=1,2"}, {"swept beside simulation.step", "each defines the step"}},
  };
  for (const auto& [sweeps, parts] : cases) {
    const std::string text = complaint(sweeping(sweeps));
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << "expected \"" << part << "\" in: " << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << "one error each: " << text;
  }
}

TEST(Sweep, aKeyIsEitherSetOrSwept) {
  EXPECT_NE(complaint(sweeping({"a.b=1,2"}, {"a.b=3"})).find("--set a.b does"), std::string::npos);
  EXPECT_EQ(complaint(sweeping({"a.b=1,2"}, {"a={type: x}"})), "") << "what is set around a swept key stays";
  EXPECT_EQ(complaint(sweeping({"a.bc=1,2"}, {"a.b=3"})), "") << "another key with the same beginning";
}

TEST(Sweep, theDurationIsSweptOrGiven) {
  SimulateOptions options = sweeping({"simulation.duration=1,2"});
  EXPECT_EQ(complaint(options), "");
  options.revolutions = 2.0;
  EXPECT_NE(complaint(options).find("no --duration or --revolutions"), std::string::npos);
}

}  // namespace
}  // namespace heerk_rotor
