#include "heerk_rotor/config/section.hpp"

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

class SectionTest : public testing::Test {
 protected:
  Section section(const std::string& lines, const std::vector<std::string>& overrides = {}) {
    configuration_ = Configuration::parse("subsystems:\n  a:\n" + lines, "t.yaml", overrides);
    return Section(configuration_, "subsystems.a", problems_);
  }
  Configuration configuration_;
  Problems problems_;
};

TEST_F(SectionTest, readsNumbersInTheirRange) {
  Section s = section("    mass: 31.9\n    offset: -1e-3\n");
  EXPECT_EQ(s.number("mass", 1.0, "kg", positive()), 31.9);
  EXPECT_EQ(s.requiredNumber("offset", "m"), -1e-3);
  EXPECT_EQ(s.number("absent", 4.0, "kg"), 4.0);
  s.finish();
  EXPECT_EQ(problems_.text(), "");
}

TEST_F(SectionTest, reportsNumbersThatAreNoneOrOutOfRangeAndGoesOnWithTheDefault) {
  Section s = section("    mass: -3\n    zero: 0\n    text: heavy\n    nan: .nan\n    list: [1]\n    high: 2\n    nothing:\n");
  EXPECT_EQ(s.number("mass", 1.0, "kg", nonNegative()), 1.0);
  EXPECT_EQ(s.number("zero", 2.0, "kg", positive()), 2.0);
  EXPECT_EQ(s.number("text", 3.0, "kg"), 3.0);
  EXPECT_EQ(s.number("nan", 4.0, "kg"), 4.0);
  EXPECT_EQ(s.number("list", 5.0, "kg"), 5.0);
  EXPECT_EQ(s.number("high", 0.5, "", Range{0.0, 1.0, true}), 0.5);
  EXPECT_EQ(s.number("nothing", 7.0, "", Range{-std::numeric_limits<double>::infinity(), 1.0, false}), 7.0);
  EXPECT_EQ(problems_.text(),
            "t.yaml:3: subsystems.a.mass = -3: expected a number >= 0 [kg]\n"
            "t.yaml:4: subsystems.a.zero = 0: expected a number > 0 [kg]\n"
            "t.yaml:5: subsystems.a.text = heavy: expected a number [kg]\n"
            "t.yaml:6: subsystems.a.nan = .nan: expected a number [kg]\n"
            "t.yaml:7: subsystems.a.list = [1]: expected a number [kg]\n"
            "t.yaml:8: subsystems.a.high = 2: expected a number in (0, 1]\n"
            "t.yaml:9: subsystems.a.nothing = (empty): expected a number <= 1");
}

TEST_F(SectionTest, standsInForAMissingRequiredNumberWithOneInRange) {
  Section s = section("    x: 1\n");
  Range small{0.0, 0.1, true};
  EXPECT_GT(s.requiredNumber("mass", "kg", positive()), 0.0);
  EXPECT_LE(s.requiredNumber("tolerance", "-", small), 0.1);
  EXPECT_EQ(s.requiredNumber("count", "-", Range{5.0, std::numeric_limits<double>::infinity(), false}), 5.0);
  ASSERT_EQ(problems_.list().size(), 3u);
  EXPECT_EQ(problems_.text().substr(0, problems_.text().find('\n')), "t.yaml:2: subsystems.a.mass = (missing): expected a number > 0 [kg]");
}

TEST_F(SectionTest, takesOneWordOrAListOfWords) {
  Section s = section("    one: a.c81\n    two: [a.c81, dir/b.c81]\n    none: []\n    nested: [a, [b]]\n    map: {a: 1}\n    nothing:\n");
  EXPECT_EQ(s.words("one"), std::vector<std::string>{"a.c81"});
  EXPECT_EQ(s.words("two"), (std::vector<std::string>{"a.c81", "dir/b.c81"}));
  EXPECT_TRUE(s.words("absent").empty());
  EXPECT_TRUE(problems_.empty());
  for (const char* key : {"none", "nested", "map", "nothing"}) EXPECT_TRUE(s.words(key).empty()) << key;
  s.finish();
  EXPECT_EQ(problems_.text(),
            "t.yaml:5: subsystems.a.none = []: expected a word, or a list of words\n"
            "t.yaml:6: subsystems.a.nested = [a, [b]]: expected a word, or a list of words\n"
            "t.yaml:7: subsystems.a.map = {a: 1}: expected a word, or a list of words\n"
            "t.yaml:8: subsystems.a.nothing = (empty): expected a word, or a list of words");
}

TEST_F(SectionTest, takesOneNumberForAllOrAListOfTheRightLength) {
  Section s = section("    one: 2\n    four: [1, 2, 3, 4]\n    three: [1, 2, 3]\n    bad: [1, x, 3, -4]\n    map: {a: 1}\n");
  EXPECT_EQ(s.numbers("one", 4, 0.0, "m"), std::vector<double>(4, 2.0));
  EXPECT_EQ(s.numbers("four", 4, 0.0, "m"), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(s.numbers("absent", 2, 7.0, "m"), std::vector<double>(2, 7.0));
  EXPECT_EQ(problems_.text(), "");
  EXPECT_EQ(s.numbers("three", 4, 7.0, "m"), std::vector<double>(4, 7.0));
  EXPECT_EQ(s.numbers("bad", 4, 7.0, "m", nonNegative()), (std::vector<double>{1, 7, 3, 7}));
  EXPECT_EQ(s.numbers("map", 2, 7.0, "m"), std::vector<double>(2, 7.0));
  EXPECT_EQ(problems_.text(),
            "t.yaml:5: subsystems.a.three = [1, 2, 3]: expected a number [m], or a list of 4 such numbers, not of 3\n"
            "t.yaml:6: subsystems.a.bad.1 = x: expected a number >= 0 [m]\n"
            "t.yaml:6: subsystems.a.bad.3 = -4: expected a number >= 0 [m]\n"
            "t.yaml:7: subsystems.a.map = {a: 1}: expected a number [m], or a list of 2 such numbers");
}

TEST_F(SectionTest, namesTheOverriddenElementOfAList) {
  Section s = section("    four: [1, 2, 3, 4]\n", {"subsystems.a.four.2=x"});
  EXPECT_EQ(s.numbers("four", 4, 0.0, "m"), (std::vector<double>{1, 2, 0, 4}));
  EXPECT_EQ(problems_.text(), "--set subsystems.a.four.2: subsystems.a.four.2 = x: expected a number [m]");
}

TEST_F(SectionTest, readsIntegersFlagsAndWords) {
  Section s = section("    n: 4\n    on: true\n    off: false\n    word: \"printed\"\n");
  EXPECT_EQ(s.integer("n", 1, 1, 8), 4);
  EXPECT_EQ(s.integer("absent", 3, 1, 8), 3);
  EXPECT_TRUE(s.flag("on", false));
  EXPECT_FALSE(s.flag("off", true));
  EXPECT_TRUE(s.flag("absent", true));
  EXPECT_EQ(s.word("word", "x", {"printed", "other"}), "printed");
  EXPECT_EQ(s.word("absent", "x", {"y"}), "x");
  EXPECT_EQ(s.text("n"), "4");
  EXPECT_EQ(s.text("absent"), "");
  EXPECT_EQ(problems_.text(), "");
}

TEST_F(SectionTest, reportsWrongIntegersFlagsAndWords) {
  Section s = section("    n: 9\n    m: 1.5\n    on: yes\n    quoted: \"true\"\n    word: printd\n    list: [a]\n    any: {}\n");
  EXPECT_EQ(s.integer("n", 1, 1, 8), 1);
  EXPECT_EQ(s.integer("m", 2, 1, 8), 2);
  EXPECT_FALSE(s.flag("on", false));
  EXPECT_FALSE(s.flag("quoted", false));
  EXPECT_EQ(s.word("word", "x", {"printed", "other"}), "x");
  EXPECT_EQ(s.word("list", "x", {"printed", "other"}), "x");
  EXPECT_EQ(s.word("any", "x"), "x");
  EXPECT_EQ(problems_.text(),
            "t.yaml:3: subsystems.a.n = 9: expected a whole number in [1, 8]\n"
            "t.yaml:4: subsystems.a.m = 1.5: expected a whole number in [1, 8]\n"
            "t.yaml:5: subsystems.a.on = yes: expected true or false\n"
            "t.yaml:6: subsystems.a.quoted = \"true\": expected true or false\n"
            "t.yaml:7: subsystems.a.word = printd: expected one of printed, other (did you mean 'printed'?)\n"
            "t.yaml:8: subsystems.a.list = [a]: expected one of printed, other\n"
            "t.yaml:9: subsystems.a.any = {}: expected a word");
}

TEST_F(SectionTest, reportsUnknownKeysOnceWithTheNearestKnownOne) {
  Section s = section("    stifness: 1\n    xyz: 2\n    mass: 3\n");
  s.number("stiffness", 0.0, "N/m");
  s.number("mass", 0.0, "kg");
  s.finish();
  s.finish();
  EXPECT_EQ(problems_.text(),
            "t.yaml:3: subsystems.a.stifness = 1: expected a known key (did you mean 'stiffness'?)\n"
            "t.yaml:4: subsystems.a.xyz = 2: expected one of the keys stiffness, mass");
}

TEST_F(SectionTest, blamesTheCommandLineForAnUnknownOverride) {
  Section s = section("    mass: 3\n", {"subsystems.a.stifness=1"});
  s.number("stiffness", 0.0, "N/m");
  s.number("mass", 0.0, "kg");
  s.finish();
  EXPECT_EQ(problems_.text(), "--set subsystems.a.stifness: subsystems.a.stifness = 1: expected a known key (did you mean 'stiffness'?)");
}

TEST_F(SectionTest, readsNestedMappings) {
  Section s = section("    inner:\n      x: 1\n      y: 2\n");
  Section inner = s.child("inner");
  EXPECT_EQ(inner.path(), "subsystems.a.inner");
  EXPECT_TRUE(inner.has("x"));
  EXPECT_FALSE(inner.has("z"));
  EXPECT_EQ(inner.number("x", 0.0, ""), 1.0);
  inner.finish();
  s.finish();
  EXPECT_EQ(problems_.text(), "t.yaml:5: subsystems.a.inner.y = 2: expected one of the keys x");
}

TEST_F(SectionTest, treatsAbsentAndEmptyMappingsAlike) {
  Section s = section("    inner:\n");
  for (const char* key : {"inner", "absent"}) {
    Section inner = s.child(key);
    EXPECT_EQ(inner.number("x", 5.0, ""), 5.0);
    inner.finish();
  }
  s.finish();
  EXPECT_EQ(problems_.text(), "");
}

TEST_F(SectionTest, reportsAValueWhereAMappingBelongs) {
  Section s = section("    inner: 5\n");
  Section inner = s.child("inner");
  EXPECT_EQ(inner.number("x", 7.0, ""), 7.0);
  inner.finish();
  s.finish();
  EXPECT_EQ(problems_.text(), "t.yaml:3: subsystems.a.inner = 5: expected a mapping of keys to values");
}

}  // namespace
}  // namespace heerk_rotor
