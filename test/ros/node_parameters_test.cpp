#include "heerk_rotor/ros/node_parameters.hpp"

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue minimal() {
  XmlRpcValue values;
  values["config"] = "/tmp/rotor.yaml";
  return values;
}

std::string problemsOf(const XmlRpcValue& values) {
  std::vector<std::string> warnings;
  try {
    readNodeParameters(values, warnings);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "none";
}

TEST(NodeParameters, haveTheDefaultsOfTheInterface) {
  std::vector<std::string> warnings;
  const NodeParameters p = readNodeParameters(minimal(), warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(p.config, "/tmp/rotor.yaml");
  EXPECT_EQ(p.real_time_factor, 1.0);
  EXPECT_EQ(p.publish_every, 0);   // automatic
  EXPECT_EQ(p.steps_per_wake, 0);
  EXPECT_EQ(p.command_timeout, 0.5);
  EXPECT_EQ(p.timeout_policy, TimeoutPolicy::kHold);
  EXPECT_FALSE(p.publish_clock);
  EXPECT_EQ(p.lcm_url, "udpm://239.255.76.67:7667?ttl=0");
  EXPECT_FALSE(p.lcm_url_given);
  EXPECT_EQ(p.lcm_every, 0);
  EXPECT_EQ(p.lcm_log, "");
  EXPECT_EQ(p.lock_step, 0);
  EXPECT_EQ(p.duration, 0.0);
}

TEST(NodeParameters, readEveryName) {
  XmlRpcValue values = minimal();
  values["set"][0] = "simulation.integrator=HEERK3";
  values["real_time_factor"] = 0.5;
  values["publish_every"] = 7;
  values["steps_per_wake"] = 2;
  values["command_timeout"] = 2;  // an integer is a number
  values["timeout_policy"] = "trim";
  values["publish_clock"] = XmlRpcValue(true);
  values["lcm_url"] = "memq://";
  values["lcm_every"] = 3;
  values["lcm_log"] = "/tmp/a.lcm";
  values["priority"] = 0;
  values["lock_step"] = 10;
  values["duration"] = 1.5;
  values["failure_file"] = "/tmp/f.csv";
  values["diagnostic_period"] = 1.0;
  std::vector<std::string> warnings;
  const NodeParameters p = readNodeParameters(values, warnings);
  EXPECT_TRUE(warnings.empty()) << warnings[0];
  EXPECT_EQ(p.set, std::vector<std::string>{"simulation.integrator=HEERK3"});
  EXPECT_EQ(p.real_time_factor, 0.5);
  EXPECT_EQ(p.publish_every, 7);
  EXPECT_EQ(p.steps_per_wake, 2);
  EXPECT_EQ(p.command_timeout, 2.0);
  EXPECT_EQ(p.timeout_policy, TimeoutPolicy::kTrim);
  EXPECT_TRUE(p.publish_clock);
  EXPECT_EQ(p.lcm_url, "memq://");
  EXPECT_TRUE(p.lcm_url_given);
  EXPECT_EQ(p.lcm_every, 3);
  EXPECT_EQ(p.lcm_log, "/tmp/a.lcm");
  EXPECT_EQ(p.priority, 0);
  EXPECT_EQ(p.lock_step, 10);
  EXPECT_EQ(p.duration, 1.5);
  EXPECT_EQ(p.failure_file, "/tmp/f.csv");
}

TEST(NodeParameters, reportEverythingWrongAtOnce) {
  XmlRpcValue values;
  values["real_time_factor"] = -1.0;
  values["publish_every"] = 2.5;
  values["priority"] = 100;
  values["publish_clock"] = "yes";
  values["timeout_policy"] = "tri";
  values["lcm_url"] = 5;
  values["set"] = "a=b";
  values["duration"] = "long";
  const std::string text = problemsOf(values);
  for (const char* expected : {"~config is missing", "~real_time_factor = -1: expected a number >= 0", "~publish_every = 2.5: expected an integer in [0, 1000000]",
                               "~priority = 100: expected an integer in [0, 99]", "~publish_clock = yes: expected true or false",
                               "~timeout_policy = tri: expected hold or trim (did you mean 'trim'?)", "~lcm_url = 5: expected a text", "~set = a=b: expected a list",
                               "~duration = long: expected a number >= 0 [s]"})
    EXPECT_NE(text.find(expected), std::string::npos) << "missing: " << expected << "\nin:\n" << text;
}

TEST(NodeParameters, anEmptyFailureFileIsTheDefaultOne) {
  XmlRpcValue values = minimal();
  std::vector<std::string> warnings;
  const std::string standard = readNodeParameters(values, warnings).failure_file;
  EXPECT_NE(standard.find("/heerk_rotor_failure.csv"), std::string::npos);
  values["failure_file"] = "";
  EXPECT_EQ(readNodeParameters(values, warnings).failure_file, standard);
}

TEST(NodeParameters, warnOfUnknownNamesWithTheNearest) {
  XmlRpcValue values = minimal();
  values["publish_evry"] = 2;
  std::vector<std::string> warnings;
  readNodeParameters(values, warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "~publish_evry is not a parameter of this node (did you mean 'publish_every'?)");
}

TEST(NodeParameters, withoutAnyOnTheServerOnlyTheConfigurationIsMissing) {
  EXPECT_EQ(problemsOf(XmlRpcValue()).find("~config is missing"), 0u);
  EXPECT_EQ(problemsOf(XmlRpcValue()).find('\n'), std::string::npos);
}

}  // namespace
}  // namespace heerk_rotor
