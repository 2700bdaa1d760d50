#include "heerk_rotor/aero/c81_reader.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "aero/shipped_deck.hpp"
#include "heerk_rotor/aero/c81_writer.hpp"

namespace heerk_rotor {
namespace {

// 2 Mach numbers, 3 angles in each block; line numbers on the right.
std::string small() {
  return
      "SMALL                          2 3 2 3 2 3\n"  // 1
      "          0.00  0.900\n"                       // 2
      "-180.00 0.1000 0.2000\n"                       // 3
      "   0.00 0.3000 0.4000\n"                       // 4
      " 180.00 0.1000 0.2000\n"                       // 5
      "          0.00  0.900\n"                       // 6
      "-180.00 0.0100 0.0200\n"                       // 7
      "   0.00 0.0110 0.0210\n"                       // 8
      " 180.00 0.0100 0.0200\n"                       // 9
      "          0.00  0.900\n"                       // 10
      "-180.00-0.1000-0.2000\n"                       // 11
      "   0.00 0.0000 0.0000\n"                       // 12
      " 180.00-0.1000-0.2000\n";                      // 13
}

std::string replaced(std::string text, const std::string& old, const std::string& with) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::logic_error("no '" + old + "' in the deck");
  return text.replace(at, old.size(), with);
}

std::string withLine(int number, const std::string& with) {
  std::istringstream in(small());
  std::string result;
  int k = 0;
  for (std::string line; std::getline(in, line);) result += (++k == number ? with : line) + "\n";
  return result;
}

C81Reading read(const std::string& text) {
  std::istringstream in(text);
  return readC81(in, "deck.c81");
}

std::string joined(const std::vector<std::string>& lines) {
  std::string result;
  for (const std::string& line : lines) result += line + "\n";
  return result;
}

TEST(C81Reader, readsCountsAsMachThenAlpha) {
  const C81Reading reading = read(small());
  ASSERT_TRUE(reading.ok()) << joined(reading.problems);
  EXPECT_EQ(joined(reading.warnings), "");
  EXPECT_EQ(reading.deck.name, "SMALL");
  EXPECT_EQ(reading.deck.lift.mach, (std::vector<double>{0.0, 0.9}));
  EXPECT_EQ(reading.deck.lift.alpha_deg, (std::vector<double>{-180.0, 0.0, 180.0}));
  EXPECT_EQ(reading.deck.lift.values, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.1, 0.2}));
  EXPECT_EQ(reading.deck.drag.value(1, 1), 0.021);
  EXPECT_EQ(reading.deck.moment.value(2, 0), -0.1);
}

TEST(C81Reader, acceptsPreambleCarriageReturnsTrailingTextAndLinesAfterTheDeck) {
  std::string text = "A polar from somewhere, 12 columns\n\nMACH 0 TO 0.9\n" + small() + "END OF DECK 1.0 2.0\n";
  text = replaced(text, " 2 3 2 3 2 3", " 2 3 2 3 2 3  made by hand");
  text = replaced(text, " 0.3000 0.4000", " 0.3000 0.4000 stall 12.5");
  std::string dos;
  for (char c : text) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const C81Reading reading = read(dos);
  ASSERT_TRUE(reading.ok()) << joined(reading.problems);
  EXPECT_EQ(reading.deck.name, "SMALL");
  EXPECT_EQ(reading.deck.lift.values, read(small()).deck.lift.values);
}

TEST(C81Reader, readsNumbersThatTouchAndFortranForms) {
  // columns 1-7, 8-14, 15-21: adjacent; a whole number without point; exponents with and without letter
  const C81Reading adjacent = read(withLine(4, "      0-1.1612-1.1613"));
  ASSERT_TRUE(adjacent.ok()) << joined(adjacent.problems);
  EXPECT_EQ(adjacent.deck.lift.value(1, 0), -1.1612);
  EXPECT_EQ(adjacent.deck.lift.value(1, 1), -1.1613);
  const C81Reading forms = read(withLine(4, "   0.00 1.5D-1  15.-2"));
  ASSERT_TRUE(forms.ok()) << joined(forms.problems);
  EXPECT_EQ(forms.deck.lift.value(1, 0), 0.15);
  EXPECT_EQ(forms.deck.lift.value(1, 1), 0.15);
  const C81Reading whole = read(withLine(4, "   0.00      2     .5"));
  ASSERT_TRUE(whole.ok()) << joined(whole.problems);
  EXPECT_EQ(whole.deck.lift.value(1, 0), 2.0);
  EXPECT_EQ(whole.deck.lift.value(1, 1), 0.5);
}

TEST(C81Reader, readsTouchingCountsWithBlanks) {
  // "11771177 947": I2 counts 11,77 11,77 9,47, the last pair with a blank-padded 9
  C81Deck deck = read(small()).deck;
  const auto resize = [](C81Block& block, int machs, int alphas) {
    block.mach.clear();
    block.alpha_deg.clear();
    for (int j = 0; j < machs; ++j) block.mach.push_back(j * 0.1);
    for (int i = 0; i < alphas; ++i) block.alpha_deg.push_back(-90.0 + i);
    block.values.clear();
    for (int i = 0; i < machs * alphas; ++i) block.values.push_back(i * 0.01 - 1.0);
  };
  resize(deck.lift, 11, 39);
  resize(deck.drag, 19, 65);
  resize(deck.moment, 9, 47);
  std::ostringstream out;
  writeC81(out, deck);
  EXPECT_EQ(out.str().substr(30, 12), "11391965 947");
  const C81Reading reading = read(out.str());
  ASSERT_TRUE(reading.ok()) << joined(reading.problems);
  for (auto block : {&C81Deck::lift, &C81Deck::drag, &C81Deck::moment}) {
    EXPECT_EQ((reading.deck.*block).mach.size(), (deck.*block).mach.size());
    ASSERT_EQ((reading.deck.*block).values.size(), (deck.*block).values.size());
    for (std::size_t i = 0; i < (deck.*block).values.size(); ++i)
      EXPECT_NEAR((reading.deck.*block).values[i], (deck.*block).values[i], 1e-12);  // two decimals fit in any case
  }
}

TEST(C81Reader, shippedDeckSurvivesARoundTrip) {
  const C81Deck deck = test::shippedDeck();
  EXPECT_EQ(deck.lift.mach.size(), 11u);
  EXPECT_EQ(deck.lift.alpha_deg.size(), 77u);
  std::ostringstream out;
  writeC81(out, deck);
  const C81Reading reading = read(out.str());
  ASSERT_TRUE(reading.ok()) << joined(reading.problems);
  EXPECT_EQ(joined(reading.warnings), "");
  EXPECT_EQ(reading.deck.lift.values, deck.lift.values);
  EXPECT_EQ(reading.deck.drag.values, deck.drag.values);
  EXPECT_EQ(reading.deck.moment.values, deck.moment.values);
  EXPECT_EQ(reading.deck.moment.alpha_deg, deck.moment.alpha_deg);
}

struct Malformed {
  const char* name;
  std::string text;
  std::string problem;  // its beginning, with file and line
};
void PrintTo(const Malformed& m, std::ostream* out) { *out << m.name; }

class C81ReaderRefuses : public testing::TestWithParam<Malformed> {};

TEST_P(C81ReaderRefuses, withFileAndLine) {
  const C81Reading reading = read(GetParam().text);
  ASSERT_FALSE(reading.ok());
  EXPECT_EQ(reading.problems.front().substr(0, GetParam().problem.size()), GetParam().problem) << joined(reading.problems);
}

std::string cut(int lines) {
  std::istringstream in(small());
  std::string result, line;
  for (int k = 0; k < lines && std::getline(in, line); ++k) result += line + "\n";
  return result;
}

INSTANTIATE_TEST_SUITE_P(
    Deck, C81ReaderRefuses,
    testing::Values(Malformed{"empty", "", "deck.c81:1: the file ends without a header"},
                    Malformed{"noHeader", "only text\nmore text\n", "deck.c81:2: the file ends without a header"},
                    Malformed{"countsInWrongColumns", withLine(1, "SMALL 2 3 2 3 2 3"), "deck.c81:13: the file ends without a header"},
                    Malformed{"letterInCounts", withLine(1, "SMALL                          2 3 2 x 2 3"), "deck.c81:13: the file ends without a header"},
                    Malformed{"zeroMachs", withLine(1, "SMALL                          0 3 2 3 2 3"), "deck.c81:1: the count of Mach numbers of the lift block is 0, expected at least 1"},
                    Malformed{"oneAngle", withLine(1, "SMALL                          2 3 2 3 2 1"), "deck.c81:1: the count of angles of the moment block is 1, expected at least 2"},
                    Malformed{"endsInMachs", cut(1), "deck.c81:1: the file ends here, expected the Mach numbers of the lift block"},
                    Malformed{"endsInRows", cut(12), "deck.c81:12: the file ends here, expected row 3 of 3 of the moment block"},
                    Malformed{"blankValue", withLine(4, "   0.00 0.3000"), "deck.c81:4: columns 15 to 21 are blank, expected row 2 of 3 of the lift block, number 2 of 2"},
                    Malformed{"letters", withLine(8, "   0.00  0.0l1 0.0210"), "deck.c81:8: found '0.0l1' in columns 8 to 14, expected row 2 of 3 of the drag block"},
                    Malformed{"nan", withLine(8, "   0.00    nan 0.0210"), "deck.c81:8: found 'nan' in columns 8 to 14"},
                    Malformed{"overflow", withLine(8, "   0.00  1e999 0.0210"), "deck.c81:8: found '1e999' in columns 8 to 14"},
                    Malformed{"twoNumbersInAField", withLine(8, "   0.00 .1  .2 0.0210"), "deck.c81:8: found '.1  .2' in columns 8 to 14"},
                    Malformed{"shiftedByAColumn", withLine(8, "    0.00 0.0110 0.0210"), "deck.c81:8: found '0 0.011' in columns 8 to 14"},
                    Malformed{"tab", withLine(8, "   0.00\t0.0110 0.0210"), "deck.c81:8: found a tab"},
                    Malformed{"missingAngle", withLine(8, "        0.0110 0.0210"), "deck.c81:8: columns 1 to 7 are blank, expected alpha [deg]"},
                    Malformed{"alphaFalls", withLine(5, "-170.00 0.1000 0.2000"), "deck.c81:5: alpha = -170 deg follows 0, expected increasing values"},
                    Malformed{"alphaTwice", withLine(5, "   0.00 0.1000 0.2000"), "deck.c81:5: alpha = 0 deg follows 0"},
                    Malformed{"alphaBeyondATurn", withLine(5, " 190.00 0.1000 0.2000"), "deck.c81:5: found alpha = 190 deg, expected -180 to 180"},
                    Malformed{"machFalls", withLine(10, "          0.90   0.50"), "deck.c81:10: Mach number 0.5 of the moment block follows 0.9"},
                    Malformed{"machNegative", withLine(10, "         -0.10   0.50"), "deck.c81:10: found Mach number -0.1 of the moment block"},
                    Malformed{"oneRowTooMany", withLine(1, "SMALL                          2 2 2 3 2 3"), "deck.c81:5: found '180.00' in columns 1 to 7, expected them blank"},
                    Malformed{"countsSwapped", withLine(1, "SMALL                          3 2 3 2 3 2"), "deck.c81:2: columns 22 to 28 are blank, expected Mach numbers of the lift block, number 3 of 3"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(C81Reader, refusesAnAngleInPlaceOfAContinuationLine) {
  C81Deck deck = test::shippedDeck();
  std::ostringstream out;
  writeC81(out, deck);
  std::istringstream in(out.str());
  std::string text, line;
  for (int k = 1; std::getline(in, line); ++k)
    if (k != 5) text += line + "\n";  // line 5 continues the row of line 4
  const C81Reading reading = read(text);
  ASSERT_FALSE(reading.ok());
  EXPECT_EQ(reading.problems.front().rfind("deck.c81:5: found '-170.00' in columns 1 to 7, expected them blank: a continuation line (11 Mach numbers", 0), 0u) << joined(reading.problems);
  EXPECT_LE(reading.problems.size(), 21u);  // a shifted file shall not flood the terminal
}

TEST(C81Reader, reportsSeveralProblemsAtOnce) {
  const C81Reading reading = read(replaced(replaced(small(), "0.3000", "0.3O00"), "0.0210", "?.0210"));
  ASSERT_EQ(reading.problems.size(), 2u) << joined(reading.problems);
  EXPECT_EQ(reading.problems[0].rfind("deck.c81:4: ", 0), 0u);
  EXPECT_EQ(reading.problems[1].rfind("deck.c81:8: ", 0), 0u);
}

TEST(C81Reader, namesAFileThatCannotBeOpened) {
  const C81Reading reading = readC81File("/nonexistent/deck.c81");
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_EQ(reading.problems.front(), "/nonexistent/deck.c81: cannot be opened, expected an airfoil deck in the C81 format");
}

TEST(C81Reader, warnsOfDoubtfulDecks) {
  const auto warns = [](C81Deck deck, const std::string& text) {
    std::ostringstream out;
    writeC81(out, deck);
    const C81Reading reading = read(out.str());
    EXPECT_TRUE(reading.ok()) << joined(reading.problems);
    for (const std::string& warning : reading.warnings)
      if (warning.rfind("deck.c81:1: ", 0) == 0 && warning.find(text) != std::string::npos) return true;
    return false;
  };
  const C81Deck good = read(small()).deck;
  C81Deck deck = good;
  deck.drag = deck.moment = deck.lift;
  EXPECT_TRUE(warns(deck, "a placeholder deck"));
  deck = good;
  deck.drag.value(1, 0) = -0.01;
  EXPECT_TRUE(warns(deck, "drag is negative"));
  deck = good;
  deck.moment.mach = {0.2, 0.7};
  EXPECT_TRUE(warns(deck, "of the moment block end at 0.7 (below 0.8)"));
  deck = good;
  deck.drag.alpha_deg = {-30, 0, 30};
  EXPECT_TRUE(warns(deck, "alpha of the drag block spans -30 to 30 deg"));
  deck = good;
  deck.lift.value(2, 1) = 0.3;
  EXPECT_TRUE(warns(deck, "values of the lift block differ at -180 and 180 deg"));
}

TEST(C81Writer, refusesWhatTheFormatCannotHold) {
  std::ostringstream out;
  C81Deck deck = read(small()).deck;
  deck.lift.values.pop_back();
  EXPECT_THROW(writeC81(out, deck), std::invalid_argument);
  deck = read(small()).deck;
  deck.lift.values[0] = 1e9;
  EXPECT_THROW(writeC81(out, deck), std::invalid_argument);
  deck = read(small()).deck;
  deck.lift.mach.assign(100, 0.0);
  deck.lift.values.assign(300, 0.0);
  EXPECT_THROW(writeC81(out, deck), std::invalid_argument);
}

}  // namespace
}  // namespace heerk_rotor
