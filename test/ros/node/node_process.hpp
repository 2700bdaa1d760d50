#pragma once
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace heerk_rotor {

inline std::string shippedConfig(const std::string& name) { return HEERK_SOURCE_DIR "/config/" + name; }

/// Awaits a condition; polls, because what brings it about is another process.
inline bool eventually(const std::function<bool()>& condition, double seconds = 15.0) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

/// A rotor node of its own for one test, at the master of the rostest. Ended with SIGINT, like by Ctrl-C.
class NodeProcess {
 public:
  static constexpr const char* kName = "/rotor";

  /// Sets private parameters for the next start.
  template <class Value>
  NodeProcess& set(const std::string& parameter, const Value& value) {
    ros::param::set(std::string(kName) + "/" + parameter, value);
    return *this;
  }

  NodeProcess() {
    ros::param::del(kName);
    folder_ = std::filesystem::temp_directory_path() / ("heerk_rotor_test_" + std::to_string(getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    set("config", shippedConfig("lag_rotor_controlled.yaml"));
    set("lcm_url", std::string());
    set("failure_file", file("failure.csv"));
    set("priority", 0);  // several tests may run side by side
  }
  ~NodeProcess() {
    interrupt();
    std::filesystem::remove_all(folder_);
  }

  /// A file in this node's temporary folder.
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  void start() {
    pid_ = fork();
    if (pid_ != 0) return;
    if (freopen(file("output.txt").c_str(), "a", stdout) == nullptr || dup2(1, 2) < 0) _exit(126);
    setenv("ROSCONSOLE_STDOUT_LINE_BUFFERED", "1", 1);  // what it says is in the file at once
    const std::string program = HEERK_PROGRAM_DIR "/rotor_node";
    execl(program.c_str(), program.c_str(), ("__name:=" + std::string(kName + 1)).c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }

  /// Exit status, or -1 when it has not ended in time.
  int waitForEnd(double seconds = 30.0) {
    int status = 0;
    if (pid_ <= 0 || !eventually([&] { return waitpid(pid_, &status, WNOHANG) == pid_; }, seconds)) return -1;
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  int interrupt() {
    if (pid_ <= 0) return -1;
    kill(pid_, SIGINT);
    const int status = waitForEnd();
    if (pid_ > 0) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0), pid_ = 0;
    return status;
  }

  /// What it has written to the terminal so far.
  std::string output() const {
    std::ifstream stream(file("output.txt"));
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  bool says(const std::string& text) const { return output().find(text) != std::string::npos; }

 private:
  std::filesystem::path folder_;
  pid_t pid_ = 0;
};

/// Keeps every message of a topic. Create it before the node to miss as little as possible.
template <class Message>
class Collector {
 public:
  explicit Collector(const std::string& topic) {
    subscriber_ = node_.subscribe<Message>(
        topic, 0,
        [this](const boost::shared_ptr<const Message>& message) {
          const std::lock_guard<std::mutex> lock(mutex_);
          messages_.push_back(*message);
          last_ = std::chrono::steady_clock::now();
          if (messages_.size() == 1) first_ = last_;
        },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  }
  ~Collector() { subscriber_.shutdown(); }

  std::vector<Message> messages() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }
  std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_.size();
  }
  Message last() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_.empty() ? Message() : messages_.back();
  }
  /// Whether a publisher is connected: what it sends from now on will arrive.
  bool connected() const { return subscriber_.getNumPublishers() > 0; }
  /// Messages per second of real time, between the first and the last.
  double rate() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return static_cast<double>(messages_.size() - 1) / std::chrono::duration<double>(last_ - first_).count();
  }
  void clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.clear();
  }
  bool waitForSize(std::size_t n, double seconds = 15.0) const {
    return eventually([&] { return size() >= n; }, seconds);
  }
  /// Until the newest message satisfies the condition.
  bool waitForLast(const std::function<bool(const Message&)>& condition, double seconds = 15.0) const {
    return eventually([&] { return size() > 0 && condition(last()); }, seconds);
  }

 private:
  ros::NodeHandle node_;
  mutable std::mutex mutex_;
  std::vector<Message> messages_;
  std::chrono::steady_clock::time_point first_, last_;
  ros::Subscriber subscriber_;
};

/// main() of a test program.
inline int runRosTests(int argc, char** argv, const std::string& name) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, name);
  ros::start();
  ros::AsyncSpinner spinner(2);
  spinner.start();
  const int result = RUN_ALL_TESTS();
  spinner.stop();
  ros::shutdown();
  return result;
}

}  // namespace heerk_rotor
