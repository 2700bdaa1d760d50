#include "heerk_rotor/tools/sweep_file.hpp"

#include <gtest/gtest.h>

#include "test_files.hpp"

namespace heerk_rotor {
namespace {

using Words = std::vector<std::string>;

SweepAxis axisOf(const std::string& name, const std::string& text) {
  Problems problems;
  SweepAxis axis = parseSweepFile(text, name, problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  return axis;
}

std::string complaint(const std::string& name, const std::string& text) {
  Problems problems;
  parseSweepFile(text, name, problems);
  return problems.text();
}

TEST(SweepFile, aTableHasKeysAboveValues) {
  const SweepAxis axis = axisOf("runs.csv", "\xEF\xBB\xBF# two runs\n\nsimulation.step [s], subsystems.rotor.lag_damper\r\n1e-3, \"[1, 2, 3, 4]\"\r\n,5\n");
  EXPECT_EQ(axis.keys, (Words{"simulation.step", "subsystems.rotor.lag_damper"}));
  EXPECT_EQ(axis.points, (std::vector<Words>{{"1e-3", "[1, 2, 3, 4]"}, {"", "5"}}));
}

TEST(SweepFile, aYamlListHasWordsOrMappings) {
  const std::string text =
      "- [simulation.step=1e-3, subsystems.mast.type=rigid_mast]\n"
      "- subsystems: {rotor: {lag_damper: [1, 2, 3, 4], blade_mass: 30}}\n"
      "- [\"subsystems.rotor.lag_damper=[4, 3, 2, 1]\"]\n";
  const SweepAxis axis = axisOf("runs.yaml", text);
  EXPECT_EQ(axis.keys, (Words{"simulation.step", "subsystems.mast.type", "subsystems.rotor.lag_damper", "subsystems.rotor.blade_mass"}));
  EXPECT_EQ(axis.points, (std::vector<Words>{{"1e-3", "rigid_mast", "", ""}, {"", "", "[1, 2, 3, 4]", "30"}, {"", "", "[4, 3, 2, 1]", ""}}));
}

TEST(SweepFile, everyMistakeHasItsLine) {
  const std::vector<std::pair<std::pair<std::string, std::string>, Words>> cases = {
      {{"runs.txt", "a\n1\n"}, {"runs.txt", ".csv, .yaml or .yml"}},
      {{"runs.csv", ""}, {"runs.csv", "a header line"}},
      {{"runs.csv", "a,b\n"}, {"runs.csv: runs = nothing", "at least one line"}},
      {{"runs.csv", "# only\n\n"}, {"runs = nothing"}},
      {{"runs.csv", "a,,b\n1,2,3\n"}, {"runs.csv:1: column 2 = (empty)", "dotted key"}},
      {{"runs.csv", "a,a\n1,2\n"}, {"runs.csv:1: column 2 = a", "no other column"}},
      {{"runs.csv", "a=1,b\n1,2\n"}, {"runs.csv:1: column 1 = a=1", "key alone"}},
      {{"runs.csv", "a,b\n1,2\n1\n"}, {"runs.csv:3: row = 1 cells", "expected 2"}},
      {{"runs.csv", "a,b\n1,\"[2\n"}, {"runs.csv:2: row", "quotes in pairs"}},
      {{"runs.yaml", ""}, {"runs.yaml"}},
      {{"runs.yaml", "[]"}, {"a list of runs"}},
      {{"runs.yaml", "a: 1\n"}, {"a list of runs"}},
      {{"runs.yaml", "- [a=1]\n- [a]\n"}, {"runs.yaml:2: run 2 = [a]", "KEY=VALUE"}},
      {{"runs.yaml", "- a=1\n"}, {"runs.yaml:1: run 1 = a=1", "a list of KEY=VALUE"}},
      {{"runs.yaml", "- [a=1, a=2]\n"}, {"this key once in a run"}},
      {{"runs.yaml", "- [a=]\n"}, {"runs.yaml:1: a = (empty)", "a value"}},
      {{"runs.yaml", "- {a: {b: }}\n"}, {"a.b = (empty)"}},
      {{"runs.yaml", "- {a.b: 1}\n"}, {"runs.yaml:1", "a name without dots"}},
      {{"runs.yaml", "- [a=1\n"}, {"runs.yaml:2", "valid YAML"}},
  };
  for (const auto& [file, parts] : cases) {
    const std::string text = complaint(file.first, file.second);
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << "expected \"" << part << "\" in: " << text;
  }
}

TEST(SweepFile, aFileThatCannotBeReadIsNamed) {
  const TestFolder folder;
  for (const std::string& file : {folder.file("nowhere.csv"), folder.path()}) {
    Problems problems;
    readSweepFile(file, problems);
    EXPECT_NE(problems.text().find("--sweep-file = " + file), std::string::npos) << problems.text();
  }
}

}  // namespace
}  // namespace heerk_rotor
