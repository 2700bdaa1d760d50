#include "heerk_rotor/lcm/lcm_log_recorder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace heerk_rotor {
namespace {

using RotorRecorder = LcmLogRecorder<RotorInstant>;

struct LcmLog : ::testing::Test {
  std::string file = (std::filesystem::temp_directory_path() / ("heerk_rotor_log_" + std::to_string(getpid()) + ".lcm")).string();
  void TearDown() override { std::filesystem::remove(file); }
  static RotorInstant instant(std::uint64_t step) {
    RotorInstant i;
    i.reading.step = step;
    i.reading.blades = 4;
    i.reading.sim_time = 1e-3 * static_cast<double>(step);
    i.reading.lag[3] = 0.5 * static_cast<double>(step);
    return i;
  }
  std::vector<rotor_state_t> read() const {
    std::vector<rotor_state_t> messages;
    lcm::LogFile log(file, "r");
    while (const lcm::LogEvent* event = log.readNextEvent()) {
      EXPECT_EQ(event->channel, "ROTOR_STATE");
      messages.emplace_back();
      EXPECT_EQ(messages.back().decode(event->data, 0, event->datalen), event->datalen);
      EXPECT_EQ(event->timestamp, messages.back().stamp / 1000);
    }
    return messages;
  }
};

TEST_F(LcmLog, holdsEveryInstantInOrder) {
  RotorRing ring(64);
  std::atomic<bool> stop{false};
  RotorRecorder recorder(file, ring, 7000000000, 5000);
  recorder.start();
  for (std::uint64_t k = 0; k < 5000; ++k) ring.pushWaiting(instant(k), stop);
  recorder.stop();
  EXPECT_EQ(recorder.problem(), "");
  EXPECT_EQ(recorder.written(), 5000u);
  const std::vector<rotor_state_t> messages = read();
  ASSERT_EQ(messages.size(), 5000u);
  for (std::size_t k = 0; k < messages.size(); ++k) {
    ASSERT_EQ(messages[k].step, static_cast<std::int64_t>(k));
    ASSERT_EQ(messages[k].stamp, 7000000000 + static_cast<std::int64_t>(k) * 1000000);
    ASSERT_EQ(messages[k].lag[3], 0.5 * static_cast<double>(k));
  }
  // The estimate of the space needed is right within a quarter.
  EXPECT_NEAR(static_cast<double>(std::filesystem::file_size(file)) / 5000.0, LcmLogPacker<RotorInstant>::kBytesPerInstant, 0.25 * LcmLogPacker<RotorInstant>::kBytesPerInstant);
}

TEST_F(LcmLog, aGapIsAProblemAndVisibleInTheFile) {
  RotorRing ring(4);
  for (std::uint64_t k = 0; k < 6; ++k) ring.push(instant(k));  // nobody reads yet: two are lost
  RotorRecorder recorder(file, ring, 0, 10);
  recorder.start();
  recorder.stop();
  EXPECT_NE(recorder.problem().find("gap, 2 steps were lost"), std::string::npos) << recorder.problem();
  const std::vector<rotor_state_t> messages = read();
  ASSERT_EQ(messages.size(), 4u);
  EXPECT_EQ(messages.back().dropped, 2);
}

TEST_F(LcmLog, refusesAFileThatCannotBeWritten) {
  RotorRing ring(4);
  EXPECT_THROW(RotorRecorder("/nonexistent_folder/log.lcm", ring, 0, 1), std::runtime_error);
}

TEST_F(LcmLog, refusesToStartWithoutRoomOnTheDisk) {
  RotorRing ring(4);
  try {
    RotorRecorder recorder(file, ring, 0, 1e15);
    FAIL() << "700 petabytes";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("free on the disk, expected at least"), std::string::npos) << error.what();
  }
}

TEST_F(LcmLog, aFullDiskIsAProblemAndTheRingIsStillEmptied) {
  if (!std::ofstream("/dev/full").is_open()) GTEST_SKIP() << "no /dev/full here";
  RotorRing ring(16);
  std::atomic<bool> stop{false};
  RotorRecorder recorder("/dev/full", ring, 0, 100);
  recorder.start();
  for (std::uint64_t k = 0; k < 1000; ++k) ASSERT_TRUE(ring.pushWaiting(instant(k), stop));
  recorder.stop();
  EXPECT_NE(recorder.problem().find("writing failed (No space left on device)"), std::string::npos) << recorder.problem();
}

}  // namespace
}  // namespace heerk_rotor
