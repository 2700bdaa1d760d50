// The program from outside: exit status, options, files.
#include <csignal>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <yaml-cpp/yaml.h>

#include "full_disk.hpp"
#include "program.hpp"

namespace heerk_rotor {
namespace {

const std::string kLagRotor = shippedConfiguration("lag_rotor.yaml");
const std::string kControlled = shippedConfiguration("lag_rotor_controlled.yaml");

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The JSON summary of a run that must succeed.
YAML::Node summary(std::vector<std::string> arguments) {
  arguments.push_back("--json");
  const Finished run = simulate(arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  return YAML::Load(run.out);
}
std::string hash(const std::vector<std::string>& arguments) { return summary(arguments)["state_hash"].as<std::string>(); }

TEST(SimulateProgram, runsTheShippedConfiguration) {
  const Finished run = simulate({kLagRotor, "--duration", "1"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(mentions(run.out, "done: 1000 steps, 1 s simulated")) << run.out;
  EXPECT_EQ(run.err, "") << "no warning, and no progress bar on what is no terminal";
}

TEST(SimulateProgram, jsonIsTheWholeStandardOutput) {
  const Finished run = simulate({kLagRotor, "--duration", "0.5", "--json"});
  const YAML::Node object = YAML::Load(run.out);
  EXPECT_EQ(object["steps"].as<int>(), 500);
  EXPECT_EQ(object["simulated_time"].as<double>(), 0.5);
  EXPECT_EQ(object["solves"].as<int>(), 2500) << "five stages of HEERK4";
  EXPECT_EQ(object["status"].as<std::string>(), "done");
  EXPECT_EQ(object["state_hash"].as<std::string>().size(), 16u);
  EXPECT_GT(object["wall_time"].as<double>(), 0.0);
}

TEST(SimulateProgram, quietSaysNothing) {
  const Finished run = simulate({kLagRotor, "--duration", "0.00025", "--quiet"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out + run.err, "");
}

TEST(SimulateProgram, setChangesTheResult) {
  const std::string plain = hash({kLagRotor, "--duration", "0.1"});
  EXPECT_EQ(plain, hash({kLagRotor, "--duration", "0.1"})) << "the same run twice";
  EXPECT_NE(plain, hash({kLagRotor, "--duration", "0.1", "--set", "subsystems.mast.stiffness=3e6"}));
  EXPECT_EQ(plain, hash({kLagRotor, "--duration", "0.1", "--set", "subsystems.mast.stiffness=30000"}));
}

TEST(SimulateProgram, setOfOneStepKeyReplacesTheOther) {
  EXPECT_EQ(summary({kLagRotor, "--revolutions", "2", "--set", "simulation.azimuth_step_deg=1"})["steps"].as<int>(), 720);
  EXPECT_EQ(summary({kControlled, "--duration", "0.1", "--set", "simulation.step=1e-3"})["steps"].as<int>(), 100);
}

TEST(SimulateProgram, warnsWhenTheDurationIsNoMultipleOfTheStep) {
  const Finished run = simulate({kLagRotor, "--duration", "0.0104"});
  EXPECT_EQ(run.status, 0);
  EXPECT_TRUE(mentions(run.err, "warning") && mentions(run.err, "running 10 steps")) << run.err;
}

TEST(SimulateProgram, aFileWithStateAndSignalsFollowsEveryAndTheGrid) {
  const TestFolder folder;
  const std::string file = folder.file("x.csv");
  ASSERT_EQ(simulate({kLagRotor, "--duration", "0.025", "--every", "10", "--output", file, "--signals", "rotor.lag,mast.twist"}).status, 0);
  const Table table = parseTable(readText(file));
  EXPECT_EQ(table.header, (std::vector<std::string>{"step [-]", "time [s]", "azimuth [rad]", "rotor.lag_1 [rad]", "rotor.lag_2 [rad]",
                                                    "rotor.lag_3 [rad]", "rotor.lag_4 [rad]", "mast.twist [rad]"}));
  ASSERT_EQ(table.rows.size(), 3u) << "steps 0, 10 and 20; 25 is not on the grid";
  EXPECT_EQ(table.rows[0][3], "0.01") << "the initial instant";
  EXPECT_EQ(table.rows[2][0], "20");
  EXPECT_NEAR(table.number(2, "azimuth [rad]"), 6.63 * 0.02, 1e-3);
}

TEST(SimulateProgram, recordingDoesNotChangeTheSolution) {
  const TestFolder folder;
  const std::vector<std::string> run = {kControlled, "--duration", "0.2", "--quiet"};
  std::vector<std::string> recorded = run;
  recorded.insert(recorded.end(), {"--output", folder.file("x.csv"), "--signals", "all"});
  EXPECT_EQ(hash(run), hash(recorded));
}

TEST(SimulateProgram, badInputIsStatusTwoWithAllProblems) {
  const TestFolder folder;
  const std::string bad = folder.write("bad.yaml", readText(kLagRotor) + "extra: 1\n");
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> cases = {
      {{}, {"CONFIG"}},
      {{"/nowhere.yaml"}, {"/nowhere.yaml", "No such file"}},
      {{bad}, {bad + ":", "extra"}},
      {{kLagRotor, "--set", "subsystems.mast.stiffnes=1"}, {"did you mean", "stiffness"}},
      {{kLagRotor, "--set", "subsystems.mast.stiffness=-1", "--set", "subsystems.rotor.blade_mass=heavy"}, {"stiffness", "blade_mass", "heavy"}},
      {{kLagRotor, "--signals", "rotor.lgg"}, {"--signals", "rotor.lgg", "did you mean"}},
      {{kLagRotor, "--duration", "1e300"}, {"--duration", "2^53"}},
      {{kLagRotor, "--output", "/nowhere/x.csv"}, {"/nowhere/x.csv", "No such file or directory"}},
      {{kLagRotor, "--output", "/nowhere/x.bag", "--output", "/nowhere/x.lcm"}, {"/nowhere/x.bag", "/nowhere/x.lcm"}},
      {{kLagRotor, "--save-snapshot", "/nowhere/x"}, {"--save-snapshot", "/nowhere/x"}},
      {{kLagRotor, "--load-snapshot", "/nowhere/x"}, {"/nowhere/x"}},
      {{"--load-snapshot", kLagRotor}, {kLagRotor}},
      {{kLagRotor, "--commands", "/nowhere/c.csv"}, {"/nowhere/c.csv", "No such file"}},
  };
  for (const auto& [arguments, parts] : cases) {
    const Finished run = simulate(arguments);
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_EQ(run.out, "");
    for (const std::string& part : parts) EXPECT_TRUE(mentions(run.err, part)) << "expected \"" << part << "\" in: " << run.err;
  }
}

TEST(SimulateProgram, aBadConfigurationLeavesAnOldResultAlone) {
  const TestFolder folder;
  const std::string old = folder.write("x.csv", "old result");
  ASSERT_EQ(simulate({kLagRotor, "--signals", "nothing.here", "--output", old}).status, 2);
  EXPECT_EQ(readText(old), "old result");
}

TEST(SimulateProgram, divergenceIsStatusThreeWithTheLastRevolutionBesideTheOutput) {
  const TestFolder folder;
  const std::string file = folder.file("x.csv");
  const Finished run = simulate({kLagRotor, "--set", "simulation.integrator=HERK4", "--set", "simulation.step=0.1", "--output", file, "--json"});
  EXPECT_EQ(run.status, 3);
  const std::string status = YAML::Load(run.out)["status"].as<std::string>();
  EXPECT_TRUE(status == "non_finite" || status == "solver_stalled") << status;
  EXPECT_TRUE(mentions(run.err, "step ") && mentions(run.err, "t = ") && mentions(run.err, "rotor.") && mentions(run.err, "HERK4")) << run.err;
  EXPECT_TRUE(mentions(run.err, file + ".failure.csv")) << run.err;
  const Table recorded = parseTable(readText(file)), last = parseTable(readText(file + ".failure.csv"));
  ASSERT_FALSE(last.rows.empty());
  EXPECT_LE(last.rows.size(), 11u) << "one revolution is 9.48 steps";
  EXPECT_EQ(last.rows.back()[0], recorded.rows.back()[0]) << "both end with the last good instant";
  EXPECT_EQ(last.rows.back()[last.column("rotor.lag_1 [rad]")], recorded.rows.back()[recorded.column("rotor.lag_1 [rad]")]);
}

TEST(SimulateProgram, aDivergingRunWithoutOutputWritesToTheWorkingFolder) {
  const TestFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const int status = simulate({kLagRotor, "--set", "simulation.integrator=HERK4", "--set", "simulation.step=0.1"}).status;
  std::filesystem::current_path(before);
  EXPECT_EQ(status, 3);
  EXPECT_TRUE(std::filesystem::exists(folder.file("simulate.failure.csv")));
}

TEST(SimulateProgram, aDiskThatFillsUpIsStatusOneWithCompleteRows) {
  const TestFolder folder;
  const std::string file = folder.file("x.csv");
  const Finished run = [&] {
    const FullDisk full(1234567);
    return simulate({kLagRotor, "--duration", "1000", "--output", file});
  }();
  EXPECT_EQ(run.status, 1);
  EXPECT_TRUE(mentions(run.err, file + ": writing failed (File too large)")) << run.err;
  const std::string text = readText(file);
  EXPECT_GT(text.size(), 1200000u);
  EXPECT_EQ(text.back(), '\n');
  const Table table = parseTable(text);
  EXPECT_EQ(table.rows.back().size(), table.header.size());
  EXPECT_TRUE(mentions(run.out, "output_failed")) << run.out;
}

/// Columns time and swashplate.collective of a short run with a command step at 0.05 s.
TEST(SimulateProgram, commandsMoveTheSwashplateFromTheirTimeOn) {
  const TestFolder folder;
  const std::string commands = folder.write("c.csv", "time,collective,lateral_cyclic,longitudinal_cyclic\n0.05,0.2,0.01,-0.02\n");
  const std::string plain = folder.file("plain.csv"), moved = folder.file("moved.csv");
  const std::vector<std::string> run = {kControlled, "--set", "simulation.step=1e-3", "--duration", "0.3", "--output"};
  std::vector<std::string> with = run, without = run;
  without.push_back(plain);
  with.insert(with.end(), {moved, "--commands", commands});
  ASSERT_EQ(simulate(without).status, 0);
  ASSERT_EQ(simulate(with).status, 0);
  const Table a = parseTable(readText(plain)), b = parseTable(readText(moved));
  ASSERT_EQ(a.rows.size(), 301u);
  for (std::size_t k = 0; k <= 50; ++k) ASSERT_EQ(a.rows[k], b.rows[k]) << "row " << k << " is before the command acts";
  EXPECT_NE(a.rows[51], b.rows[51]) << "the step from 0.05 s on has the new command";
  EXPECT_NEAR(b.number(300, "swashplate.collective [rad]"), 0.2, 0.01) << "a quarter second later: ten time constants of 1/40 s";
  EXPECT_NEAR(a.number(300, "swashplate.collective [rad]"), 0.17, 1e-9) << "the trim value";
}

TEST(SimulateProgram, commandsBeyondTheTravelAreClampedWithAWarning) {
  const TestFolder folder;
  const std::string far = folder.write("far.csv", "time,collective,lateral_cyclic,longitudinal_cyclic\n0,1.0,0,-0.5\n");
  const std::string stop = folder.write("stop.csv", "time,collective,lateral_cyclic,longitudinal_cyclic\n0,0.349,0,-0.1745\n");
  const Finished clamped = simulate({kControlled, "--revolutions", "1", "--commands", far, "--json"});
  const Finished allowed = simulate({kControlled, "--revolutions", "1", "--commands", stop, "--json"});
  ASSERT_EQ(clamped.status, 0) << clamped.err;
  EXPECT_TRUE(mentions(clamped.err, "swashplate.collective of 1 rows clamped to the travel [-0.0524, 0.349] rad")) << clamped.err;
  EXPECT_TRUE(mentions(clamped.err, "swashplate.longitudinal_cyclic of 1 rows clamped")) << clamped.err;
  EXPECT_FALSE(mentions(allowed.err, "clamped")) << allowed.err;
  const auto hash = [](const std::string& json) { return json.substr(json.find("state_hash")); };
  EXPECT_EQ(hash(clamped.out), hash(allowed.out));
}

TEST(SimulateProgram, commandsNeedASwashplate) {
  const TestFolder folder;
  const std::string commands = folder.write("c.csv", "time,collective,lateral_cyclic,longitudinal_cyclic\n0,0,0,0\n");
  const Finished run = simulate({kLagRotor, "--commands", commands});
  EXPECT_EQ(run.status, 2);
  EXPECT_TRUE(mentions(run.err, "swashplate") && mentions(run.err, "no commands")) << run.err;
}

TEST(SimulateProgram, badCommandFilesAreStatusTwoWithLines) {
  const TestFolder folder;
  const std::string commands = folder.write("c.csv", "time,collective,lateral_cyclic,longitudinal_cyclic\n0,0,0,0\n0,nan,0,0\n");
  const Finished run = simulate({kControlled, "--commands", commands});
  EXPECT_EQ(run.status, 2);
  EXPECT_TRUE(mentions(run.err, commands + ":3: collective = nan")) << run.err;
}

TEST(SimulateProgram, continuingFromASnapshotIsBitwiseEqualToTheUninterruptedRun) {
  const TestFolder folder;
  const std::string snapshot = folder.file("half.snapshot");
  const std::string commands = folder.write("c.csv", "time,collective,lateral_cyclic,longitudinal_cyclic\n0,0.16,0,0\n0.08,0.18,0.02,0\n0.15,0.17,0,0.01\n");
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> cases = {
      {{kLagRotor}, {}},
      {{kLagRotor, "--set", "simulation.formulation=printed"}, {}},
      {{kLagRotor, "--set", "simulation.formulation=printed", "--set", "simulation.newton_tolerance=paper"}, {}},
      {{kControlled, "--set", "simulation.step=1e-3"}, {"--commands", commands}},
  };
  for (const auto& [system, with] : cases) {
    std::vector<std::string> whole = system, first = system, second = {"--load-snapshot", snapshot, "--duration", "0.1"};
    whole.insert(whole.end(), {"--duration", "0.2", "--output", folder.file("whole.csv"), "--signals", "all"});
    first.insert(first.end(), {"--duration", "0.1", "--save-snapshot", snapshot, "--output", folder.file("first.csv"), "--signals", "all"});
    second.insert(second.end(), {"--output", folder.file("second.csv"), "--signals", "all"});
    for (auto* arguments : {&whole, &first, &second}) arguments->insert(arguments->end(), with.begin(), with.end());
    const std::string uninterrupted = hash(whole);
    EXPECT_NE(hash(first), uninterrupted);
    EXPECT_EQ(hash(second), uninterrupted) << system.back();
    const Table a = parseTable(readText(folder.file("whole.csv"))), b = parseTable(readText(folder.file("second.csv")));
    ASSERT_EQ(a.rows.size(), 201u);
    ASSERT_EQ(b.rows.size(), 101u);
    for (std::size_t k = 0; k <= 100; ++k) ASSERT_EQ(a.rows[100 + k], b.rows[k]) << system.back();
  }
}

TEST(SimulateProgram, aConfigurationBesideASnapshotMustAgree) {
  const TestFolder folder;
  const std::string snapshot = folder.file("s");
  ASSERT_EQ(simulate({kLagRotor, "--duration", "0.01", "--save-snapshot", snapshot}).status, 0);
  EXPECT_EQ(simulate({kLagRotor, "--duration", "0.01", "--load-snapshot", snapshot}).status, 0);
  EXPECT_EQ(summary({"--load-snapshot", snapshot, "--set", "simulation.duration=0.02"})["steps"].as<int>(), 20);
  const Finished other = simulate({kLagRotor, "--set", "subsystems.mast.stiffness=1e6", "--load-snapshot", snapshot});
  EXPECT_EQ(other.status, 2);
  EXPECT_TRUE(mentions(other.err, "--set subsystems.mast.stiffness") && mentions(other.err, "as in the snapshot")) << other.err;
  EXPECT_EQ(simulate({kControlled, "--load-snapshot", snapshot}).status, 2);
}

TEST(SimulateProgram, listsSignalsInsteadOfRunning) {
  const Finished run = simulate({kLagRotor, "--list-signals"});
  EXPECT_EQ(run.status, 0) << run.err;
  for (const char* name : {"rotor.lag_1 ", "rotor.lag_rate_4 ", "rotor.fuselage_x ", "rotor.fuselage_y ", "mast.twist ", "[rad/s]", "lead positive"})
    EXPECT_TRUE(mentions(run.out, name)) << name << " in\n" << run.out;
}

/// Reads a pipe until it ends.
std::string readAll(int descriptor) {
  std::string text;
  char buffer[65536];
  for (ssize_t count; (count = ::read(descriptor, buffer, sizeof buffer)) > 0;) text.append(buffer, static_cast<std::size_t>(count));
  return text;
}

TEST(SimulateProgram, ctrlCEndsAtAStepWithCompleteFilesAndSnapshot) {
  const TestFolder folder;
  const std::string pipe = folder.file("pipe.csv"), snapshot = folder.file("s");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Program program({kLagRotor, "--duration", "1e6", "--output", pipe, "--save-snapshot", snapshot, "--json"});
  const int reader = ::open(pipe.c_str(), O_RDONLY);  // returns as soon as the program opens the other end
  ASSERT_GE(reader, 0);
  std::string text(200000, '\0');  // beyond the header: the steps are running
  std::size_t got = 0;
  while (got < text.size()) {
    const ssize_t count = ::read(reader, &text[got], text.size() - got);
    ASSERT_GT(count, 0);
    got += static_cast<std::size_t>(count);
  }
  ASSERT_EQ(::kill(program.process(), SIGINT), 0);
  text += readAll(reader);
  ::close(reader);
  EXPECT_EQ(program.wait(), 130) << program.err();
  const YAML::Node object = YAML::Load(program.out());
  EXPECT_EQ(object["status"].as<std::string>(), "interrupted");
  const Table table = parseTable(text);
  EXPECT_EQ(text.back(), '\n');
  ASSERT_EQ(table.rows.size(), object["steps"].as<std::size_t>() + 1) << "every step and the initial instant";
  for (std::size_t k = 0; k < table.rows.size(); ++k) ASSERT_EQ(table.rows[k][0], std::to_string(k));
  EXPECT_EQ(summary({"--load-snapshot", snapshot, "--duration", "0"})["state_hash"].as<std::string>(), object["state_hash"].as<std::string>());
}

}  // namespace
}  // namespace heerk_rotor
