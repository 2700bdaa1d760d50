// The log recorder with a shaft's instants: packed, complete, also when the simulation pauses.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

#include "heerk_rotor/lcm/lcm_log_recorder.hpp"

namespace heerk_rotor {
namespace {

struct ShaftLog : ::testing::Test {
  std::string file = (std::filesystem::temp_directory_path() / ("heerk_rotor_shaft_log_" + std::to_string(getpid()) + ".lcm")).string();
  void TearDown() override { std::filesystem::remove(file); }
  static ShaftInstant instant(std::uint64_t step) {
    ShaftInstant i;
    i.reading.step = step;
    i.reading.discs = 2;
    i.reading.sim_time = 1e-5 * static_cast<double>(step);
    i.reading.disc_y[1] = 0.5 * static_cast<double>(step);
    return i;
  }
};

TEST_F(ShaftLog, holdsEveryStepInOrder) {
  ShaftRing ring(4096);
  std::atomic<bool> stop{false};
  LcmLogRecorder<ShaftInstant> recorder(file, ring, 7000000000, 50000);
  recorder.start();
  for (std::uint64_t k = 0; k < 50000; ++k) ring.pushWaiting(instant(k), stop);
  recorder.stop();
  EXPECT_EQ(recorder.problem(), "");
  EXPECT_EQ(recorder.written(), 50000u);
  lcm::LogFile log(file, "r");
  std::int64_t next = 0;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    ASSERT_EQ(event->channel, "SHAFT_STATE_BATCH");
    shaft_batch_t batch;
    ASSERT_EQ(batch.decode(event->data, 0, event->datalen), event->datalen);
    EXPECT_EQ(event->timestamp, batch.stamp / 1000);
    EXPECT_EQ(batch.stamp, 7000000000 + 10000 * next);
    ASSERT_EQ(batch.step, next);
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.steps); ++i, ++next) ASSERT_EQ(batch.disc_y[1][i], 0.5 * static_cast<double>(next));
  }
  EXPECT_EQ(next, 50000);
}

TEST_F(ShaftLog, aPauseBringsABegunBatchToTheDisk) {
  ShaftRing ring(64);
  LcmLogRecorder<ShaftInstant> recorder(file, ring, 0, 100);
  recorder.start();
  for (std::uint64_t k = 0; k < 5; ++k) ring.push(instant(k));
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (std::filesystem::file_size(file) == 0 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  EXPECT_GT(std::filesystem::file_size(file), 5 * 100u);
  recorder.stop();
}

TEST_F(ShaftLog, aGapIsAProblemAndVisibleInTheFile) {
  ShaftRing ring(4);
  for (std::uint64_t k = 0; k < 6; ++k) ring.push(instant(k));  // nobody reads yet: two are lost
  {
    LcmLogRecorder<ShaftInstant> recorder(file, ring, 0, 10);
    recorder.start();
    while (ring.size() > 0) std::this_thread::yield();
    ring.push(instant(6));
    recorder.stop();
    EXPECT_NE(recorder.problem().find("gap, 2 steps were lost"), std::string::npos) << recorder.problem();
  }
  lcm::LogFile log(file, "r");
  std::vector<std::int64_t> steps;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    shaft_batch_t batch;
    batch.decode(event->data, 0, event->datalen);
    EXPECT_EQ(batch.dropped, 2);
    for (std::int32_t i = 0; i < batch.steps; ++i) steps.push_back(batch.step + i * batch.stride);
  }
  EXPECT_EQ(steps, (std::vector<std::int64_t>{0, 1, 2, 3, 6}));
}

}  // namespace
}  // namespace heerk_rotor
