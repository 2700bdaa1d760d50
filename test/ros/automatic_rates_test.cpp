#include "heerk_rotor/ros/automatic_rates.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace heerk_rotor {
namespace {

TEST(AutomaticRates, areThoseOfEveryStepAtOneDegreeOfARotor) {
  for (const double rotor_speed : {40.123, 41.0, 44.4}) {
    const Rates rates = chooseRates(NodeParameters(), M_PI / 180.0 / rotor_speed);
    EXPECT_EQ(rates.steps_per_wake, 1) << rotor_speed;
    EXPECT_EQ(rates.publish_every, 4) << rotor_speed;
    EXPECT_EQ(rates.lcm_every, 1) << rotor_speed;
  }
}

TEST(AutomaticRates, keepWakeUpsAndMessagesFewAtTheStepOfAShaft) {
  const Rates rates = chooseRates(NodeParameters(), 1e-5);
  EXPECT_EQ(rates.steps_per_wake, 40);
  EXPECT_EQ(rates.publish_every, 100);
  EXPECT_EQ(rates.lcm_every, 40);
}

TEST(AutomaticRates, neverExceedTheirLimitsWhateverTheStep) {
  for (double step = 1e-7; step < 0.1; step *= 1.07) {
    const Rates rates = chooseRates(NodeParameters(), step);
    EXPECT_GE(rates.steps_per_wake * step, 0.374e-3) << step;
    EXPECT_GE(rates.publish_every * step, 0.999e-3) << step;
    EXPECT_GE(rates.lcm_every * step, 0.333e-3) << step;
    // And no coarser than the next round number asks for.
    EXPECT_TRUE(rates.publish_every == 1 || rates.publish_every * step < 2.001e-3) << step;
  }
}

TEST(AutomaticRates, leaveAloneWhatIsGiven) {
  NodeParameters parameters;
  parameters.steps_per_wake = 3;
  parameters.publish_every = 7;
  parameters.lcm_every = 1;
  const Rates rates = chooseRates(parameters, 1e-5);
  EXPECT_EQ(rates.steps_per_wake, 3);
  EXPECT_EQ(rates.publish_every, 7);
  EXPECT_EQ(rates.lcm_every, 1);
}

TEST(AutomaticRates, wakeUpsCountInRealTimeMessagesInSimulationTime) {
  NodeParameters parameters;
  parameters.real_time_factor = 0.1;
  const Rates slow = chooseRates(parameters, 1e-5);
  EXPECT_EQ(slow.steps_per_wake, 4);
  EXPECT_EQ(slow.publish_every, 100);
  parameters.real_time_factor = 0.0;  // as fast as possible
  EXPECT_EQ(chooseRates(parameters, 1e-5).steps_per_wake, 40);
}

}  // namespace
}  // namespace heerk_rotor
