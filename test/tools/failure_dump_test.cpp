#include "heerk_rotor/tools/failure_dump.hpp"

#include <gtest/gtest.h>

#include "heerk_rotor/tools/csv_recorder.hpp"
#include "heerk_rotor/tools/signal_selection.hpp"
#include "small_system.hpp"
#include "test_files.hpp"

namespace heerk_rotor {
namespace {

TEST(RecentInstants, keepsTheLastRevolution) {
  const auto simulation = smallSimulation(0.01);
  RecentInstants recent(*simulation, 0.05);  // five steps, six instants
  EXPECT_EQ(recent.capacity(), 6u);
  EXPECT_EQ(recent.size(), 0u);
  Vector w = simulation->system().defaultCommand();
  std::vector<Vector> states;
  for (int k = 0; k < 20; ++k) {
    w[0] = k;
    states.push_back(simulation->state());
    recent.push(*simulation, w);
    ASSERT_EQ(simulation->step(w), StepStatus::kOk);
    EXPECT_EQ(recent.size(), static_cast<std::size_t>(std::min(k + 1, 6)));
  }
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(recent.step(i), 14 + i);
    EXPECT_EQ(recent.state(i), states[14 + i]);
    EXPECT_EQ(recent.command(i)[0], 14.0 + static_cast<double>(i));
  }
}

TEST(RecentInstants, memoryStaysBoundedForTinySteps) {
  const auto simulation = smallSimulation(1e-9);
  const RecentInstants recent(*simulation, 1.0);
  EXPECT_LE(recent.capacity() * 8 * 4, 64u << 20);  // step, two states, one command
  EXPECT_GT(recent.capacity(), 1000000u);
}

TEST(FailureDump, repeatsWhatARecorderWouldHaveWritten) {
  const TestFolder folder;
  const auto simulation = smallSimulation(0.01);
  const std::vector<Signal> all = selectSignals(simulation->system(), {"all"});
  CsvRecorder recorder(folder.file("x.csv"), simulation->system(), all, 3.0, {});
  simulation->addObserver(recorder);
  RecentInstants recent(*simulation, 0.03);
  Vector w = simulation->system().defaultCommand();
  for (int k = 0; k < 10; ++k) {
    w[0] = 0.1 * k;
    recent.push(*simulation, w);
    ASSERT_EQ(simulation->step(w), StepStatus::kOk);
  }
  recorder.close();
  writeFailureDump(folder.file("x.csv.failure.csv"), *simulation, recent, all, 3.0);

  const Table recorded = parseTable(readText(folder.file("x.csv")));
  const Table dumped = parseTable(readText(folder.file("x.csv.failure.csv")));
  ASSERT_EQ(recorded.rows.size(), 10u);
  ASSERT_EQ(dumped.rows.size(), 4u);
  for (std::size_t row = 0; row < 4; ++row)
    for (const std::string& cell : recorded.header)
      EXPECT_EQ(dumped.rows[row][dumped.column(cell)], recorded.rows[6 + row][recorded.column(cell)]) << cell << " in row " << row;
}

}  // namespace
}  // namespace heerk_rotor
