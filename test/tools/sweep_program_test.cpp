// Sweeps from outside: the table, its independence of --jobs, failing runs, bad command lines.
#include <algorithm>
#include <csignal>

#include <gtest/gtest.h>
#include <sched.h>
#include <yaml-cpp/yaml.h>

#include "full_disk.hpp"
#include "program.hpp"

namespace heerk_rotor {
namespace {

const std::string kLagRotor = shippedConfiguration("lag_rotor.yaml");

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A grid of 3 x 2 runs of the lag rotor.
std::vector<std::string> grid(const std::string& output) {
  return {kLagRotor, "--sweep", "subsystems.mast.stiffness=3e4:3e8:3:log", "--sweep", "subsystems.rotor.lag_damper=0,500", "--duration", "2", "--signals", "rotor.lag_1,rotor.fuselage_x", "--output", output};
}

TEST(SweepProgram, theTableIsTheSameWhateverTheNumberOfJobs) {
  const TestFolder folder;
  std::vector<std::string> tables;
  for (const char* jobs : {"1", "2", "5"}) {
    const std::string file = folder.file(std::string("jobs_") + jobs + ".csv");
    const Finished run = simulate(with(grid(file), {"--jobs", jobs, "--quiet"}));
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out + run.err, "");
    tables.push_back(readText(file));
  }
  EXPECT_EQ(tables[0], tables[1]);
  EXPECT_EQ(tables[0], tables[2]);
}

TEST(SweepProgram, aRowPerRunInTheOrderOfTheGridWithUnits) {
  const TestFolder folder;
  const std::string file = folder.file("grid.csv");
  ASSERT_EQ(simulate(grid(file)).status, 0);
  const Table table = parseTable(readText(file));
  const std::vector<std::string> first(table.header.begin(), table.header.begin() + 12);
  EXPECT_EQ(first, (std::vector<std::string>{"run [-]", "subsystems.mast.stiffness [N m/rad]", "subsystems.rotor.lag_damper [N m s/rad]", "status [-]", "steps [-]", "time [s]", "state_hash [-]",
                                             "rotor.lag_1.final [rad]", "rotor.lag_1.mean [rad]", "rotor.lag_1.half_peak_to_peak [rad]", "rotor.lag_1.min [rad]", "rotor.lag_1.max [rad]"}));
  EXPECT_EQ(table.header.back(), "message [-]");
  ASSERT_EQ(table.rows.size(), 6u);
  const std::vector<std::pair<std::string, std::string>> order = {{"3e4", "0"}, {"3e4", "500"}, {"3000000", "0"}, {"3000000", "500"}, {"3e8", "0"}, {"3e8", "500"}};
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(table.rows[k][0], std::to_string(k));
    EXPECT_EQ(table.rows[k][1], order[k].first);
    EXPECT_EQ(table.rows[k][2], order[k].second);
    EXPECT_EQ(table.rows[k][3], "done");
    EXPECT_EQ(table.rows[k][4], "2000");
    EXPECT_EQ(table.rows[k].size(), table.header.size());
    EXPECT_EQ(table.rows[k].back(), "");
  }
}

TEST(SweepProgram, aRowSaysWhatTheRunAloneRecords) {
  const TestFolder folder;
  const std::string file = folder.file("grid.csv"), alone = folder.file("alone.csv");
  ASSERT_EQ(simulate(grid(file)).status, 0);
  const Finished run = simulate({kLagRotor, "--set", "subsystems.mast.stiffness=3000000", "--set", "subsystems.rotor.lag_damper=500", "--duration", "2", "--signals", "rotor.lag_1", "--output", alone, "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const Table swept = parseTable(readText(file)), recorded = parseTable(readText(alone));
  EXPECT_EQ(swept.rows[3][swept.column("state_hash [-]")], YAML::Load(run.out)["state_hash"].as<std::string>());
  EXPECT_EQ(swept.rows[3][swept.column("rotor.lag_1.final [rad]")], recorded.rows.back()[3]);
  double low = 1.0, high = -1.0, revolution_low = 1.0, revolution_high = -1.0;
  const double revolution = 2.0 * M_PI / 6.63;
  for (std::size_t k = 0; k < recorded.rows.size(); ++k) {
    const double lag = recorded.number(k, "rotor.lag_1 [rad]");
    low = std::min(low, lag);
    high = std::max(high, lag);
    if (recorded.number(k, "time [s]") < 2.0 - revolution) continue;
    revolution_low = std::min(revolution_low, lag);
    revolution_high = std::max(revolution_high, lag);
  }
  EXPECT_EQ(swept.number(3, "rotor.lag_1.min [rad]"), low);
  EXPECT_EQ(swept.number(3, "rotor.lag_1.max [rad]"), high);
  // The sweep's revolution begins within a step, up to one step's change (1e-3 s times the lag rate) before the first sample here.
  EXPECT_NEAR(swept.number(3, "rotor.lag_1.half_peak_to_peak [rad]"), 0.5 * (revolution_high - revolution_low), 1e-5);
}

TEST(SweepProgram, aFailingRunInTheMiddleLosesNoOther) {
  const TestFolder folder;
  const std::string runs = folder.write("runs.csv", "simulation.integrator,simulation.step,subsystems.mast.stiffness\nHEERK4,1e-3,3e4\nHERK4,0.1,3e8\nHEERK4,1e-3,-5\nHEERK2,1e-3,\n");
  const std::string reference = folder.file("1.csv"), file = folder.file("3.csv");
  const std::vector<std::string> sweep = {kLagRotor, "--sweep-file", runs, "--duration", "30", "--output"};
  EXPECT_EQ(simulate(with(sweep, {reference, "--jobs", "1"})).status, 3);
  const Finished run = simulate(with(sweep, {file, "--jobs", "3", "--json"}));
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(readText(reference), readText(file));
  EXPECT_TRUE(mentions(run.err, "run 1 failed first; non_finite") || mentions(run.err, "run 1 failed first; solver_stalled")) << run.err;
  const YAML::Node summary = YAML::Load(run.out);
  EXPECT_EQ(summary["runs"].as<int>(), 4);
  EXPECT_EQ(summary["done"].as<int>(), 4);
  EXPECT_EQ(summary["failed"].as<int>(), 2);
  const Table table = parseTable(readText(file));
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[0][4], "done");
  EXPECT_TRUE(mentions(table.rows[1].back(), "HERK4")) << "the likely cause: " << table.rows[1].back();
  EXPECT_LT(table.number(1, "steps [-]"), 300.0);
  EXPECT_EQ(table.rows[1][table.column("rotor.lag_1.mean [rad]")], "nan");
  EXPECT_EQ(table.rows[2][4], "bad_configuration");
  EXPECT_TRUE(mentions(table.rows[2].back(), "subsystems.mast.stiffness = -5: expected a number")) << table.rows[2].back();
  EXPECT_EQ(table.rows[3][4], "done");
  EXPECT_EQ(table.rows[3][3], "") << "the configuration's own value";
}

TEST(SweepProgram, aBadFirstRunIsARowToo) {
  const TestFolder folder;
  const std::string file = folder.file("x.csv");
  EXPECT_EQ(simulate({kLagRotor, "--sweep", "subsystems.mast.stiffness=-1,3e4", "--duration", "0.1", "--output", file}).status, 3);
  const Table table = parseTable(readText(file));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0][2], "bad_configuration");
  EXPECT_EQ(table.rows[1][2], "done");
}

TEST(SweepProgram, aSignalThatARunDoesNotHaveIsNan) {
  const TestFolder folder;
  const std::string file = folder.file("x.csv");
  const Finished run = simulate({shippedConfiguration("bo105.yaml"), "--set", "simulation.start=none", "--sweep", "subsystems.rotor.blades=4,3", "--signals", "rotor.lag", "--duration", "0.01", "--output", file});
  ASSERT_EQ(run.status, 0) << run.err;
  const Table table = parseTable(readText(file));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_NE(table.rows[0][table.column("rotor.lag_4.final [rad]")], "nan");
  EXPECT_EQ(table.rows[1][table.column("rotor.lag_4.final [rad]")], "nan");
  EXPECT_NE(table.rows[1][table.column("rotor.lag_3.final [rad]")], "nan");
}

TEST(SweepProgram, badSweepsAreStatusTwoWithOneErrorEach) {
  const TestFolder folder;
  const std::string old = folder.write("x.csv", "old result");
  const std::string runs = folder.write("runs.yaml", "- [subsystems.mast.stiffness=3e4]\n- [subsystems.mast.stiffnes=3e6]\n");
  const std::string many = "subsystems.mast.stiffness=1:2:10000";
  const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> cases = {
      {{"--sweep", "subsystems.mast.stiffnes=1,2", "--output", old}, {"--sweep subsystems.mast.stiffnes: subsystems.mast.stiffnes = 1: expected", "did you mean 'stiffness'"}},
      {{"--sweep", "subsystem.mast.stiffness=1,2", "--output", old}, {"subsystem.mast.stiffness = 1", "did you mean 'subsystems.mast.stiffness'"}},
      {{"--sweep", "subsystems.rotor.lag_damper.7=1,2", "--set", "subsystems.rotor.lag_damper=[1, 2, 3, 4]", "--output", old}, {"an index from 0 to 3"}},
      {{"--sweep", "simulation.stp=1,2", "--output", old}, {"simulation.stp", "did you mean 'step'"}},
      {{"--sweep-file", runs, "--output", old}, {runs + ": subsystems.mast.stiffnes = 3e6", "did you mean 'stiffness'"}},
      {{"--sweep-file", folder.file("none.csv"), "--output", old}, {"--sweep-file = " + folder.file("none.csv"), "No such file"}},
      {{"--sweep", "subsystems.mast.stiffness=", "--output", old}, {"(empty)", "at least one value"}},
      {{"--sweep", "subsystems.mast.stiffness=1:2:1", "--output", old}, {"1:2:1", "from 2"}},
      {{"--sweep", many, "--sweep", "subsystems.rotor.blade_mass=1:2:1000", "--output", old}, {"a grid of 10000 x 1000 runs", "at most 1000000"}},
      {{"--sweep", "subsystems.mast.stiffness=1,2"}, {"--output = nothing", "one FILE.csv"}},
      {{"--sweep", "subsystems.mast.stiffness=1,2", "--output", "x.bag"}, {"--output = 1 files, first x.bag", "one FILE.csv"}},
      {{"--sweep", "subsystems.mast.stiffness=1,2", "--output", "/nowhere/x.csv"}, {"/nowhere/x.csv", "No such file"}},
      {{"--sweep", "subsystems.mast.stiffness=1,2", "--output", old, "--signals", "rotor.lgg"}, {"--signals", "rotor.lgg", "did you mean"}},
      {{"--sweep", "subsystems.mast.stiffness=1,2", "--output", old, "--stability"}, {"--stability = given with a sweep", "one run"}},
      {{"--sweep", "subsystems.mast.stiffness=1,2", "--output", old, "--save-snapshot", "s"}, {"--save-snapshot = given with a sweep"}},
      {{"--sweep", "subsystems.mast.stiffness=1,2", "--output", old, "--jobs", "0"}, {"--jobs = 0", "from 1 to 1024"}},
      {{"--sweep", "subsystems.mast.stiffness=1,2", "--output", old, "--jobs", "two"}, {"--jobs = two"}},
      {{"--sweep", "subsystems.mast.stiffness=1,2", "--output", old, "--jobs", "-1"}, {"--jobs = -1"}},
      {{"--jobs", "2"}, {"--jobs = 2", "--sweep KEY=VALUES"}},
      {{"--sweep", "subsystems.mast.stiffness=-1,-2", "--output", old}, {"subsystems.mast.stiffness = -1", "expected a number"}},
  };
  for (const auto& [arguments, parts] : cases) {
    const Finished run = simulate(with({kLagRotor}, arguments));
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_EQ(run.out, "");
    for (const std::string& part : parts) EXPECT_TRUE(mentions(run.err, part)) << "expected \"" << part << "\" in: " << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << "one error: " << run.err;
    EXPECT_EQ(readText(old), "old result");
  }
}

TEST(SweepProgram, everyRunIsTrimmedWhenAsked) {
  const TestFolder folder;
  const std::string file = folder.file("x.csv");
  // Two modes per blade, three sections, a step of 5 degrees: a trim of a tenth of a second. The thrust asked for differs from run to run.
  const Finished run = simulate({shippedConfiguration("ground_resonance.yaml"), "--trim", "--set", "simulation.start=none", "--set", "subsystems.rotor.modes=2", "--set", "subsystems.rotor.sections=3",
                                 "--set", "subsystems.fuselage.mode=rigid", "--set", "simulation.azimuth_step_deg=5", "--sweep", "trim.targets.fuselage.hub_force_z=15000,18500", "--revolutions", "1",
                                 "--signals", "fuselage.hub_force_z,swashplate.collective", "--output", file});
  ASSERT_EQ(run.status, 0) << run.err << readText(file);
  const Table table = parseTable(readText(file));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_NEAR(table.number(0, "fuselage.hub_force_z.mean [N]"), 15000.0, 1e-3) << "a relative residual of at most 1e-9 of the target";
  EXPECT_NEAR(table.number(1, "fuselage.hub_force_z.mean [N]"), 18500.0, 1e-3);
  EXPECT_GT(table.number(1, "swashplate.collective.mean [rad]"), table.number(0, "swashplate.collective.mean [rad]"));
}

TEST(SweepProgram, offATerminalThereIsALinePerTenPerCent) {
  const TestFolder folder;
  const Finished run = simulate({kLagRotor, "--sweep", "subsystems.mast.stiffness=3e4:3e8:20:log", "--duration", "0.01", "--output", folder.file("x.csv"), "--jobs", "1"});
  EXPECT_EQ(run.status, 0);
  EXPECT_TRUE(mentions(run.err, "100 % (20 of 20 runs), 0 s left\n")) << run.err;
  EXPECT_LE(std::count(run.err.begin(), run.err.end(), '\n'), 10);
  EXPECT_FALSE(mentions(run.err, "\r")) << "no bar";
  EXPECT_TRUE(mentions(run.out, "sweep: 20 of 20 runs")) << run.out;
}

TEST(SweepProgram, withoutJobsThereIsOnePerProcessorThatTheProcessMayUse) {
  const TestFolder folder;
  cpu_set_t allowed, one;
  ASSERT_EQ(::sched_getaffinity(0, sizeof allowed, &allowed), 0);
  CPU_ZERO(&one);
  for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
    if (CPU_ISSET(cpu, &allowed)) CPU_SET(cpu, &one);
  const std::vector<std::string> sweep = {kLagRotor, "--sweep", "subsystems.mast.stiffness=3e4,3e5,3e6", "--duration", "0.01", "--json", "--output", folder.file("x.csv")};
  ::sched_setaffinity(0, sizeof one, &one);  // inherited by the program
  const Finished pinned = simulate(sweep);
  ::sched_setaffinity(0, sizeof allowed, &allowed);
  EXPECT_EQ(YAML::Load(pinned.out)["jobs"].as<int>(), 1);
  EXPECT_EQ(YAML::Load(simulate(sweep).out)["jobs"].as<int>(), std::min(3, CPU_COUNT(&allowed)));
  EXPECT_EQ(YAML::Load(simulate(with(sweep, {"--jobs", "7"})).out)["jobs"].as<int>(), 3) << "no more than runs";
}

TEST(SweepProgram, ctrlCKeepsTheFinishedRuns) {
  const TestFolder folder;
  const std::string file = folder.file("x.csv");
  Program program({kLagRotor, "--sweep", "simulation.duration=0.1,1e6,1e6,0.1", "--output", file, "--jobs", "1"});
  const auto lines = [&file] {
    const std::string text = std::filesystem::exists(file) ? readText(file) : "";
    return std::count(text.begin(), text.end(), '\n');
  };
  ASSERT_TRUE(program.computesUntil([&] { return lines() == 2; })) << "header and the first run";
  // The second run would take hours: what the program computes from here on, setting it up apart (a millisecond), is that run.
  const double first_run = program.cpuTime();
  ASSERT_TRUE(program.computesUntil([&] { return program.cpuTime() > first_run + 0.1; }));
  ASSERT_EQ(::kill(program.process(), SIGINT), 0);
  EXPECT_EQ(program.wait(), 130) << program.err();
  const Table table = parseTable(readText(file));
  ASSERT_EQ(table.rows.size(), 2u) << "the run in progress is a row, those not begun are none";
  EXPECT_EQ(table.rows[0][2], "done");
  EXPECT_EQ(table.rows[1][2], "interrupted");
}

TEST(SweepProgram, aDiskThatFillsUpIsStatusOneWithCompleteRows) {
  const TestFolder folder;
  const std::string file = folder.file("x.csv");
  const Finished run = [&] {
    const FullDisk full(12345);
    return simulate({kLagRotor, "--sweep", "subsystems.mast.stiffness=3e4:3e8:50:log", "--duration", "0.01", "--output", file});
  }();
  EXPECT_EQ(run.status, 1);
  EXPECT_TRUE(mentions(run.err, file + ": writing failed (File too large)")) << run.err;
  const std::string text = readText(file);
  EXPECT_EQ(text.back(), '\n');
  const Table table = parseTable(text);
  EXPECT_EQ(table.rows.back().size(), table.header.size());
}

}  // namespace
}  // namespace heerk_rotor
