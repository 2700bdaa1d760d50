// --trim, --stability, --show-coupling and --evaluation-counts from outside.
#include <fstream>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "program.hpp"

namespace heerk_rotor {
namespace {

const std::string kControlled = shippedConfiguration("lag_rotor_controlled.yaml");

std::vector<std::string> trimTo(const std::string& thrust, const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {kControlled, "--trim", "--json", "--set", "trim.controls=[swashplate.collective]", "--set", "trim.targets={rotor.hub_force_z: " + thrust + "}"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(TrimProgram, aRunFromTheSavedStartIsTheTrimmedRun) {
  TestFolder folder;
  const std::string start = folder.file("start.yaml");
  const Finished trimmed = simulate(trimTo("20000", {"--save-start", start, "--revolutions", "2"}));
  ASSERT_EQ(trimmed.status, 0) << trimmed.err;
  const YAML::Node object = YAML::Load(trimmed.out);
  EXPECT_EQ(object["trim"]["status"].as<std::string>(), "trimmed");
  EXPECT_LE(object["stability"]["spectral_radius"].as<double>(), 1.0 + 1e-9);
  const Finished started = simulate({kControlled, "--json", "--revolutions", "2", "--set", "simulation.start=" + start, "--set", "subsystems.mast.initial={}", "--set",
                                     "subsystems.rotor.initial={}"});
  EXPECT_EQ(YAML::Load(started.out)["state_hash"].as<std::string>(), object["state_hash"].as<std::string>()) << started.err;
}

TEST(TrimProgram, anInfeasibleTargetEndsWithStatusThree) {
  const Finished run = simulate(trimTo("80000", {"--duration", "1"}));
  EXPECT_EQ(run.status, 3);
  const YAML::Node object = YAML::Load(run.out);
  EXPECT_NE(object["trim"]["message"].as<std::string>().find("upper limit"), std::string::npos);
  EXPECT_FALSE(object["steps"]) << "no run follows";
}

TEST(AnalysesProgram, couplingAndCountsAreJson) {
  TestFolder folder;
  const std::string picture = folder.file("coupling.svg");
  const Finished run = simulate({kControlled, "--show-coupling", picture, "--evaluation-counts", "--json", "--set", "simulation.formulation=printed"});
  ASSERT_EQ(run.status, 0) << run.err;
  const YAML::Node object = YAML::Load(run.out);
  EXPECT_EQ(object["coupling"]["loops"].size(), 1u);
  EXPECT_EQ(object["coupling"]["loops"][0]["pruned"]["unknowns"].as<int>(), 2) << "blade reaction and hub acceleration";
  EXPECT_EQ(object["evaluations"]["subsystems"]["rotor"]["f"].as<int>(), 5) << "stages of HEERK4";
  EXPECT_NE(readText(picture).find("</svg>"), std::string::npos);
}

TEST(AnalysesProgram, withoutTrimTheFinalStateIsTheStartThatIsSaved) {
  TestFolder folder;
  const std::string first = folder.file("first.yaml"), second = folder.file("second.yaml");
  const Finished run = simulate({kControlled, "--quiet", "--revolutions", "1", "--save-start", first});
  ASSERT_EQ(run.status, 0) << run.err;
  // Another step begins exactly there.
  const Finished other = simulate({kControlled, "--quiet", "--revolutions", "0", "--save-start", second, "--set", "simulation.azimuth_step_deg=0.5", "--set",
                                   "simulation.start=" + first, "--set", "subsystems.mast.initial={}", "--set", "subsystems.rotor.initial={}"});
  ASSERT_EQ(other.status, 0) << other.err;
  const YAML::Node a = YAML::LoadFile(first), b = YAML::LoadFile(second);
  EXPECT_EQ(YAML::Dump(a["states"]), YAML::Dump(b["states"]));
  EXPECT_EQ(YAML::Dump(a["commands"]), YAML::Dump(b["commands"]));
  EXPECT_NE(a["states"]["rotor"]["absolute_lag_1"].as<double>(), 0.0);
}

}  // namespace
}  // namespace heerk_rotor
