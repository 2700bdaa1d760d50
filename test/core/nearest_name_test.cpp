#include "heerk_rotor/core/nearest_name.hpp"

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

TEST(NearestName, findsTheNameWithTheSmallestEditDistance) {
  EXPECT_EQ(nearestName("stifness", {"mass", "stiffness", "damping"}), "stiffness");
  EXPECT_EQ(nearestName("lag_damping", {"lag_frequency", "lag_damper"}), "lag_damper");
}

TEST(NearestName, countsSwappedNeighboursAsOneSlip) {
  // "ab" is one swap from "ba", but two substitutions from "cd"; both limits are half of two letters.
  EXPECT_EQ(nearestName("ba", {"ab"}), "ab");
  EXPECT_EQ(nearestName("ba", {"cd"}), "");
}

TEST(NearestName, putsTheWordBeforeItsCase) {
  EXPECT_EQ(nearestName("herk4", {"HEERK4", "HERK4"}), "HERK4");
  EXPECT_EQ(nearestName("Mast", {"MAST", "mast"}), "mast");
}

TEST(NearestName, suggestsNothingFartherThanHalfTheLength) {
  EXPECT_EQ(nearestName("abcd", {"abxy"}), "abxy");  // two of four letters
  EXPECT_EQ(nearestName("abcd", {"axyz"}), "");      // three of four
  EXPECT_EQ(nearestName("abcd", {}), "");
  EXPECT_EQ(nearestName("", {"a"}), "");
}

TEST(NearestName, keepsTheFirstOfEquallyNearNames) {
  EXPECT_EQ(nearestName("lag_5", {"lag_1", "lag_2"}), "lag_1");
}

TEST(NearestName, writesTheQuestionOnlyWhenThereIsAnAnswer) {
  EXPECT_EQ(didYouMean("stifness", {"stiffness"}), " (did you mean 'stiffness'?)");
  EXPECT_EQ(didYouMean("stifness", {"mass"}), "");
}

}  // namespace
}  // namespace heerk_rotor
