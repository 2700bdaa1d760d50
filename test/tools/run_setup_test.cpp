#include "heerk_rotor/tools/run_setup.hpp"

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

Configuration configuration(const std::string& step, const std::string& more = "") {
  return Configuration::parse("simulation: {step: " + step + ", rotor_speed: 10, duration: 1" + more +
                                  "}\nsubsystems:\n  rotor: {type: lag_rotor, initial: {lag_1: 0.1}}\nconnections:\n  - [a.b, c.d]\n",
                              "x.yaml");
}

TEST(Differences, numbersAreComparedAsNumbers) {
  EXPECT_TRUE(differences(configuration("1.0e-3"), configuration("0.001")).empty());
  EXPECT_FALSE(differences(configuration("1.0e-3"), configuration("0.0010001")).empty());
}

TEST(Differences, durationMayDiffer) {
  const Configuration longer = Configuration::parse(configuration("1").resolvedText(), "y.yaml", {"simulation.duration=99"});
  EXPECT_TRUE(differences(longer, configuration("1")).empty());
}

TEST(Differences, namesTheKeyBothValuesAndTheLine) {
  const auto changed = differences(configuration("2"), configuration("1")).list();
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].key, "simulation.step");
  EXPECT_EQ(changed[0].found, "2");
  EXPECT_EQ(changed[0].expected, "1, as in the snapshot");
  EXPECT_EQ(changed[0].where, "x.yaml:1");
}

TEST(Differences, reportsKeysThatOnlyOneSideHas) {
  const Configuration plain = configuration("1"), extra = configuration("1", ", integrator: HERK4");
  ASSERT_EQ(differences(extra, plain).list().size(), 1u);
  EXPECT_EQ(differences(extra, plain).list()[0].expected, "no such key, as in the snapshot");
  ASSERT_EQ(differences(plain, extra).list().size(), 1u);
  EXPECT_EQ(differences(plain, extra).list()[0].key, "simulation.integrator");
  EXPECT_EQ(differences(plain, extra).list()[0].found, "(absent)");
}

TEST(Differences, seesListElements) {
  const Configuration other = Configuration::parse(configuration("1").resolvedText(), "y.yaml", {"connections.0=[a.b, c.e]"});
  ASSERT_EQ(differences(other, configuration("1")).list().size(), 1u);
  EXPECT_EQ(differences(other, configuration("1")).list()[0].key, "connections.0.1");
}

}  // namespace
}  // namespace heerk_rotor
