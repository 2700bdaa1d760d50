#include "heerk_rotor/tools/command_file.hpp"

#include <gtest/gtest.h>

#include "heerk_rotor/config/problems.hpp"

namespace heerk_rotor {
namespace {

const std::string kHeader = "time,collective,lateral_cyclic,longitudinal_cyclic\n";

std::vector<Problem> problemsOf(const std::string& text) {
  try {
    parseCommandFile(text, "c.csv");
  } catch (const ConfigurationError& error) {
    return error.problems.list();
  }
  return {};
}

TEST(CommandFile, readsRowsExactly) {
  const auto rows = parseCommandFile(kHeader + "0,0.1,-0.2,3e-3\n1.5,0.30000000000000004,0,0\n", "c.csv");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].time, 0.0);
  EXPECT_EQ(rows[0].commands, (std::array<double, 3>{0.1, -0.2, 3e-3}));
  EXPECT_EQ(rows[1].time, 1.5);
  EXPECT_EQ(rows[1].commands[0], 0.30000000000000004);
}

TEST(CommandFile, takesColumnsInAnyOrderWithUnitsCommentsAndForeignLineEnds) {
  const auto rows = parseCommandFile("\xEF\xBB\xBF# a step\r\n longitudinal_cyclic [rad], time [s] ,collective[rad],lateral_cyclic\r\n\r\n 4, 1, 2, 3 \r\n", "c.csv");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].time, 1.0);
  EXPECT_EQ(rows[0].commands, (std::array<double, 3>{2.0, 3.0, 4.0}));
}

struct BadCase {
  std::string text, where, key, found;
};

TEST(CommandFile, namesLineColumnAndValueOfEveryFault) {
  const std::vector<BadCase> cases = {
      {kHeader + "0,0,0,0\n1,x,0,0\n", "c.csv:3", "collective", "x"},
      {kHeader + "0,0,nan,0\n", "c.csv:2", "lateral_cyclic", "nan"},
      {kHeader + "0,0,0,inf\n", "c.csv:2", "longitudinal_cyclic", "inf"},
      {kHeader + "0,0,,0\n", "c.csv:2", "lateral_cyclic", "(empty)"},
      {kHeader + "0,0,0,0 rad\n", "c.csv:2", "longitudinal_cyclic", "0 rad"},
      {kHeader + "0,0,0,0\n0,0,0,0\n", "c.csv:3", "time", "0"},
      {kHeader + "1,0,0,0\n0.5,0,0,0\n", "c.csv:3", "time", "0.5"},
      {kHeader + "0,0,0\n", "c.csv:2", "row", "3 cells"},
      {kHeader + "0,0,0,0,0\n", "c.csv:2", "row", "5 cells"},
      {"0,0.1,0,0\n1,0.2,0,0\n", "c.csv:1", "column 1", "0"},
      {"time,collectiv,lateral_cyclic,longitudinal_cyclic\n", "c.csv:1", "column 2", "collectiv"},
      {"time,collective,lateral_cyclic\n0,0,0\n", "c.csv:1", "longitudinal_cyclic", "no such column"},
      {"time,collective [deg],lateral_cyclic,longitudinal_cyclic\n", "c.csv:1", "collective", "[deg]"},
      {"time,time,collective,lateral_cyclic,longitudinal_cyclic\n", "c.csv:1", "time", "two columns"},
      {kHeader, "c.csv", "rows", "nothing"},
      {"", "c.csv", "header", "nothing"},
  };
  for (const BadCase& bad : cases) {
    const auto problems = problemsOf(bad.text);
    ASSERT_FALSE(problems.empty()) << bad.text;
    EXPECT_EQ(problems.front().where, bad.where) << bad.text;
    EXPECT_EQ(problems.front().key, bad.key) << bad.text;
    EXPECT_EQ(problems.front().found, bad.found) << bad.text;
  }
}

TEST(CommandFile, reportsAllFaultsOfAFile) { EXPECT_EQ(problemsOf(kHeader + "0,a,0,0\n1,0,b,c\n2,0,0\n").size(), 4u); }

TEST(CommandFile, saysWhyAFileCannotBeRead) {
  try {
    readCommandFile("/nowhere/at/all.csv");
    FAIL() << "a file that does not exist was read";
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all.csv"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
  }
  EXPECT_THROW(readCommandFile("/"), ConfigurationError);
}

TEST(CommandSchedule, holdsEachRowUntilTheNextOne) {
  CommandSchedule schedule({{0.1, {1, 2, 3}}, {0.2, {4, 5, 6}}}, {3, 1, 0}, 1e-9);
  Vector w(4);
  w << 10, 20, 30, 40;
  const Vector before = w;
  schedule.apply(0.0, w);
  EXPECT_EQ(w, before) << "before the first row the command stays";
  schedule.apply(0.1, w);
  EXPECT_EQ(w, (Vector(4) << 3, 2, 30, 1).finished());
  schedule.apply(0.15, w);
  EXPECT_EQ(w, (Vector(4) << 3, 2, 30, 1).finished());
  schedule.apply(7.0, w);
  EXPECT_EQ(w, (Vector(4) << 6, 5, 30, 4).finished());
}

TEST(CommandSchedule, isNotLateThroughRoundOff) {
  const double t = 3 * 0.7;  // 2.0999999999999996, one step before 2.1 only on paper
  ASSERT_LT(t, 2.1);
  CommandSchedule schedule({{2.1, {1, 1, 1}}}, {0, 1, 2}, 1e-9);
  Vector w = Vector::Zero(3);
  schedule.apply(t, w);
  EXPECT_EQ(w[0], 1.0);
}

TEST(CommandSchedule, startsInTheMiddleOfAContinuedRun) {
  CommandSchedule schedule({{0.0, {1, 1, 1}}, {1.0, {2, 2, 2}}, {3.0, {3, 3, 3}}}, {0, 1, 2}, 1e-9);
  Vector w = Vector::Zero(3);
  schedule.apply(2.0, w);
  EXPECT_EQ(w[0], 2.0);
}

}  // namespace
}  // namespace heerk_rotor
