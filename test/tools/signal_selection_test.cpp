#include "heerk_rotor/tools/signal_selection.hpp"

#include <gtest/gtest.h>

#include "heerk_rotor/config/problems.hpp"
#include "small_system.hpp"

namespace heerk_rotor {
namespace {

std::vector<std::string> namesOf(const std::vector<Signal>& signals) {
  std::vector<std::string> names;
  for (const Signal& signal : signals) names.push_back(signal.name);
  return names;
}
using Names = std::vector<std::string>;

TEST(SignalSelection, nothingAskedForMeansThePublishedOnes) {
  const CoupledSystem system = smallSystem();
  EXPECT_EQ(namesOf(selectSignals(system, {})), (Names{"tank.level_1", "tank.level_2", "tank.force_x", "tank.force_y", "tank.force_z"}));
}

TEST(SignalSelection, keepsTheOrderAskedForAndEachSignalOnce) {
  const CoupledSystem system = smallSystem();
  EXPECT_EQ(namesOf(selectSignals(system, {"tank.hidden", "tank.a", "tank.hidden"})), (Names{"tank.hidden", "tank.a"}));
}

TEST(SignalSelection, aBareNameMeansAllNumberedEntries) {
  const CoupledSystem system = smallSystem();
  EXPECT_EQ(namesOf(selectSignals(system, {"tank.level"})), (Names{"tank.level_1", "tank.level_2"}));
  EXPECT_EQ(namesOf(selectSignals(system, {"tank.b"})), (Names{"tank.b_1"})) << "states too";
  EXPECT_EQ(namesOf(selectSignals(system, {"tank.level_2", "tank.level"})), (Names{"tank.level_2", "tank.level_1"}));
}

TEST(SignalSelection, aPortMeansItsNamedEntries) {
  const CoupledSystem system = smallSystem();
  EXPECT_EQ(namesOf(selectSignals(system, {"tank.force"})), (Names{"tank.force_x", "tank.force_y", "tank.force_z"}));
}

TEST(SignalSelection, allMeansEveryStateAndOutput) {
  const CoupledSystem system = smallSystem();
  EXPECT_EQ(selectSignals(system, {"all"}).size(), system.signals().size());
  EXPECT_EQ(selectSignals(system, {"tank.hidden", "all"}).size(), system.signals().size());
}

TEST(SignalSelection, reportsEveryUnknownNameWithTheNearestOne) {
  const CoupledSystem system = smallSystem();
  try {
    selectSignals(system, {"tank.levle", "tank.a", "tank.level_3"});
    FAIL() << "unknown names were accepted";
  } catch (const ConfigurationError& error) {
    ASSERT_EQ(error.problems.list().size(), 2u);
    EXPECT_EQ(error.problems.list()[0].found, "tank.levle");
    EXPECT_NE(error.problems.list()[0].expected.find("did you mean 'tank.level'?"), std::string::npos) << error.what();
    EXPECT_NE(error.problems.list()[1].expected.find("did you mean 'tank.level_"), std::string::npos) << error.what();
  }
}

TEST(SignalTable, alignsColumnsAndMarksDefaults) {
  const CoupledSystem system = smallSystem();
  std::istringstream lines(signalTable(system));
  std::string header, line;
  std::getline(lines, header);
  const std::size_t unit = header.find("unit"), kind = header.find("kind"), published = header.find("default"), meaning = header.find("meaning");
  std::size_t count = 0;
  while (std::getline(lines, line)) {
    const Signal& signal = system.signals().at(count++);
    EXPECT_EQ(line.substr(0, line.find(' ')), signal.name);
    EXPECT_EQ(line.substr(unit, signal.unit.empty() ? 3 : signal.unit.size() + 2), signal.unit.empty() ? "[-]" : "[" + signal.unit + "]");
    EXPECT_EQ(line.substr(kind, 6), signal.kind == Signal::Kind::kState ? "state " : "output");
    EXPECT_EQ(line.substr(published, 3), signal.published ? "yes" : "no ");
    EXPECT_EQ(line.substr(meaning), signal.meaning);
  }
  EXPECT_EQ(count, system.signals().size());
}

}  // namespace
}  // namespace heerk_rotor
