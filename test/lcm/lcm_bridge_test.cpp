#include "heerk_rotor/lcm/lcm_bridge.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include "heerk_rotor/rotor_state_t.hpp"

namespace heerk_rotor {
namespace {

using RotorBridge = LcmBridge<RotorInstant>;

/// Multicast that never leaves the machine, on a port of this process, so that test runs side by side do not hear each other.
std::string localUrl() { return "udpm://239.255.76.67:" + std::to_string(20000 + getpid() % 20000) + "?ttl=0"; }

template <class Condition>
bool handleUntil(lcm::LCM& lcm, Condition condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition() && std::chrono::steady_clock::now() < end) lcm.handleTimeout(20);
  return condition();
}

TEST(LcmBridge, publishesEveryInstantOfTheRingInOrder) {
  const std::string url = localUrl();
  lcm::LCM listener(url);
  ASSERT_TRUE(listener.good());
  std::vector<rotor_state_t> heard;
  listener.subscribeFunction(RotorBridge::kStateChannel, +[](const lcm::ReceiveBuffer*, const std::string&, const rotor_state_t* m, std::vector<rotor_state_t>* list) { list->push_back(*m); }, &heard)
      ->setQueueCapacity(1000);

  RotorRing ring(512);
  RotorBridge bridge(url, ring, 5000000000, nullptr);
  bridge.setOverrunCounter([] { return std::uint64_t{42}; });
  bridge.start();
  RotorInstant instant;
  instant.reading.blades = 4;
  for (std::uint64_t k = 0; k < 300; ++k) {
    instant.reading.step = k;
    instant.reading.sim_time = 1e-3 * static_cast<double>(k);
    instant.reading.lag[2] = std::sin(static_cast<double>(k));
    instant.source = k < 100 ? CommandSource::kNone : CommandSource::kLcm;
    ASSERT_TRUE(ring.push(instant));
    // UDP loses what does not fit the receive buffer: listen before it is full.
    if (k % 50 != 49) continue;
    ASSERT_TRUE(handleUntil(listener, [&] { return heard.size() == k + 1; })) << heard.size();
  }
  bridge.stop();
  for (std::size_t k = 0; k < heard.size(); ++k) {
    EXPECT_EQ(heard[k].step, static_cast<std::int64_t>(k));
    EXPECT_EQ(heard[k].stamp, 5000000000 + static_cast<std::int64_t>(k) * 1000000);
    EXPECT_EQ(heard[k].lag[2], std::sin(static_cast<double>(k)));
    EXPECT_EQ(heard[k].command_source, k < 100 ? "none" : "lcm");
    EXPECT_EQ(heard[k].overruns, 42);
  }
  EXPECT_EQ(bridge.published(), 300u);
  EXPECT_EQ(bridge.failed(), 0u);
}

TEST(LcmBridge, handsCommandsOnUnchanged) {
  const std::string url = localUrl();
  RotorRing ring(4);
  std::mutex mutex;
  std::vector<swashplate_command_t> received;
  RotorBridge bridge(url, ring, 0, [&](const swashplate_command_t& command) {
    const std::lock_guard<std::mutex> lock(mutex);
    received.push_back(command);
  });
  bridge.start();
  lcm::LCM sender(url);
  swashplate_command_t command;
  command.stamp = 1;
  command.collective = 0.11;
  command.lateral_cyclic = -0.02;
  command.longitudinal_cyclic = std::numeric_limits<double>::quiet_NaN();  // judged elsewhere
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  ASSERT_EQ(sender.publish(RotorBridge::kCommandChannel, &command), 0);
  while (bridge.received() == 0 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  bridge.stop();
  ASSERT_EQ(received.size(), 1u);
  EXPECT_EQ(received[0].collective, 0.11);
  EXPECT_EQ(received[0].lateral_cyclic, -0.02);
  EXPECT_TRUE(std::isnan(received[0].longitudinal_cyclic));
}

/// The library fails at once on every attempt to read beyond the end of an event log.
TEST(LcmBridge, aProviderThatFailsIsAProblemAndTriedAgainWithoutSpinning) {
  const std::string file = (std::filesystem::temp_directory_path() / ("heerk_rotor_commands_" + std::to_string(getpid()) + ".lcm")).string();
  swashplate_command_t command{};
  {
    lcm::LCM writer("file://" + file + "?mode=w");
    ASSERT_EQ(writer.publish(RotorBridge::kCommandChannel, &command), 0);
  }
  RotorRing ring(4);
  const auto begin = std::chrono::steady_clock::now();
  RotorBridge bridge("file://" + file + "?speed=0", ring, 0, [](const swashplate_command_t&) {});
  EXPECT_EQ(bridge.problem(), "");
  bridge.start();
  while (bridge.receiveErrors() < 5 && std::chrono::steady_clock::now() < begin + std::chrono::seconds(10)) std::this_thread::yield();
  EXPECT_GE(bridge.receiveErrors(), 5u);
  EXPECT_NE(bridge.problem().find("LCM cannot receive commands from file://" + file), std::string::npos) << bridge.problem();
  bridge.stop();
  EXPECT_EQ(bridge.received(), 1u);
  const auto elapsed = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(bridge.receiveErrors(), 1u + static_cast<std::uint64_t>(elapsed / std::chrono::milliseconds(50)));
  std::filesystem::remove(file);
}

TEST(LcmBridge, saysWhichUrlCannotBeOpened) {
  RotorRing ring(4);
  try {
    RotorBridge bridge("nosuchprovider://1.2.3.4", ring, 0, nullptr);
    FAIL() << "opened";
  } catch (const LcmError& error) {
    EXPECT_NE(std::string(error.what()).find("nosuchprovider://1.2.3.4"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace heerk_rotor
