// What publishing an instant to ROS costs: filling the messages, serialising them, and ros::Publisher::publish() of all topics of an instant without and
// with a subscriber in another process (TCP without delay). The latter two need a master: scripts/benchmark.sh starts one; without, they are skipped.
#include <chrono>
#include <cstring>
#include <thread>

#include <ros/ros.h>
#include <ros/serialization.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "heerk_rotor/ros/conversions.hpp"
#include "heerk_rotor/ros/state_topics.hpp"
#include "observed_instant.hpp"
#include "thread_time.hpp"

extern char** environ;

namespace heerk_rotor {
namespace {

constexpr const char* kSubscribe = "--subscribe";
constexpr auto kPeriod = std::chrono::microseconds(1572);  // four steps of the elastic rotor: the node's default

RotorInstant rotorInstant() {
  const ObservedInstant instant("bo105.yaml");
  RotorInstant result;
  RotorView(instant.system()).read(instant.at(1000), result.reading);
  return result;
}

void fillMessages(benchmark::State& state) {
  const RotorInstant instant = rotorInstant();
  RotorState rotor;
  BladeAngles angles;
  geometry_msgs::WrenchStamped wrench;
  for (auto _ : state) {
    toRotorState(instant, ros::Time(1.0), {}, rotor);
    toLagAngles(instant.reading, ros::Time(1.0), angles);
    toHubWrench(instant.reading, ros::Time(1.0), wrench);
    benchmark::DoNotOptimize(rotor.lag.data());
    benchmark::DoNotOptimize(angles.angle.data());
    benchmark::DoNotOptimize(&wrench);
  }
}

void serialise(benchmark::State& state) {
  RotorState rotor;
  toRotorState(rotorInstant(), ros::Time(1.0), {}, rotor);
  std::size_t bytes = 0;
  for (auto _ : state) {
    const ros::SerializedMessage message = ros::serialization::serializeMessage(rotor);
    bytes = message.num_bytes;
    benchmark::DoNotOptimize(message.buf.get());
  }
  state.counters["bytes"] = static_cast<double>(bytes);
}

/// This program as a subscriber, in a process of its own.
class Subscriber {
 public:
  Subscriber() {
    std::string program = "/proc/self/exe", argument = kSubscribe;
    char* words[] = {program.data(), argument.data(), nullptr};
    if (::posix_spawn(&process_, words[0], nullptr, nullptr, words, environ) != 0) process_ = -1;
  }
  ~Subscriber() {
    if (process_ <= 0) return;
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }

 private:
  pid_t process_ = -1;
};

/// CPU time of the publishing thread per instant, at the node's pace; argument: subscribers.
void publish(benchmark::State& state) {
  if (!ros::master::check()) return state.SkipWithError("no ROS master");
  ros::NodeHandle node;
  StateTopics<RotorInstant> topics(node);
  const ros::Publisher same = node.advertise<RotorState>("rotor/state", 1);  // to see who listens
  std::unique_ptr<Subscriber> subscriber;
  if (state.range(0) > 0) {
    subscriber = std::make_unique<Subscriber>();
    for (int i = 0; i < 200 && same.getNumSubscribers() == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (same.getNumSubscribers() == 0) return state.SkipWithError("the subscriber did not come");
  }
  const RotorInstant instant = rotorInstant();
  for (auto _ : state) {
    const double begin = threadSeconds();
    topics.publish(instant, ros::Time(1.0), {});
    state.SetIterationTime(threadSeconds() - begin);
    std::this_thread::sleep_for(kPeriod);
  }
}

BENCHMARK(fillMessages);
BENCHMARK(serialise);
BENCHMARK(publish)->ArgName("subscribers")->Arg(0)->Arg(1)->UseManualTime()->Iterations(500);

int subscribe(int argc, char** argv) {
  ros::init(argc, argv, "bench_subscriber", ros::init_options::AnonymousName);
  ros::NodeHandle node;
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  const auto state = node.subscribe<RotorState>("rotor/state", 100, [](const RotorState::ConstPtr&) {}, nullptr, hints);
  const auto lag = node.subscribe<BladeAngles>("rotor/lag_angles", 100, [](const BladeAngles::ConstPtr&) {}, nullptr, hints);
  const auto wrench = node.subscribe<geometry_msgs::WrenchStamped>("rotor/hub_wrench", 100, [](const geometry_msgs::WrenchStamped::ConstPtr&) {}, nullptr, hints);
  ros::spin();
  return 0;
}

}  // namespace
}  // namespace heerk_rotor

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], heerk_rotor::kSubscribe) == 0) return heerk_rotor::subscribe(argc, argv);
  benchmark::Initialize(&argc, argv);
  ros::init(argc, argv, "bench_publishing", ros::init_options::AnonymousName | ros::init_options::NoSigintHandler);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
