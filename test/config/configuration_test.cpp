#include "heerk_rotor/config/configuration.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "heerk_rotor/config/yaml_value.hpp"

namespace heerk_rotor {
namespace {

const char* const kText =
    "description: two things\n"                              // 1
    "simulation: {azimuth_step_deg: 1.0, rotor_speed: 44}\n"  // 2
    "subsystems:\n"                                          // 3
    "  mast:\n"                                              // 4
    "    type: elastic_mast\n"                               // 5
    "    stiffness: 3e6\n"                                   // 6
    "  rotor:\n"                                             // 7
    "    type: lag_rotor\n"                                  // 8
    "    lag_damper: [1, 2, 3, 4]\n"                         // 9
    "connections:\n"                                         // 10
    "  - [mast.a, rotor.a]\n"                                // 11
    "  - [rotor.b, mast.b]\n";                               // 12

Configuration parse(const std::vector<std::string>& overrides = {}, const std::string& text = kText) {
  return Configuration::parse(text, "t.yaml", overrides);
}

std::string written(const Configuration& configuration, const std::string& key) { return asWritten(findValue(configuration.root(), key)); }

/// All problems of a configuration that must not be accepted.
std::string problemsOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    Configuration::parse(text, "t.yaml", overrides);
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Configuration, knowsTheLineOfEveryKey) {
  const Configuration c = parse();
  EXPECT_EQ(c.where("description"), "t.yaml:1");
  EXPECT_EQ(c.where("simulation.rotor_speed"), "t.yaml:2");
  EXPECT_EQ(c.where("subsystems.mast"), "t.yaml:4");
  EXPECT_EQ(c.where("subsystems.mast.stiffness"), "t.yaml:6");
  EXPECT_EQ(c.where("subsystems.rotor.lag_damper.2"), "t.yaml:9");
  EXPECT_EQ(c.where("connections.1"), "t.yaml:12");
  EXPECT_EQ(c.where("connections.1.0"), "t.yaml:12");
}

TEST(Configuration, givesTheLineOfTheNearestAncestorOfAnAbsentKey) {
  EXPECT_EQ(parse().where("subsystems.mast.initial.twist"), "t.yaml:4");
  EXPECT_EQ(parse().where("nothing.at.all"), "t.yaml:1");
}

TEST(Configuration, countsLinesInFilesWithCarriageReturns) {
  const Configuration c = parse({}, "# comment\r\nsimulation:\r\n  step: 1\r\nsubsystems: {}\r\n");
  EXPECT_EQ(c.where("simulation.step"), "t.yaml:3");
  EXPECT_EQ(written(c, "simulation.step"), "1");
}

// ---- overrides ----

TEST(Configuration, overridesValuesAndKnowsWhereTheyCameFrom) {
  const Configuration c = parse({"subsystems.mast.stiffness=3e7", "subsystems.rotor.lag_damper.2=30", "connections.0=[mast.c, rotor.c]"});
  EXPECT_EQ(written(c, "subsystems.mast.stiffness"), "3e7");
  EXPECT_EQ(c.where("subsystems.mast.stiffness"), "--set subsystems.mast.stiffness");
  EXPECT_EQ(written(c, "subsystems.rotor.lag_damper"), "[1, 2, 30, 4]");
  EXPECT_EQ(c.where("subsystems.rotor.lag_damper.2"), "--set subsystems.rotor.lag_damper.2");
  EXPECT_EQ(c.where("subsystems.rotor.lag_damper.1"), "t.yaml:9");
  EXPECT_EQ(c.where("connections.0.1"), "--set connections.0");
  EXPECT_EQ(written(c, "connections"), "[[mast.c, rotor.c], [rotor.b, mast.b]]");
}

TEST(Configuration, appliesOverridesInOrder) {
  const Configuration c = parse({"subsystems.mast.stiffness=1", "subsystems.mast={type: rigid_mast, mass: 2}", "subsystems.mast.mass=3"});
  EXPECT_EQ(written(c, "subsystems.mast"), "{type: rigid_mast, mass: 3}");
  EXPECT_EQ(c.where("subsystems.mast.type"), "--set subsystems.mast");
  EXPECT_EQ(c.where("subsystems.mast.mass"), "--set subsystems.mast.mass");
  EXPECT_EQ(c.where("subsystems.mast.stiffness"), "--set subsystems.mast") << "the older override is gone with its value";
}

TEST(Configuration, insertsKeysOfExistingMappingsForTheSchemaToJudge) {
  const Configuration c = parse({"subsystems.mast.damping=5", "subsystems.drive={type: drive}"});
  EXPECT_EQ(written(c, "subsystems.mast.damping"), "5");
  EXPECT_EQ(c.where("subsystems.mast.damping"), "--set subsystems.mast.damping");
  EXPECT_EQ(written(c, "subsystems.drive.type"), "drive");
}

TEST(Configuration, createsMappingsThatAFileMayLeaveOut) {
  EXPECT_EQ(written(parse({"subsystems.mast.initial.twist=0.1"}), "subsystems.mast.initial"), "{twist: 0.1}");
  EXPECT_EQ(written(parse({"simulation.rotor_speed=4"}, "subsystems: {}"), "simulation"), "{rotor_speed: 4}");
  EXPECT_EQ(written(parse({"subsystems.a.initial.x=1"}, "subsystems:\n  a:\n    initial:\n"), "subsystems.a"), "{initial: {x: 1}}");
}

TEST(Configuration, letsEachWayToGiveTheStepReplaceTheOther) {
  const Configuration seconds = parse({"simulation.step=1e-3"});
  EXPECT_EQ(written(seconds, "simulation"), "{rotor_speed: 44, step: 1e-3}");
  const Configuration degrees = parse({"simulation.step=1e-3", "simulation.azimuth_step_deg=2"});
  EXPECT_EQ(written(degrees, "simulation"), "{rotor_speed: 44, azimuth_step_deg: 2}");
  EXPECT_EQ(degrees.where("simulation.azimuth_step_deg"), "--set simulation.azimuth_step_deg");
}

TEST(Configuration, refusesOverridesInUnknownSurroundingsNamingTheNearestKey) {
  const std::string expected = "--set subsytems.mast.stiffness: subsytems.mast.stiffness = 1: expected a known key (did you mean 'subsystems.mast.stiffness'?)";
  EXPECT_EQ(problemsOf(kText, {"subsytems.mast.stiffness=1"}), expected);
  EXPECT_NE(problemsOf(kText, {"subsystems.rotr.lag_damper=1"}).find("did you mean 'subsystems.rotor.lag_damper'?"), std::string::npos);
  EXPECT_NE(problemsOf(kText, {"subsystems.rotr.no_such_thing=1"}).find("did you mean 'subsystems.rotor"), std::string::npos);
  EXPECT_NE(problemsOf(kText, {"simulation.mast.stiffness=1"}).find("did you mean 'subsystems.mast.stiffness'?"), std::string::npos);
  EXPECT_NE(problemsOf(kText, {"xyzzy.q=1"}).find("known here: description, simulation, subsystems, connections"), std::string::npos);
}

TEST(Configuration, refusesOverridesThatCannotBeApplied) {
  EXPECT_NE(problemsOf(kText, {"subsystems.mast.stiffness"}).find("'subsystems.mast.stiffness': expected KEY=VALUE"), std::string::npos);
  EXPECT_NE(problemsOf(kText, {"=3"}).find("'=3': expected KEY=VALUE"), std::string::npos);
  EXPECT_NE(problemsOf(kText, {"simulation..step=3"}).find("expected KEY=VALUE"), std::string::npos);
  EXPECT_NE(problemsOf(kText, {"simulation.step="}).find("simulation.step = (empty): expected a value after '='"), std::string::npos);
  EXPECT_NE(problemsOf(kText, {"simulation.step=[1, 2"}).find("simulation.step = [1, 2: expected valid YAML"), std::string::npos);
  EXPECT_NE(problemsOf(kText, {"simulation={a: 1, a: 2}"}).find("expected this key once"), std::string::npos);
  EXPECT_NE(problemsOf(kText, {"connections.2=[a.b, c.d]"}).find("connections.2 = [a.b, c.d]: expected an index from 0 to 1"), std::string::npos);
  EXPECT_NE(problemsOf(kText, {"connections.first=[a.b, c.d]"}).find("expected an index from 0 to 1"), std::string::npos);
  EXPECT_NE(problemsOf(kText, {"subsystems.mast.stiffness.2=1"}).find("subsystems.mast.stiffness is one value, 3e6"), std::string::npos);
}

TEST(Configuration, reportsAllBadOverridesAtOnce) {
  const std::string problems = problemsOf(kText, {"a.b=1", "simulation.step=", "unknown_section=3"});
  EXPECT_NE(problems.find("--set a.b"), std::string::npos);
  EXPECT_NE(problems.find("--set simulation.step"), std::string::npos);
  EXPECT_NE(problems.find("--set unknown_section: unknown_section = 3"), std::string::npos);
}

TEST(Configuration, writesAliasesOutSoThatOneOverrideChangesOnePlace) {
  const Configuration c = parse({"subsystems.b.mass=5"}, "subsystems:\n  a: &blade {mass: 1}\n  b: *blade\n");
  EXPECT_EQ(written(c, "subsystems"), "{a: {mass: 1}, b: {mass: 5}}");
}

TEST(Configuration, copiesAreIndependentOfLaterAssignments) {
  Configuration first = parse();
  const Configuration copy = first;
  first = parse({"subsystems.mast.stiffness=1"});
  EXPECT_EQ(written(copy, "subsystems.mast.stiffness"), "3e6");
  EXPECT_EQ(written(first, "subsystems.mast.stiffness"), "1");
}

// ---- files and texts that are refused ----

TEST(Configuration, namesTheLineOfASyntaxError) {
  const std::string problems = problemsOf("simulation:\n  step: 1\nsubsystems: [a, b\nconnections: []\n");
  EXPECT_EQ(problems.compare(0, 7, "t.yaml:"), 0) << problems;
  EXPECT_NE(problems.find("expected valid YAML"), std::string::npos);
  EXPECT_NE(problemsOf("simulation:\n\tstep: 1\n").find("t.yaml:2: step: 1: expected valid YAML"), std::string::npos) << problemsOf("simulation:\n\tstep: 1\n");
}

TEST(Configuration, refusesWhatIsNoMapping) {
  EXPECT_EQ(problemsOf(""), "t.yaml: nothing but white space and comments: expected a YAML document");
  EXPECT_EQ(problemsOf("# only a comment\n\n"), problemsOf(""));
  EXPECT_EQ(problemsOf("\n- 1\n- 2\n"), "t.yaml:2: [1, 2]: expected a mapping with the sections simulation, subsystems and connections");
  EXPECT_NE(problemsOf("just text").find("t.yaml:1: just text: expected a mapping"), std::string::npos);
}

TEST(Configuration, refusesASecondDocument) {
  EXPECT_EQ(problemsOf("simulation: {}\n---\nsubsystems: {}\n"), "t.yaml:3: a second YAML document: expected one document");
  EXPECT_EQ(problemsOf("---\nsimulation: {}\n...\n"), "accepted");
}

TEST(Configuration, refusesAKeyGivenTwice) {
  EXPECT_EQ(problemsOf("simulation:\n  step: 1\n  rotor_speed: 4\n  step: 2\n"),
            "t.yaml:4: simulation.step = 2: expected this key once; it is given already at t.yaml:2");
  EXPECT_NE(problemsOf("subsystems:\n  a: {x: 1, \"x\": 2}\n").find("subsystems.a.x = 2: expected this key once"), std::string::npos);
}

TEST(Configuration, refusesUnknownSectionsNamingTheNearest) {
  EXPECT_EQ(problemsOf("simulation: {}\nsubsytems: {a: 1}\n"),
            "t.yaml:2: subsytems = {a: 1}: expected one of the sections description, simulation, trim, subsystems, connections (did you mean 'subsystems'?)");
  EXPECT_NE(problemsOf("description: [1]\n").find("description = [1]: expected text"), std::string::npos);
}

TEST(Configuration, refusesBothWaysToGiveTheStep) {
  const std::string both = "simulation:\n  step: 1e-3\n  azimuth_step_deg: 1\n";
  const std::string expected = "t.yaml:2: simulation.step = 1e-3: expected either step or azimuth_step_deg, but azimuth_step_deg is given too (t.yaml:3)";
  EXPECT_EQ(problemsOf(both), expected);
  EXPECT_EQ(problemsOf(both, {"simulation.step=1"}), expected) << "an override does not mend the file";
  EXPECT_NE(problemsOf(kText, {"simulation={step: 1, azimuth_step_deg: 1}"}).find("--set simulation: simulation.step = 1: expected either step"), std::string::npos);
}

TEST(Configuration, refusesWhatYamlCppWouldSwallow) {
  // Character 4 ends the text for yaml-cpp, so that everything after it would be lost in silence.
  EXPECT_EQ(problemsOf(std::string("simulation: {}\n\x04subsystems: {}\n")), "t.yaml:2: control character number 4: expected text in YAML");
  EXPECT_NE(problemsOf("simulation: {step: !!str 3}\n").find("simulation.step = tag tag:yaml.org,2002:str: expected a value without a tag"), std::string::npos);
  EXPECT_NE(problemsOf("simulation: {a.b: 3}\n").find("expected a name without dots as key"), std::string::npos);
  EXPECT_NE(problemsOf("simulation: {[1]: 3}\n").find("expected a name without dots as key"), std::string::npos);
}

TEST(Configuration, refusesAliasesWithoutEnd) {
  EXPECT_NE(problemsOf("simulation: &a {b: *a}\n").find("nested without end"), std::string::npos);
  std::string text = "l0: &l0 [1, 1]\n";  // doubles with every line
  for (int i = 1; i < 25; ++i) {
    const std::string before = "*l" + std::to_string(i - 1);
    text += "l" + std::to_string(i) + ": &l" + std::to_string(i) + " [" + before + " , " + before + " ]\n";
  }
  EXPECT_NE(problemsOf(text).find("nested without end"), std::string::npos);
}

class ConfigurationFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directory(directory_); }
  void TearDown() override { std::filesystem::remove_all(directory_); }
  static std::string problemsOfFile(const std::string& file) {
    try {
      Configuration::load(file);
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "accepted";
  }
  const std::string directory_ = testing::TempDir() + "configuration_test_" + std::to_string(::getpid());
};

TEST_F(ConfigurationFile, isLoadedUnderItsOwnName) {
  const std::string file = directory_ + "/t.yaml";
  std::ofstream(file) << kText;
  const Configuration c = Configuration::load(file, {"subsystems.mast.stiffness=4"});
  EXPECT_EQ(c.file(), file);
  EXPECT_EQ(c.where("subsystems.rotor.type"), file + ":8");
  EXPECT_EQ(written(c, "subsystems.mast.stiffness"), "4");
}

TEST_F(ConfigurationFile, mustExistAndBeAFile) {
  EXPECT_EQ(problemsOfFile(directory_ + "/none.yaml"), directory_ + "/none.yaml: No such file or directory: expected a YAML configuration file that can be read");
  EXPECT_EQ(problemsOfFile(directory_), directory_ + ": a directory: expected a YAML configuration file that can be read");
}

TEST_F(ConfigurationFile, mustNotBeEmpty) {
  const std::string file = directory_ + "/empty.yaml";
  std::ofstream(file).close();
  EXPECT_EQ(problemsOfFile(file), file + ": nothing but white space and comments: expected a YAML document");
}

// ---- the resolved text ----

TEST(Configuration, resolvedTextHoldsOverridesAndParsesToTheSame) {
  const Configuration c = parse({"subsystems.mast.stiffness=3.10e+7", "simulation.step=1.0e-3", "description='3e6'"});
  const Configuration again = Configuration::parse(c.resolvedText(), "again");
  for (const char* key : {"description", "simulation", "subsystems", "connections"}) EXPECT_EQ(written(again, key), written(c, key)) << key;
  EXPECT_EQ(written(again, "subsystems.mast.stiffness"), "3.10e+7") << "scalars stay as written";
  EXPECT_EQ(written(again, "description"), "\"3e6\"") << "text stays text";
  EXPECT_EQ(written(again, "simulation"), "{rotor_speed: 44, step: 1.0e-3}");
  EXPECT_EQ(again.resolvedText(), c.resolvedText());
}

}  // namespace
}  // namespace heerk_rotor
