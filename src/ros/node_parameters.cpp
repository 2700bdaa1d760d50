#include "heerk_rotor/ros/node_parameters.hpp"

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "heerk_rotor/core/nearest_name.hpp"

namespace heerk_rotor {
namespace {

using XmlRpc::XmlRpcValue;

std::string text(const XmlRpcValue& value) {
  std::ostringstream stream;
  value.write(stream);
  return stream.str();
}

/// Reads one parameter after the other, collects what is wrong, and knows in the end which names nobody asked for.
class Reader {
 public:
  explicit Reader(const XmlRpcValue& values) : values_(values) {
    if (values_.getType() != XmlRpcValue::TypeStruct) return;
    for (auto& entry : values_) present_.push_back(entry.first);
  }

  bool has(const std::string& name) {
    known_.push_back(name);
    for (const std::string& other : present_)
      if (other == name) return true;
    return false;
  }

  void word(const std::string& name, std::string& target) {
    if (!has(name)) return;
    if (values_[name].getType() == XmlRpcValue::TypeString) target = static_cast<std::string&>(values_[name]);
    else problem(name, "a text");
  }

  void flag(const std::string& name, bool& target) {
    if (!has(name)) return;
    if (values_[name].getType() == XmlRpcValue::TypeBoolean) target = static_cast<bool&>(values_[name]);
    else problem(name, "true or false");
  }

  void integer(const std::string& name, int& target, int low, int high) {
    if (!has(name)) return;
    if (values_[name].getType() == XmlRpcValue::TypeInt) {
      const int value = static_cast<int&>(values_[name]);
      if (value >= low && value <= high) {
        target = value;
        return;
      }
    }
    problem(name, "an integer in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
  }

  /// A finite number >= 0.
  void number(const std::string& name, double& target, const std::string& unit) {
    if (!has(name)) return;
    double value = NAN;
    if (values_[name].getType() == XmlRpcValue::TypeInt) value = static_cast<int&>(values_[name]);
    if (values_[name].getType() == XmlRpcValue::TypeDouble) value = static_cast<double&>(values_[name]);
    if (std::isfinite(value) && value >= 0.0) target = value;
    else problem(name, "a number >= 0" + unit);
  }

  void words(const std::string& name, std::vector<std::string>& target) {
    if (!has(name)) return;
    XmlRpcValue& list = values_[name];
    bool good = list.getType() == XmlRpcValue::TypeArray;
    for (int i = 0; good && i < list.size(); ++i) {
      good = list[i].getType() == XmlRpcValue::TypeString;
      if (good) target.push_back(static_cast<std::string&>(list[i]));
    }
    if (!good) problem(name, "a list of texts \"key=value\"");
  }

  void problem(const std::string& name, const std::string& expected) {
    add("~" + name + " = " + text(values_[name]) + ": expected " + expected);
  }
  void add(const std::string& line) { problems_ += (problems_.empty() ? "" : "\n") + line; }

  const std::string& problems() const { return problems_; }

  std::vector<std::string> unknown() const {
    std::vector<std::string> lines;
    for (const std::string& name : present_) {
      bool found = false;
      for (const std::string& other : known_) found = found || other == name;
      if (!found) lines.push_back("~" + name + " is not a parameter of this node" + didYouMean(name, known_));
    }
    return lines;
  }

 private:
  XmlRpcValue values_;  // a copy: its accessors are not const
  std::vector<std::string> present_, known_;
  std::string problems_;
};

std::string defaultFailureFile() {
  const char* ros_home = std::getenv("ROS_HOME");
  const char* home = std::getenv("HOME");
  const std::string folder = ros_home != nullptr ? ros_home : home != nullptr ? std::string(home) + "/.ros" : ".";
  return folder + "/heerk_rotor_failure.csv";
}

}  // namespace

NodeParameters readNodeParameters(const XmlRpcValue& values, std::vector<std::string>& warnings) {
  constexpr int kMany = 1000000;
  Reader reader(values);
  NodeParameters p;
  p.lcm_url = NodeParameters::kDefaultLcmUrl;

  reader.word("config", p.config);
  if (p.config.empty()) reader.add("~config is missing: expected the absolute path of a configuration file (config/*.yaml of this package)");
  reader.words("set", p.set);
  reader.number("real_time_factor", p.real_time_factor, " (1 = real time, 0 = as fast as possible)");
  reader.integer("publish_every", p.publish_every, 0, kMany);
  reader.integer("steps_per_wake", p.steps_per_wake, 0, kMany);
  reader.number("command_timeout", p.command_timeout, " [s] (0 = never)");
  std::string policy = "hold";
  reader.word("timeout_policy", policy);
  if (policy == "trim") p.timeout_policy = TimeoutPolicy::kTrim;
  else if (policy != "hold") reader.problem("timeout_policy", "hold or trim" + didYouMean(policy, {"hold", "trim"}));
  reader.flag("publish_clock", p.publish_clock);
  reader.word("lcm_url", p.lcm_url);
  p.lcm_url_given = !p.lcm_url.empty() && p.lcm_url != NodeParameters::kDefaultLcmUrl;
  reader.integer("lcm_every", p.lcm_every, 0, kMany);
  reader.word("lcm_log", p.lcm_log);
  reader.integer("priority", p.priority, 0, 99);
  reader.integer("lock_step", p.lock_step, 0, kMany);
  reader.number("duration", p.duration, " [s] (0 = endless)");
  reader.word("failure_file", p.failure_file);
  if (p.failure_file.empty()) p.failure_file = defaultFailureFile();
  reader.has("diagnostic_period");  // read by diagnostic_updater

  warnings = reader.unknown();
  if (!reader.problems().empty()) throw ParameterError(reader.problems());
  return p;
}

}  // namespace heerk_rotor
