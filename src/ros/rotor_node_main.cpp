#include <csignal>
#include <exception>
#include <sstream>
#include <string>

#include <ros/ros.h>

#include "heerk_rotor/config/problems.hpp"
#include "heerk_rotor/ros/node_parameters.hpp"
#include "heerk_rotor/ros/rotor_node.hpp"

namespace {

using namespace heerk_rotor;

/// roscpp ends in order on SIGINT only; service managers and containers send SIGTERM.
void endOnTerminate() {
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });
}

NodeParameters readParameters() {
  XmlRpc::XmlRpcValue values;
  ros::param::get("~", values);
  std::vector<std::string> warnings;
  const NodeParameters parameters = readNodeParameters(values, warnings);
  for (const std::string& warning : warnings) ROS_WARN_STREAM(warning);
  return parameters;
}

/// One log line per problem.
int refuse(const std::exception& error) {
  std::istringstream lines(error.what());
  for (std::string line; std::getline(lines, line);) ROS_FATAL_STREAM(line);
  return RotorNode::kBadParameters;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "rotor");
  endOnTerminate();
  ros::start();
  std::unique_ptr<RotorNode> node;
  try {
    node = std::make_unique<RotorNode>(readParameters());
  } catch (const std::exception& error) {
    return refuse(error);
  }
  const int status = node->run();
  node.reset();
  ros::shutdown();
  return status;
}
