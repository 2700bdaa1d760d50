#include "heerk_rotor/config/yaml_value.hpp"

#include <clocale>
#include <limits>
#include <locale>

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

/// Decimal comma and points between thousands, as in many European locales.
struct CommaNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

class NumberTest : public testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(NumberTest, isReadExactly) {
  double number = 0.0;
  ASSERT_TRUE(readNumber(YAML::Load(GetParam().first), number)) << GetParam().first;
  EXPECT_EQ(number, GetParam().second);
}

INSTANTIATE_TEST_SUITE_P(YamlValue, NumberTest,
                         testing::Values(std::make_pair("3e6", 3e6), std::make_pair("3.0e+6", 3e6), std::make_pair("1.0e-3", 1e-3),
                                         std::make_pair("3.E2", 300.0), std::make_pair(".5", 0.5), std::make_pair("-.5", -0.5),
                                         std::make_pair("+12", 12.0), std::make_pair("0", 0.0), std::make_pair("0.1", 0.1),
                                         std::make_pair("-0.0263157894737", -0.0263157894737), std::make_pair("1234567.875", 1234567.875),
                                         std::make_pair("1.7976931348623157e308", std::numeric_limits<double>::max()),
                                         std::make_pair("2.2250738585072014e-308", std::numeric_limits<double>::min())));

class NoNumberTest : public testing::TestWithParam<const char*> {};

TEST_P(NoNumberTest, isRefusedAndLeavesTheValue) {
  double number = 7.0;
  EXPECT_FALSE(readNumber(YAML::Load(GetParam()), number)) << GetParam();
  EXPECT_EQ(number, 7.0);
}

INSTANTIATE_TEST_SUITE_P(YamlValue, NoNumberTest,
                         testing::Values(".nan", ".inf", "-.inf", "nan", "inf", "1e999", "0x10", "0o17", "010", "-007", "1_000", "1,5", "1 2", "3e", "e3", ".",
                                         "+", "-", "--1", "1.2.3", "3kg", "1e5.0", "\"3\"", "'3'", "true", "~", "[1]", "{a: 1}", "text"));

TEST(YamlValue, readsNumbersInAnyLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
  double number = 0.0;
  const bool read = readNumber(YAML::Load("1234.5"), number);
  std::locale::global(before);
  EXPECT_TRUE(read);
  EXPECT_EQ(number, 1234.5);
}

TEST(YamlValue, readsWholeNumbersOnly) {
  long number = 5;
  EXPECT_TRUE(readInteger(YAML::Load("-12"), number));
  EXPECT_EQ(number, -12);
  EXPECT_TRUE(readInteger(YAML::Load("+4"), number));
  EXPECT_EQ(number, 4);
  for (const char* text : {"4.0", "1e3", "04", "0x4", "\"4\"", "99999999999999999999", "+-4", "+", "", "[4]"}) {
    EXPECT_FALSE(readInteger(YAML::Load(text), number)) << text;
  }
  EXPECT_EQ(number, 4);
}

TEST(YamlValue, findsValuesByDottedKeyAndIndex) {
  const YAML::Node root = YAML::Load("a: {b: [10, {c: 20}]}\n7: seven");
  EXPECT_EQ(findValue(root, "a.b.0").Scalar(), "10");
  EXPECT_EQ(findValue(root, "a.b.1.c").Scalar(), "20");
  EXPECT_EQ(findValue(root, "7").Scalar(), "seven");
  EXPECT_TRUE(findValue(root, "").is(root));
  for (const char* key : {"b", "a.c", "a.b.2", "a.b.-1", "a.b.00", "a.b.0.x", "a.b.x", "a.b.99999999999999999999999"}) {
    EXPECT_FALSE(findValue(root, key).IsDefined()) << key;
  }
}

TEST(YamlValue, lookingForAbsentKeysAddsNothing) {
  const YAML::Node root = YAML::Load("a: 1");
  findValue(root, "b.c");
  EXPECT_EQ(root.size(), 1u);
}

TEST(YamlValue, showsValuesOnOneLineAsWritten) {
  EXPECT_EQ(asWritten(YAML::Load("3.0e+6")), "3.0e+6");
  EXPECT_EQ(asWritten(YAML::Load("'3'")), "\"3\"");
  EXPECT_EQ(asWritten(YAML::Load("~")), "(empty)");
  EXPECT_EQ(asWritten(YAML::Node(YAML::NodeType::Undefined)), "(missing)");
  EXPECT_EQ(asWritten(YAML::Load("- 1\n- a: 2\n")), "[1, {a: 2}]");
  EXPECT_EQ(asWritten(YAML::Load("|\n  one\n  two\n")), "\"one\\ntwo\\n\"");
  const std::string text = asWritten(YAML::Load(std::string(200, 'x')));
  EXPECT_EQ(text, std::string(77, 'x') + "...");
}

TEST(YamlValue, shortensBetweenCharacters) {
  EXPECT_EQ(shortened("abc\xc3\xa4" "efgh", 7), "abc...");  // byte 4 is the second half of an a with dots
}

TEST(YamlValue, textKeepsTypesAndScalars) {
  const std::string source = "a: 3.0e+6\nb: \"1.0\"\nc: [1, .5, {d: ~}]\ne: |\n  x\n  y\nf: \"a: b # c\"\ng: {h: -1.10}\n'~': []\nk: {}\n";
  const YAML::Node once = YAML::Load(yamlText(YAML::Load(source)));
  EXPECT_EQ(once["a"].Scalar(), "3.0e+6");
  EXPECT_EQ(once["b"].Scalar(), "1.0");
  EXPECT_TRUE(isQuoted(once["b"]));
  EXPECT_FALSE(isQuoted(once["a"]));
  EXPECT_EQ(once["c"][1].Scalar(), ".5");
  EXPECT_TRUE(once["c"][2]["d"].IsNull());
  EXPECT_EQ(once["e"].Scalar(), "x\ny\n");
  EXPECT_EQ(once["f"].Scalar(), "a: b # c");
  EXPECT_EQ(once["g"]["h"].Scalar(), "-1.10");
  EXPECT_TRUE(once["~"].IsSequence());
  EXPECT_TRUE(once["k"].IsMap());
  EXPECT_EQ(yamlText(once), yamlText(YAML::Load(source)));
}

}  // namespace
}  // namespace heerk_rotor
