// What `rosbag record` makes of the node's topics: complete, readable by rosbag's own tools, equal to what was published.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include "heerk_rotor/RotorState.h"
#include "ros/node/child_process.hpp"
#include "ros/node/node_process.hpp"
#include "ros/node/offline_run.hpp"

namespace heerk_rotor {
namespace {

/// Standard output of a shell command that must succeed.
std::string outputOf(const std::string& command) {
  std::string text;
  FILE* pipe = popen(command.c_str(), "r");
  EXPECT_NE(pipe, nullptr);
  if (pipe == nullptr) return text;
  char buffer[4096];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
  EXPECT_EQ(pclose(pipe), 0) << command << "\n" << text;
  return text;
}

/// Whether that node subscribes to the topic, as the master knows.
bool subscribes(const std::string& node, const std::string& topic) {
  XmlRpc::XmlRpcValue request("/record_rostest"), response, payload;
  if (!ros::master::execute("getSystemState", request, response, payload, false)) return false;
  XmlRpc::XmlRpcValue& subscribers = payload[1];
  for (int i = 0; i < subscribers.size(); ++i) {
    if (static_cast<std::string>(subscribers[i][0]) != topic) continue;
    for (int k = 0; k < subscribers[i][1].size(); ++k)
      if (static_cast<std::string>(subscribers[i][1][k]) == node) return true;
  }
  return false;
}

TEST(RosbagRecord, holdsWhatTheNodePublished) {
  Collector<RotorState> states("rotor/state");
  NodeProcess node;
  const std::string bag = node.file("run.bag");
  node.set("publish_every", 8);
  ChildProcess recorder([&] {
    if (freopen(node.file("record.txt").c_str(), "w", stdout) == nullptr || dup2(1, 2) < 0) _exit(126);
    execlp("rosbag", "rosbag", "record", "--tcpnodelay", "-O", bag.c_str(), "/rotor/state", "/rotor/lag_angles", "/rotor/hub_wrench", "/joint_states", "__name:=recorder",
           static_cast<char*>(nullptr));
  });
  ASSERT_TRUE(eventually([] { return subscribes("/recorder", "/rotor/state") && subscribes("/recorder", "/joint_states"); }, 30.0));
  node.start();
  ASSERT_TRUE(states.waitForSize(1200, 30.0)) << node.output();  // 4 s
  node.interrupt();
  recorder.interrupt();
  ASSERT_TRUE(eventually([&] { return !recorder.running(); }));
  EXPECT_EQ(recorder.status(), 0);
  // The wrapper `rosbag` may end before the recorder that it started has renamed the file.
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(bag) && !std::filesystem::exists(bag + ".active"); }));

  const std::string info = outputOf("rosbag info '" + bag + "'");
  for (const char* expected : {"/rotor/state ", "/rotor/lag_angles ", "/rotor/hub_wrench ", "/joint_states ", "heerk_rotor/RotorState ", "heerk_rotor/BladeAngles ",
                               "geometry_msgs/WrenchStamped ", "sensor_msgs/JointState "})
    EXPECT_NE(info.find(expected), std::string::npos) << expected << "\n" << info;

  // As Python reads it back, every digit: step, time, blades, then lag and pitch of each blade.
  const std::string script =
      "import rosbag\\n"
      "for _, m, _ in rosbag.Bag(\"" + bag + "\").read_messages([\"/rotor/state\"]):\\n"
      "  print(m.step, m.sim_time.hex(), len(m.lag), *[v.hex() for v in m.lag + m.pitch])\\n";
  std::istringstream rows(outputOf("printf '" + script + "' | /usr/bin/python3 -"));
  std::map<std::uint64_t, RotorState> heard;
  for (const RotorState& state : states.messages()) heard[state.step] = state;
  OfflineRun offline(shippedConfig("lag_rotor_controlled.yaml"));
  std::size_t count = 0, compared = 0;
  std::uint64_t first = 0, last = 0;
  for (std::string row; std::getline(rows, row); ++count) {
    std::istringstream words(row);
    std::uint64_t step = 0;
    std::size_t blades = 0;
    std::string word;
    words >> step >> word >> blades;
    const double time = std::strtod(word.c_str(), nullptr);
    ASSERT_EQ(blades, 4u) << row;
    if (count == 0) first = step;
    else ASSERT_GT(step, last);
    last = step;
    std::vector<double> values;
    while (words >> word) values.push_back(std::strtod(word.c_str(), nullptr));
    ASSERT_EQ(values.size(), 8u) << row;
    const RotorReading& reading = offline.at(step);
    ASSERT_EQ(time, reading.sim_time);
    for (std::size_t k = 0; k < 4; ++k) {
      ASSERT_EQ(values[k], reading.lag[k]);
      ASSERT_EQ(values[4 + k], reading.pitch[k]);
    }
    const auto found = heard.find(step);
    if (found == heard.end()) continue;
    ++compared;
    ASSERT_TRUE(std::equal(found->second.lag.begin(), found->second.lag.end(), values.begin()));
  }
  // rosbag loses messages without a word when the machine stalls for longer than its queue lasts (100 messages, a third of
  // a second): one in a hundred at most, at a rate it can follow.
  EXPECT_GE(count, 1100u) << info;
  EXPECT_GE(static_cast<double>(count), 0.99 * static_cast<double>((last - first) / 8 + 1));
  EXPECT_GE(compared, 1000u);
}

}  // namespace
}  // namespace heerk_rotor

int main(int argc, char** argv) { return heerk_rotor::runRosTests(argc, argv, "record_rostest"); }
