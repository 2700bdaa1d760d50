#include "heerk_rotor/assembly/start_file.hpp"

#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "heerk_rotor/assembly/build_simulation.hpp"

namespace heerk_rotor {
namespace {

const std::string kControlled = HEERK_SOURCE_DIR "/config/lag_rotor_controlled.yaml";

/// The shipped configuration without its initial values, which would take precedence.
Configuration plain() { return Configuration::load(kControlled, {"subsystems.mast.initial={}", "subsystems.rotor.initial={}"}); }

struct Start {
  Vector x, w;
  std::string text;
};
Start randomStart(const CoupledSystem& system) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0), exponent(-12.0, 0.0);
  Start start{system.initialState(), system.defaultCommand(), ""};
  for (double& value : start.x) value = mantissa(random) * std::pow(10.0, exponent(random));
  for (Index i = 0; i < start.w.size(); ++i) start.w[i] = system.commandLow()[i] + 0.3 * (system.commandHigh()[i] - system.commandLow()[i]);
  start.text = startText(system, start.x, start.w, {{"made_by", "a test"}});
  return start;
}

bool same(const Vector& a, const Vector& b) { return a.size() == b.size() && std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0; }

std::string problemsWith(const std::string& text) {
  try {
    buildSystem(plain().withStart(text, "start.yaml"));
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "";
}

TEST(StartFile, readsBackBitByBit) {
  const CoupledSystem system = buildSystem(plain());
  const Start start = randomStart(system);
  const CoupledSystem started = buildSystem(plain().withStart(start.text, "start.yaml"));
  EXPECT_TRUE(same(started.initialState(), start.x));
  EXPECT_TRUE(same(started.defaultCommand(), start.w));
}

TEST(StartFile, isFoundBesideTheConfigurationAndStaysInTheResolvedText) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("start_file_test_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const Start start = randomStart(buildSystem(plain()));
  std::ofstream(folder / "start.yaml") << start.text;
  std::ofstream(folder / "rotor.yaml") << plain().resolvedText();
  const Configuration configuration = Configuration::load((folder / "rotor.yaml").string(), {"simulation.start=start.yaml"});
  EXPECT_EQ(configuration.where("simulation.start.states.mast.twist"), (folder / "start.yaml").string() + ":10");
  std::filesystem::remove_all(folder);
  auto simulation = buildSimulation(Configuration::parse(configuration.resolvedText(), "elsewhere"));
  EXPECT_TRUE(same(simulation->state(), start.x));
  simulation->reset();
  EXPECT_TRUE(same(simulation->state(), start.x)) << "reset goes back to the start";
}

TEST(StartFile, aMissingFileIsAProblemAtItsLine) {
  try {
    Configuration::load(kControlled, {"simulation.start=nowhere.yaml"});
    FAIL();
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("config/nowhere.yaml cannot be read"), std::string::npos) << error.what();
  }
}

TEST(StartFile, namesOfAnotherVariantArePassedOverWithANote) {
  const Configuration configuration = plain().withStart("states: {mast: {twisst: 0.1, twist: 0.5}, inflow: {mean: 0.05}}\ncommands: {tail: {pitch: 0.1}}", "start.yaml");
  const CoupledSystem system = buildSystem(configuration);
  Problems problems;
  const StartValues start = readStart(configuration, system, problems);
  EXPECT_TRUE(problems.empty()) << problems.text();
  ASSERT_EQ(start.states.size(), 1u);
  EXPECT_EQ(start.states[0].second, 0.5);
  ASSERT_GE(start.notes.size(), 2u);
  EXPECT_NE(start.notes[0].find("names 2 states: mast.twisst, inflow.mean"), std::string::npos) << start.notes[0];
  EXPECT_NE(start.notes.back().find("names 1 command: tail.pitch"), std::string::npos) << start.notes.back();
}

TEST(StartFile, badValuesAreProblems) {
  EXPECT_NE(problemsWith("states: {mast: {twist: often}}").find("a number"), std::string::npos);
  EXPECT_NE(problemsWith("commands: {swashplate: {collective: 3.0}}").find("a value in ["), std::string::npos);
  EXPECT_NE(problemsWith("command: {swashplate: {collective: 0.1}}").find("did you mean 'commands'?"), std::string::npos);
}

TEST(StartFile, givenInitialValuesTakePrecedenceAndTheRestIsNoted) {
  const Configuration configuration = Configuration::load(kControlled, {"subsystems.rotor.initial={}", "simulation.start={states: {mast: {twist: 0.5, twist_rate: 0.25}}}"});
  const CoupledSystem system = buildSystem(configuration);
  Problems problems;
  const StartValues start = readStart(configuration, system, problems);
  ASSERT_EQ(start.states.size(), 1u);
  EXPECT_EQ(start.states[0].second, 0.25);
  ASSERT_EQ(start.notes.size(), 2u);
  EXPECT_NE(start.notes[0].find("leaves out"), std::string::npos);
  EXPECT_NE(start.notes[1].find("mast.twist"), std::string::npos);
}

}  // namespace
}  // namespace heerk_rotor
