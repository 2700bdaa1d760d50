#include "heerk_rotor/tools/csv_recorder.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "heerk_rotor/tools/number_text.hpp"
#include "heerk_rotor/tools/signal_selection.hpp"
#include "small_system.hpp"
#include "test_files.hpp"

namespace heerk_rotor {
namespace {

/// Remembers x and y of every instant, to compare with what was written.
struct Memory final : Observer {
  std::vector<std::uint64_t> steps;
  std::vector<Vector> x, y;
  void observe(const Sample& sample) noexcept override {
    steps.push_back(sample.step);
    x.push_back(sample.x);
    y.push_back(sample.y);
  }
};

Table record(Simulation& simulation, CsvRecorder& recorder, Memory& memory, int steps) {
  simulation.addObserver(recorder);
  simulation.addObserver(memory);
  const Vector w = simulation.system().defaultCommand();
  for (int k = 0; k < steps; ++k) EXPECT_EQ(simulation.step(w), StepStatus::kOk);
  EXPECT_EQ(simulation.observe(w), StepStatus::kOk);
  recorder.close();
  return parseTable(readText(recorder.file()));
}

TEST(CsvRecorder, headerHasFixedColumnsThenSignalsWithUnits) {
  const TestFolder folder;
  const CoupledSystem system = smallSystem();
  CsvRecorder recorder(folder.file("x.csv"), system, selectSignals(system, {"tank.b", "tank.hidden"}), 2.0, {});
  recorder.close();
  EXPECT_EQ(readText(recorder.file()), "step [-],time [s],azimuth [rad],tank.b_1 [m/s],tank.hidden [-]\n");
}

TEST(CsvRecorder, unitsWithACommaAreQuoted) {
  const TestFolder folder;
  const CoupledSystem system = smallSystem();
  std::vector<Signal> signals = selectSignals(system, {"tank.b", "tank.hidden"});
  signals[0].unit = "N, N m";  // of a port of forces and moments
  CsvRecorder recorder(folder.file("x.csv"), system, signals, 2.0, {});
  recorder.close();
  EXPECT_EQ(readText(recorder.file()), "step [-],time [s],azimuth [rad],\"tank.b_1 [N, N m]\",tank.hidden [-]\n");
}

TEST(CsvRecorder, everyNumberReadsBackBitByBit) {
  const TestFolder folder;
  const auto simulation = smallSimulation();
  const std::vector<Signal> signals = selectSignals(simulation->system(), {"all"});
  CsvRecorder recorder(folder.file("x.csv"), simulation->system(), signals, 2.0, {});
  Memory memory;
  const Table table = record(*simulation, recorder, memory, 50);
  ASSERT_EQ(table.rows.size(), 51u);
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    EXPECT_EQ(table.number(row, "step [-]"), static_cast<double>(memory.steps[row]));
    EXPECT_EQ(table.number(row, "time [s]"), static_cast<double>(row) * 0.01);
    for (std::size_t i = 0; i < signals.size(); ++i) {
      const double expected = signals[i].kind == Signal::Kind::kState ? memory.x[row][signals[i].index] : memory.y[row][signals[i].index];
      EXPECT_EQ(std::strtod(table.rows[row][i + 3].c_str(), nullptr), expected) << signals[i].name << " in row " << row;
    }
  }
}

TEST(CsvRecorder, recordsTheFirstInstantAndEveryNthAfterIt) {
  const TestFolder folder;
  const auto simulation = smallSimulation();
  simulation->step(simulation->system().defaultCommand());  // a run need not begin at step 0
  CsvRecorder recorder(folder.file("x.csv"), simulation->system(), selectSignals(simulation->system(), {}), 2.0, {simulation->stepCount(), 4});
  Memory memory;
  const Table table = record(*simulation, recorder, memory, 10);
  ASSERT_EQ(table.rows.size(), 3u) << "steps 1, 5, 9; the last instant, 11, is not on the grid";
  EXPECT_EQ(table.rows[0][0], "1");
  EXPECT_EQ(table.rows[1][0], "5");
  EXPECT_EQ(table.rows[2][0], "9");
}

TEST(CsvRecorder, azimuthIsNominalSpeedTimesTimeUnlessAPortGivesIt) {
  const TestFolder folder;
  for (const bool with_port : {false, true}) {
    const auto simulation = smallSimulation(0.01, with_port);
    CsvRecorder recorder(folder.file("x.csv"), simulation->system(), selectSignals(simulation->system(), {}), 2.0, {});
    Memory memory;
    const Table table = record(*simulation, recorder, memory, 3);
    EXPECT_EQ(table.number(3, "azimuth [rad]"), with_port ? 100.0 + 0.03 : 2.0 * 0.03);
  }
}

TEST(CsvRecorder, aFileThatCannotBeOpenedIsNamedWithTheReason) {
  const CoupledSystem system = smallSystem();
  try {
    CsvRecorder recorder("/nowhere/at/all.csv", system, selectSignals(system, {}), 1.0, {});
    FAIL() << "opened a file in a folder that does not exist";
  } catch (const RecordError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/at/all.csv: No such file or directory");
  }
}

TEST(CsvRecorder, aFullDiskIsFoundWhenTheFileIsOpened) {
  const CoupledSystem system = smallSystem();
  EXPECT_THROW(CsvRecorder("/dev/full", system, selectSignals(system, {}), 1.0, {}), RecordError);
}

TEST(NumberText, isPrintfWithSeventeenDigits) {
  const double cases[] = {0.0, -0.0, 1.0, -1.0 / 3.0, 0.1, 1e16, 123456789012345678.0, 1e17, 1e-4, 1e-5, 5e-324, -1.7976931348623157e308,
                          2.2250738585072014e-308, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), std::nan("")};
  for (const double value : cases) {
    char expected[64], found[kLongestNumber];
    std::snprintf(expected, sizeof expected, "%.17g", value);
    EXPECT_EQ(std::string(found, writeNumber(found, value)), expected);
  }
}

}  // namespace
}  // namespace heerk_rotor
