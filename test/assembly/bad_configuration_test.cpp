// Every way to get a configuration wrong: the message must name place (file:line or --set), key, value and expectation.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "heerk_rotor/assembly/build_simulation.hpp"

namespace heerk_rotor {
namespace {

/// A correct configuration with every kind of section; the cases below spoil one line of it.
const char* const kGood = R"(simulation:
  integrator: HEERK4
  azimuth_step_deg: 1.0
  rotor_speed: 41.0
subsystems:
  rotor:
    type: lag_rotor
    blade_mass: 31.9
    lag_damper: [259, 259, 259, 259]
    second_order_hub_terms: true
    initial: {lag_1: 0.01}
  mast:
    type: elastic_mast
    stiffness: 3.0e+6
  swashplate:
    type: swashplate
  airloads:
    type: lag_airloads
connections:
  - [mast.hub_motion, rotor.hub_motion]
  - [mast.hub_motion, swashplate.hub_motion]
  - [mast.hub_motion, airloads.hub_motion]
  - [mast.hub_acceleration, rotor.hub_acceleration]
  - [rotor.blade_reaction, mast.blade_reaction]
  - [rotor.lag_rate, airloads.lag_rate]
  - [swashplate.pitch, airloads.pitch]
  - [airloads.blade_load, rotor.blade_load]
)";

const std::string kFile = "bad.yaml";

std::string problemsOf(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    buildSimulation(Configuration::parse(text, kFile, overrides));
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "accepted";
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string spoiled(const std::string& piece, const std::string& replacement) {
  std::string text = kGood;
  const std::size_t at = text.find(piece);
  EXPECT_NE(at, std::string::npos) << piece;
  if (at != std::string::npos) text.replace(at, piece.size(), replacement);
  return text;
}

/// "bad.yaml:8" for the one line that holds the marker.
std::string lineWith(const std::string& text, const std::string& marker) {
  const std::vector<std::string> lines = linesOf(text);
  const auto holds = [&](const std::string& line) { return line.find(marker) != std::string::npos; };
  const auto first = std::find_if(lines.begin(), lines.end(), holds);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(), holds), 1) << marker;
  return kFile + ":" + std::to_string(first - lines.begin() + 1);
}

struct Case {
  const char* name;
  const char* piece;         // of the good configuration
  const char* replacement;
  const char* marker;        // text by which the blamed line is found
  const char* key;
  const char* found;
  const char* expected;      // part of the expectation
};

void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name; }

class BadConfiguration : public testing::TestWithParam<Case> {};

TEST_P(BadConfiguration, isRefusedWithOneProblemThatSaysWhereWhatAndWhy) {
  const Case& c = GetParam();
  const std::string text = spoiled(c.piece, c.replacement);
  const std::string problems = problemsOf(text);
  const std::string beginning = lineWith(text, c.marker) + ": " + c.key + " = " + c.found + ": expected ";
  EXPECT_EQ(problems.compare(0, beginning.size(), beginning), 0) << problems << "\ninstead of\n" << beginning;
  EXPECT_NE(problems.find(c.expected, std::min(beginning.size(), problems.size())), std::string::npos) << problems;
  EXPECT_EQ(linesOf(problems).size(), 1u) << "one fault, one problem:\n" << problems;
}

const Case kSimulationCases[] = {
    {"UnknownKey", "integrator:", "integratr:", "integratr", "simulation.integratr", "HEERK4", "a known key (did you mean 'integrator'?)"},
    {"UnknownIntegrator", "HEERK4", "HERK5", "integrator", "simulation.integrator", "HERK5", "one of HERK4, HEERK2, HEERK3, HEERK4, ETDRK4, Newmark, precise_1, precise_2 (did you mean 'HERK4'?)"},
    {"IntegratorIsAList", "HEERK4", "[HERK4]", "integrator", "simulation.integrator", "[HERK4]", "a word"},
    {"SpeedIsText", "41.0", "fast", "rotor_speed", "simulation.rotor_speed", "fast", "a number > 0 [rad/s]"},
    {"SpeedMissing", "  rotor_speed: 41.0\n", "", "simulation", "simulation.rotor_speed", "(missing)", "a number > 0 [rad/s]"},
    {"SpeedGivenTwoWays", "rotor_speed: 41.0", "rotor_speed: 41.0\n  rotor_speed_rpm: 390", "rotor_speed:", "simulation.rotor_speed", "41.0", "not both"},
    {"BothSteps", "azimuth_step_deg: 1.0", "azimuth_step_deg: 1.0\n  step: 1e-3", " step:", "simulation.step", "1e-3", "either step or azimuth_step_deg"},
    {"StepNegative", "azimuth_step_deg: 1.0", "step: -1e-3", "step", "simulation.step", "-1e-3", "a number > 0 [s]"},
    {"StepNotANumber", "azimuth_step_deg: 1.0", "step: .nan", "step", "simulation.step", ".nan", "a number > 0 [s]"},
    {"StepBeyondATurn", "deg: 1.0", "deg: 400", "azimuth_step_deg", "simulation.azimuth_step_deg", "400", "a number in (0, 360] [deg]"},
    {"UnknownFormulation", "integrator: HEERK4", "formulation: printd", "printd", "simulation.formulation", "printd", "one of absolute_lag, printed (did you mean 'printed'?)"},
    {"ToleranceWord", "integrator: HEERK4", "newton_tolerance: papr", "papr", "simulation.newton_tolerance", "papr", "or the word paper"},
    {"DurationZero", "integrator: HEERK4", "duration: 0", "duration", "simulation.duration", "0", "a number > 0 [s]"},
};

const Case kSubsystemCases[] = {
    {"NegativeMass", "31.9", "-31.9", "blade_mass", "subsystems.rotor.blade_mass", "-31.9", "a number > 0 [kg]"},
    {"QuotedNumber", "31.9", "\"31.9\"", "blade_mass", "subsystems.rotor.blade_mass", "\"31.9\"", "a number > 0 [kg]"},
    {"NumberWithUnderscore", "31.9", "3_1", "blade_mass", "subsystems.rotor.blade_mass", "3_1", "a number > 0 [kg]"},
    {"InfiniteMass", "31.9", ".inf", "blade_mass", "subsystems.rotor.blade_mass", ".inf", "a number > 0 [kg]"},
    {"MassIsAList", "31.9", "[31.9]", "blade_mass", "subsystems.rotor.blade_mass", "[31.9]", "a number > 0 [kg]"},
    {"MassIsEmpty", "31.9", "", "blade_mass", "subsystems.rotor.blade_mass", "(empty)", "a number > 0 [kg]"},
    {"ListTooShort", "[259, 259, 259, 259]", "[259, 259, 259]", "lag_damper", "subsystems.rotor.lag_damper", "[259, 259, 259]", "a list of 4 such numbers, not of 3"},
    {"ListElementNegative", "259, 259]", "259, -259]", "lag_damper", "subsystems.rotor.lag_damper.3", "-259", "a number >= 0 [N m s/rad]"},
    {"FlagIsYes", "true", "yes", "second_order", "subsystems.rotor.second_order_hub_terms", "yes", "true or false"},
    {"UnknownParameter", "blade_mass", "blade_mas", "blade_mas", "subsystems.rotor.blade_mas", "31.9", "a known key (did you mean 'blade_mass'?)"},
    {"MassGivenTwoWays", "blade_mass: 31.9", "fuselage_mass: 2900\n    fuselage_mass_x: 3000", "fuselage_mass:", "subsystems.rotor.fuselage_mass", "2900", "either fuselage_mass, or"},
    {"DuplicateParameter", "blade_mass: 31.9", "blade_mass: 31.9\n    blade_mass:  32", "blade_mass:  32", "subsystems.rotor.blade_mass", "32", "this key once; it is given already at bad.yaml:8"},
    {"DuplicateSubsystem", "  mast:\n", "  mast: {type: rigid_mast}\n  mast :\n", "mast :", "subsystems.mast", "{type: elastic_mast, stiffness: 3.0e+6}", "this key once"},
    {"UnknownType", "type: swashplate\n", "type:  swashplat\n", "type:  ", "subsystems.swashplate.type", "swashplat", "(did you mean 'swashplate'?)"},
    {"TypeMissing", "    type: lag_airloads", "    chord: 0.3", "airloads:", "subsystems.airloads.type", "(missing)", "one of lag_rotor, elastic_mast"},
    {"UnknownInitialState", "lag_1:", "lagg_1:", "lagg_1", "subsystems.rotor.initial.lagg_1", "0.01", "a known key (did you mean 'lag_1'?)"},
    {"InitialStateIsText", "0.01", "small", "initial", "subsystems.rotor.initial.lag_1", "small", "a number [rad]"},
    {"InitialStateIsInfinite", "0.01", "1e400", "initial", "subsystems.rotor.initial.lag_1", "1e400", "a number [rad]"},
    {"InitialIsANumber", "{lag_1: 0.01}", "0.01", "initial", "subsystems.rotor.initial", "0.01", "a mapping"},
    {"SubsystemIsAWord", "  swashplate:\n    type: swashplate\n", "  swashplate: swashplate\n", "  swashplate: ", "subsystems.swashplate", "swashplate", "a mapping with the key type"},
    {"SubsystemName", "  swashplate:\n", "  2nd-drive: {type: drive}\n  swashplate:\n", "2nd-drive", "subsystems.2nd-drive", "{type: drive}", "as name of a subsystem a letter"},
    // The hinge offset alone gives the hub inertia against common lag motion: 1 / kappa = 4 a^2 m_b I_zb / (J I_l) = 4e-20 here.
    {"HubWithHardlyAnyInertia", "blade_mass: 31.9", "hinge_offset: 1.0e-9", "type: elastic_mast", "subsystems.mast.type", "elastic_mast", "makes the system not index 1"},
    {"HubWithoutInertia", "blade_mass: 31.9", "hinge_offset: 0", "type: elastic_mast", "subsystems.mast.type", "elastic_mast", "rigid_mast, because with so small a hinge_offset"},
};

const Case kConnectionCases[] = {
    {"SizesDiffer", "  - [rotor.lag_rate", "  - [mast.hub_acceleration, rotor.hub_motion]\n  - [rotor.lag_rate", "acceleration, rotor.hub_motion", "connections.5", "[mast.hub_acceleration, rotor.hub_motion]",
     "mast.hub_acceleration (2, rad/s^2) -> rotor.hub_motion (4, rad, rad/s): sizes differ"},
    {"UnitsDiffer", "[swashplate.pitch, airloads.pitch]", "[rotor.lag_rate, airloads.pitch]", "pitch]", "connections.6", "[rotor.lag_rate, airloads.pitch]",
     "rotor.lag_rate (4, rad/s) -> airloads.pitch (4, rad): units differ"},
    {"NoSuchSubsystem", "[mast.hub_motion, rotor", "[mst.hub_motion, rotor", "mst", "connections.0", "[mst.hub_motion, rotor.hub_motion]", "there is no subsystem mst (did you mean 'mast'?)"},
    {"NoSuchOutput", "[swashplate.pitch,", "[swashplate.ptch,", "ptch", "connections.6", "[swashplate.ptch, airloads.pitch]", "swashplate has no output ptch (did you mean 'pitch'?)"},
    {"NoSuchInput", "[mast.hub_motion, rotor.hub_motion]", "[mast.hub_motion, rotor.hub_motion]\n  - [mast.torque, rotor.torqe]", "torqe", "connections.1", "[mast.torque, rotor.torqe]",
     "rotor has no input torqe"},
    {"WrongOrder", "[rotor.lag_rate, airloads.lag_rate]", "[airloads.lag_rate, rotor.lag_rate]", "lag_rate", "connections.5", "[airloads.lag_rate, rotor.lag_rate]", "the order is [output, input]"},
    {"ConnectedTwice", "  - [rotor.lag_rate", "  - [ mast.hub_motion, rotor.hub_motion]\n  - [rotor.lag_rate", "[ mast", "connections.5", "[mast.hub_motion, rotor.hub_motion]", "connected already"},
    {"ThreeElements", "  - [rotor.lag_rate", "  - [a.b, c.d, e.f]\n  - [rotor.lag_rate", "a.b", "connections.5", "[a.b, c.d, e.f]", "a connection [<subsystem>.<output>, <subsystem>.<input>]"},
    {"Text", "  - [rotor.lag_rate", "  - a.b to c.d\n  - [rotor.lag_rate", "a.b", "connections.5", "a.b to c.d", "a connection [<subsystem>.<output>, <subsystem>.<input>]"},
    {"Mapping", "  - [rotor.lag_rate", "  - {from: a, to: b}\n  - [rotor.lag_rate", "from", "connections.5", "{from: a, to: b}", "a connection [<subsystem>.<output>, <subsystem>.<input>]"},
    {"NestedList", "  - [rotor.lag_rate", "  - [[a.b], c.d]\n  - [rotor.lag_rate", "a.b", "connections.5", "[[a.b], c.d]", "a connection [<subsystem>.<output>, <subsystem>.<input>]"},
    {"NoPort", "  - [rotor.lag_rate", "  - [rotor, mast]\n  - [rotor.lag_rate", "[rotor, mast]", "connections.5", "[rotor, mast]", "rotor: expected subsystem.output"},
    {"Unconnected", "  - [swashplate.pitch, airloads.pitch]\n", "", "  airloads:", "airloads.pitch", "(not connected)", "a connection [swashplate.pitch, airloads.pitch] to this input (4 values [rad])"},
};

const Case kSectionCases[] = {
    {"UnknownSection", "simulation:", "simulaton:", "simulaton", "simulaton", "{integrator: HEERK4, azimuth_step_deg: 1.0, rotor_speed: 41.0}", "(did you mean 'simulation'?)"},
    {"DescriptionIsAList", "simulation:", "description: [a]\nsimulation:", "description", "description", "[a]", "text"},
};

std::string caseName(const testing::TestParamInfo<Case>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Simulation, BadConfiguration, testing::ValuesIn(kSimulationCases), caseName);
INSTANTIATE_TEST_SUITE_P(Subsystem, BadConfiguration, testing::ValuesIn(kSubsystemCases), caseName);
INSTANTIATE_TEST_SUITE_P(Connection, BadConfiguration, testing::ValuesIn(kConnectionCases), caseName);
INSTANTIATE_TEST_SUITE_P(Section, BadConfiguration, testing::ValuesIn(kSectionCases), caseName);

TEST(BadConfigurations, areVariationsOfAGoodOne) { EXPECT_EQ(problemsOf(kGood), "accepted"); }

struct BadOverride {
  const char* assignment;
  const char* problem;  // beginning
  const char* expected;
};

void PrintTo(const BadOverride& c, std::ostream* stream) { *stream << c.assignment; }

class BadOverrideTest : public testing::TestWithParam<BadOverride> {};

TEST_P(BadOverrideTest, blamesTheCommandLine) {
  const std::string problems = problemsOf(kGood, {GetParam().assignment});
  EXPECT_EQ(problems.compare(0, std::string(GetParam().problem).size(), GetParam().problem), 0) << problems;
  EXPECT_NE(problems.find(GetParam().expected), std::string::npos) << problems;
  EXPECT_EQ(linesOf(problems).size(), 1u) << problems;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadOverrideTest,
    testing::Values(
        BadOverride{"subsystems.mast.stifness=1", "--set subsystems.mast.stifness: subsystems.mast.stifness = 1: expected ", "a known key (did you mean 'stiffness'?)"},
        BadOverride{"subsystems.mst.stiffness=1", "--set subsystems.mst.stiffness: subsystems.mst.stiffness = 1: expected ", "(did you mean 'subsystems.mast.stiffness'?)"},
        BadOverride{"subsystems.mast.stiffness=-1", "--set subsystems.mast.stiffness: subsystems.mast.stiffness = -1: expected ", "a number > 0 [N m/rad]"},
        BadOverride{"subsystems.rotor.lag_damper.2=x", "--set subsystems.rotor.lag_damper.2: subsystems.rotor.lag_damper.2 = x: expected ", "a number >= 0 [N m s/rad]"},
        BadOverride{"subsystems.rotor.lag_damper.4=1", "--set subsystems.rotor.lag_damper.4: subsystems.rotor.lag_damper.4 = 1: expected ", "an index from 0 to 3"},
        BadOverride{"subsystems.mast.initial.twst=0.1", "--set subsystems.mast.initial.twst: subsystems.mast.initial.twst = 0.1: expected ", "(did you mean 'twist'?)"},
        BadOverride{"connections.0=[mast.hub_motion, rotor.hub_motion, x]", "--set connections.0: connections.0 = [mast.hub_motion, rotor.hub_motion, x]: expected ", "a connection ["},
        BadOverride{"simulation.integrator=HERK", "--set simulation.integrator: simulation.integrator = HERK: expected ", "one of HERK4"},
        BadOverride{"simulation.step", "--set simulation.step: 'simulation.step': expected ", "KEY=VALUE"},
        BadOverride{"simulation.step=", "--set simulation.step: simulation.step = (empty): expected ", "a value"}));

TEST(BadConfigurations, haveAllTheirProblemsListedAtOnceInTheOrderOfTheFile) {
  std::string text = spoiled("HEERK4", "HERK5");
  for (const auto& [piece, replacement] : {std::pair<const char*, const char*>{"deg: 1.0", "deg: 0"}, {"31.9", "-1"}, {"true", "1"}, {"lag_1", "lag_9"}, {"stiffness", "stifness"},
                                           {"[mast.hub_motion, rotor.hub_motion]", "[mast.hub_motio, rotor.hub_motion]"}, {"  - [swashplate.pitch, airloads.pitch]\n", ""}}) {
    const std::size_t at = text.find(piece);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string(piece).size(), replacement);
  }
  const std::string problems = problemsOf(text);
  for (const char* part : {"simulation.integrator = HERK5", "simulation.azimuth_step_deg = 0", "subsystems.rotor.blade_mass = -1", "subsystems.rotor.second_order_hub_terms = 1",
                           "subsystems.rotor.initial.lag_9 = 0.01", "subsystems.mast.stifness = 3.0e+6", "connections.0 = [mast.hub_motio, rotor.hub_motion]", "airloads.pitch = (not connected)"}) {
    EXPECT_NE(problems.find(part), std::string::npos) << part << " is not in\n" << problems;
  }
  EXPECT_EQ(linesOf(problems).size(), 8u) << problems;
}

TEST(BadConfigurations, withoutSubsystemsAreRefused) {
  const std::string simulation = "simulation: {rotor_speed: 4}\n";
  const std::string expected = ": expected a mapping of at least one subsystem";
  EXPECT_EQ(problemsOf(simulation).find("bad.yaml:1: subsystems = (missing)" + expected), 0u);
  EXPECT_EQ(problemsOf(simulation + "subsystems: {}\n").find("bad.yaml:2: subsystems = {}" + expected), 0u);
  EXPECT_EQ(problemsOf(simulation + "subsystems:\n").find("bad.yaml:2: subsystems = (empty)" + expected), 0u);
  EXPECT_EQ(problemsOf(simulation + "subsystems: [rotor]\n").find("bad.yaml:2: subsystems = [rotor]" + expected), 0u);
}

TEST(BadConfigurations, withConnectionsThatAreNoListAreRefused) {
  std::string text = kGood;
  text.resize(text.find("connections:"));
  EXPECT_NE(problemsOf(text + "connections: {mast.hub_motion: rotor.hub_motion}\n").find("expected a name without dots as key"), std::string::npos);
  EXPECT_NE(problemsOf(text + "connections: all\n").find("bad.yaml:19: connections = all: expected a list of connections"), std::string::npos);
}

TEST(BadConfigurations, areNotCalledUnconnectedBecauseAnotherSubsystemIsWrong) {
  const std::string problems = problemsOf(spoiled("type: swashplate", "type: nonsense"));
  EXPECT_EQ(linesOf(problems).size(), 1u) << problems;
}

// ---- files ----

class BadFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directory(directory_); }
  void TearDown() override { std::filesystem::remove_all(directory_); }
  std::string problemsOfFile(const std::string& contents) const {
    std::ofstream(file_, std::ios::binary) << contents;
    return problemsAt(file_);
  }
  static std::string problemsAt(const std::string& file) {
    try {
      buildSimulation(Configuration::load(file));
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "accepted";
  }
  const std::string directory_ = testing::TempDir() + "bad_configuration_test_" + std::to_string(::getpid());
  const std::string file_ = directory_ + "/bad.yaml";
};

TEST_F(BadFile, thatDoesNotExistIsNamed) {
  EXPECT_EQ(problemsAt(file_), file_ + ": No such file or directory: expected a YAML configuration file that can be read");
}

TEST_F(BadFile, thatIsADirectoryIsNamed) { EXPECT_EQ(problemsAt(directory_), directory_ + ": a directory: expected a YAML configuration file that can be read"); }

TEST_F(BadFile, thatIsEmptyIsNamed) { EXPECT_EQ(problemsOfFile(""), file_ + ": nothing but white space and comments: expected a YAML document"); }

TEST_F(BadFile, thatIsNoYamlIsNamedWithTheLine) {
  const std::string problems = problemsOfFile(spoiled("  rotor_speed: 41.0", "\trotor_speed: 41.0"));
  EXPECT_EQ(problems.find(file_ + ":4: rotor_speed: 41.0: expected valid YAML"), 0u) << problems;
}

TEST_F(BadFile, thatHoldsAListIsNamedWithTheLine) { EXPECT_EQ(problemsOfFile("- a\n- b\n").find(file_ + ":1: [a, b]: expected a mapping with the sections"), 0u); }

TEST_F(BadFile, thatHoldsTwoDocumentsIsNamedWithTheLine) { EXPECT_EQ(problemsOfFile("a: 1\n---\nb: 2\n").find(file_ + ":3: a second YAML document: expected one"), 0u); }

/// The mast takes its inertia from `twin`, which is chosen such that J = 4 S_h g of the rotor that really sits on it:
/// then I - dg/dy of the loop hub acceleration -> blade reaction -> hub acceleration is exactly singular.
TEST(BadConfigurations, aLoopThatIsNotIndexOneNamesItsPorts) {
  const std::string text = R"(simulation: {rotor_speed: 6.63, formulation: printed}
subsystems:
  rotor: {type: lag_rotor, second_order_hub_terms: false}
  twin: {type: lag_rotor, blade_inertia: 258.27900954458676}
  mast: {type: elastic_mast, rotor: twin}
  other_mast: {type: rigid_mast, rotor: twin}
connections:
  - [mast.hub_motion, rotor.hub_motion]
  - [mast.hub_acceleration, rotor.hub_acceleration]
  - [rotor.blade_reaction, mast.blade_reaction]
  - [other_mast.hub_motion, twin.hub_motion]
  - [other_mast.hub_acceleration, twin.hub_acceleration]
)";
  const std::string problems = problemsOf(text);
  EXPECT_EQ(problems.find("bad.yaml:7: connections = an algebraic loop without a unique solution: expected an index-1 system: the algebraic loop through "
                          "rotor.blade_reaction, mast.hub_acceleration is not index 1"), 0u) << problems;
}

}  // namespace
}  // namespace heerk_rotor
