#include "heerk_rotor/tools/run_summary.hpp"

#include <set>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

namespace heerk_rotor {
namespace {

RunSummary example() {
  RunSummary summary;
  summary.steps = 12345678901234ull;
  summary.simulated_time = 0.1;
  summary.wall_time = 0.4;
  summary.spent.solves = 5;
  summary.spent.newton_iterations = 6;
  summary.spent.residual_evaluations = 7;
  summary.spent.factorizations = 8;
  summary.state_hash = 0x00abcdef01234567ull;
  return summary;
}

TEST(RunSummary, jsonHasExactlyTheFieldsOfTheInterface) {
  const std::string text = json(example());
  EXPECT_EQ(text.back(), '\n');
  const YAML::Node object = YAML::Load(text);  // JSON is a subset of YAML
  std::set<std::string> keys;
  for (const auto& entry : object) keys.insert(entry.first.as<std::string>());
  EXPECT_EQ(keys, (std::set<std::string>{"steps", "simulated_time", "wall_time", "real_time_factor", "solves", "newton_iterations",
                                         "residual_evaluations", "factorizations", "status", "state_hash"}));
  EXPECT_EQ(object["steps"].as<std::uint64_t>(), 12345678901234ull);
  EXPECT_EQ(object["simulated_time"].as<double>(), 0.1);
  EXPECT_EQ(object["wall_time"].as<double>(), 0.4);
  EXPECT_EQ(object["real_time_factor"].as<double>(), 0.1 / 0.4);
  EXPECT_EQ(object["solves"].as<int>(), 5);
  EXPECT_EQ(object["newton_iterations"].as<int>(), 6);
  EXPECT_EQ(object["residual_evaluations"].as<int>(), 7);
  EXPECT_EQ(object["factorizations"].as<int>(), 8);
  EXPECT_EQ(object["status"].as<std::string>(), "done");
  EXPECT_EQ(object["state_hash"].as<std::string>(), "00abcdef01234567");
}

TEST(RunSummary, aRunWithoutStepsHasNoRealTimeFactor) {
  RunSummary summary = example();
  summary.steps = 0;
  EXPECT_NE(json(summary).find("\"real_time_factor\": null"), std::string::npos);
}

TEST(RunSummary, everyStatusHasItsOwnName) {
  std::set<std::string> names;
  for (const RunStatus status : {RunStatus::kDone, RunStatus::kInterrupted, RunStatus::kSolverStalled, RunStatus::kNonFinite, RunStatus::kOutputFailed})
    names.insert(name(status));
  EXPECT_EQ(names.size(), 5u);
}

}  // namespace
}  // namespace heerk_rotor
