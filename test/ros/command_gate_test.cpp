#include "heerk_rotor/ros/command_gate.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace heerk_rotor {
namespace {

using Verdict = CheckedCommand::Verdict;
using Values = std::array<double, 3>;
const CommandLimits kLimits{-0.05, 0.35, 0.17};

TEST(CommandGate, acceptsWhatIsWithinTheTravelIncludingItsEnds) {
  for (const Values& values : {Values{0.0, 0.0, 0.0}, Values{-0.05, 0.17, -0.17}, Values{0.35, -0.17, 0.17}}) {
    const CheckedCommand checked = checkCommand(values, kLimits);
    EXPECT_EQ(checked.verdict, Verdict::kAccepted);
    EXPECT_EQ(checked.values, values);
    EXPECT_EQ(checked.complaint, "");
  }
}

TEST(CommandGate, clampsEachValueToItsOwnTravel) {
  const CheckedCommand checked = checkCommand(Values{0.5, -0.2, 0.1}, kLimits);
  EXPECT_EQ(checked.verdict, Verdict::kClamped);
  EXPECT_EQ(checked.values, (Values{0.35, -0.17, 0.1}));
  EXPECT_EQ(checked.complaint, "collective = 0.5 rad, expected [-0.05, 0.35]; lateral_cyclic = -0.2 rad, expected [-0.17, 0.17]");
}

TEST(CommandGate, refusesWhatIsNotFiniteEvenIfTheRestIsGood) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const Values& values : {Values{nan, 0.0, 0.0}, Values{0.0, inf, 0.0}, Values{0.0, 0.0, -inf}, Values{0.5, nan, 0.0}, Values{nan, 0.5, 0.0}})
    EXPECT_EQ(checkCommand(values, kLimits).verdict, Verdict::kRefused);
}

TEST(CommandGate, refusesAnyOtherNumberOfValues) {
  for (const std::size_t n : {0u, 1u, 2u, 4u}) {
    const CheckedCommand checked = checkCommand(std::vector<double>(n, 0.0), kLimits);
    EXPECT_EQ(checked.verdict, Verdict::kRefused);
    EXPECT_NE(checked.complaint.find(std::to_string(n) + " values, expected 3"), std::string::npos);
  }
  EXPECT_EQ(checkCommand(std::vector<double>{0.1, 0.0, 0.0}, kLimits).verdict, Verdict::kAccepted);
}

}  // namespace
}  // namespace heerk_rotor
