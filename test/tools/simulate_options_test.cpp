#include "heerk_rotor/tools/simulate_options.hpp"

#include <gtest/gtest.h>

#include "heerk_rotor/config/problems.hpp"
#include "test_files.hpp"

namespace heerk_rotor {
namespace {

SimulateOptions parse(std::vector<const char*> words) {
  words.insert(words.begin(), "simulate");
  return parseSimulateOptions(static_cast<int>(words.size()), words.data());
}

/// What the program says about a bad command line.
std::string complaint(const std::vector<const char*>& words) {
  try {
    parse(words);
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "";
}

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(SimulateOptions, readsEveryOption) {
  const SimulateOptions options =
      parse({"rotor.yaml", "--set", "a.b=-1", "--set", "c=[1, 2]", "--duration", "2.5", "--output", "x.csv", "--output", "x.bag", "--signals",
             "rotor.lag, mast.twist", "--every", "7", "--commands", "c.csv", "--save-snapshot", "s", "--load-snapshot", "l", "--json", "--quiet"});
  EXPECT_EQ(options.configuration, "rotor.yaml");
  EXPECT_EQ(options.overrides, (std::vector<std::string>{"a.b=-1", "c=[1, 2]"}));
  EXPECT_EQ(options.duration, 2.5);
  EXPECT_FALSE(options.revolutions.has_value());
  EXPECT_EQ(options.outputs, (std::vector<std::string>{"x.csv", "x.bag"}));
  EXPECT_EQ(options.signals, (std::vector<std::string>{"rotor.lag", "mast.twist"}));
  EXPECT_EQ(options.every, 7u);
  EXPECT_EQ(options.commands, "c.csv");
  EXPECT_EQ(options.save_snapshot, "s");
  EXPECT_EQ(options.load_snapshot, "l");
  EXPECT_TRUE(options.json);
  EXPECT_TRUE(options.quiet);
  EXPECT_FALSE(options.list_signals);
}

TEST(SimulateOptions, hasPlainDefaults) {
  const SimulateOptions options = parse({"rotor.yaml"});
  EXPECT_EQ(options.every, 1u);
  EXPECT_TRUE(options.outputs.empty());
  EXPECT_TRUE(options.signals.empty());
  EXPECT_FALSE(options.duration || options.revolutions || options.json || options.quiet);
}

TEST(SimulateOptions, aRepeatedOptionDoesNotSwallowTheConfiguration) {
  const SimulateOptions options = parse({"--set", "a=1", "--output", "x.csv", "rotor.yaml"});
  EXPECT_EQ(options.configuration, "rotor.yaml");
  EXPECT_EQ(options.outputs, std::vector<std::string>{"x.csv"});
}

TEST(SimulateOptions, acceptsEqualsSignForms) {
  const SimulateOptions options = parse({"rotor.yaml", "--set=simulation.step=1e-3", "--revolutions=1.5"});
  EXPECT_EQ(options.overrides, std::vector<std::string>{"simulation.step=1e-3"});
  EXPECT_EQ(options.revolutions, 1.5);
}

TEST(SimulateOptions, aSnapshotReplacesTheConfiguration) {
  EXPECT_EQ(parse({"--load-snapshot", "s"}).configuration, "");
  EXPECT_TRUE(mentions(complaint({}), "CONFIG")) << complaint({});
}

TEST(SimulateOptions, helpNamesEveryOptionOfTheInterface) {
  const std::string help = parse({"--help"}).help;
  for (const char* option : {"CONFIG", "--set", "--duration", "--revolutions", "--output", "--signals", "--every", "--commands", "--json",
                             "--quiet", "--list-signals", "--save-snapshot", "--load-snapshot"})
    EXPECT_TRUE(mentions(help, option)) << option;
}

TEST(SimulateOptions, refusesBadValuesAndNamesThem) {
  const std::vector<std::pair<std::vector<const char*>, std::vector<std::string>>> cases = {
      {{"r.yaml", "--duration", "nan"}, {"--duration = nan", ">= 0"}},
      {{"r.yaml", "--duration", "-5"}, {"--duration = -5"}},
      {{"r.yaml", "--duration", "1e999"}, {"--duration = 1e999"}},
      {{"r.yaml", "--duration", "ten"}, {"--duration = ten"}},
      {{"r.yaml", "--duration", "5s"}, {"--duration = 5s"}},
      {{"r.yaml", "--duration", ""}, {"--duration"}},
      {{"r.yaml", "--revolutions", "inf"}, {"--revolutions = inf"}},
      {{"r.yaml", "--duration", "1", "--revolutions", "2"}, {"not both"}},
      {{"r.yaml", "--duration"}, {"--duration"}},
      {{"r.yaml", "--every", "0"}, {"--every = 0"}},
      {{"r.yaml", "--every", "-1"}, {"--every = -1"}},
      {{"r.yaml", "--every", "1.5"}, {"--every = 1.5"}},
      {{"r.yaml", "--every", "99999999999999999999999"}, {"--every = 99999999999999999999999"}},
      {{"r.yaml", "--output", "x.txt"}, {"x.txt", ".csv, .bag or .lcm"}},
      {{"r.yaml", "--output", "x.csv", "--output", "./x.csv"}, {"./x.csv", "names it already"}},
      {{"r.yaml", "--commands", "c.csv", "--output", "c.csv"}, {"c.csv", "--commands names it already"}},
      {{"r.yaml", "--signals", "a,,b"}, {"--signals = a,,b"}},
      {{"r.yaml", "--signals", ""}, {"--signals"}},
      {{"r.yaml", "--ouput", "x.csv"}, {"--ouput", "did you mean '--output'"}},
      {{"r.yaml", "second.yaml"}, {"second.yaml", "one CONFIG"}},
  };
  for (const auto& [words, parts] : cases) {
    const std::string text = complaint(words);
    for (const std::string& part : parts) EXPECT_TRUE(mentions(text, part)) << "expected \"" << part << "\" in: " << text;
  }
}

TEST(SimulateOptions, listsAllProblemsAtOnce) {
  const std::string text = complaint({"r.yaml", "--every", "0", "--duration", "-1", "--output", "x.dat"});
  EXPECT_TRUE(mentions(text, "--every") && mentions(text, "--duration") && mentions(text, "x.dat")) << text;
}

TEST(SimulateOptions, doesNotOverwriteAFileItReadsThroughALink) {
  const TestFolder folder;
  const std::string commands = folder.write("c.csv", "time");
  const std::string link = folder.file("out.csv");
  std::filesystem::create_symlink(commands, link);
  EXPECT_TRUE(mentions(complaint({"r.yaml", "--commands", commands.c_str(), "--output", link.c_str()}), "names it already"));
}

}  // namespace
}  // namespace heerk_rotor
