#include "heerk_rotor/realtime/snapshot_ring.hpp"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace heerk_rotor {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

struct Entry {
  std::uint64_t number = 0;
  std::array<std::uint64_t, 30> copies{};
};

Entry entry(std::uint64_t number) {
  Entry e;
  e.number = number;
  e.copies.fill(number);
  return e;
}

bool whole(const Entry& e) {
  for (const std::uint64_t copy : e.copies)
    if (copy != e.number) return false;
  return true;
}

TEST(SnapshotRing, roundsItsCapacityUpToAPowerOfTwo) {
  EXPECT_EQ(SnapshotRing<int>(1).capacity(), 2u);
  EXPECT_EQ(SnapshotRing<int>(8).capacity(), 8u);
  EXPECT_EQ(SnapshotRing<int>(23491).capacity(), 32768u);
}

TEST(SnapshotRing, givesValuesInOrderAndDropsTheNewestWhenFull) {
  SnapshotRing<int> ring(4);
  for (int i = 0; i < 7; ++i) EXPECT_EQ(ring.push(i), i < 4);
  EXPECT_EQ(ring.dropped(), 3u);
  EXPECT_EQ(ring.size(), 4u);
  int value = -1;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(ring.pop(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(ring.pop(value));
  EXPECT_TRUE(ring.push(9));  // there is space again
  ASSERT_TRUE(ring.pop(value));
  EXPECT_EQ(value, 9);
}

TEST(SnapshotRing, losesOnlyWhatItCountsBetweenTwoThreads) {
  constexpr std::uint64_t kEnough = 50000;  // received while the producer is at work
  SnapshotRing<Entry> ring(64);
  std::atomic<bool> enough{false};
  std::uint64_t pushed = 0;
  std::thread producer([&] {
    while (!enough) ring.push(entry(++pushed));
  });
  Entry e;
  std::uint64_t received = 0, last = 0, wrong = 0;
  const auto receive = [&] {
    while (ring.pop(e)) {
      ++received;
      wrong += !whole(e) || e.number <= last;
      last = e.number;
    }
  };
  while (received < kEnough) {
    receive();
    std::this_thread::yield();
  }
  enough = true;
  producer.join();
  receive();
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(received + ring.dropped(), pushed);
}

TEST(SnapshotRing, recorderModeLosesNothingAlthoughTheReaderIsSlower) {
  constexpr std::uint64_t kPushes = 50000;
  SnapshotRing<Entry> ring(8);
  std::atomic<bool> stop{false};
  std::thread producer([&] {
    for (std::uint64_t i = 1; i <= kPushes; ++i) ring.pushWaiting(entry(i), stop);
  });
  Entry e;
  std::uint64_t wrong = 0;
  for (std::uint64_t expected = 1; expected <= kPushes; ++expected) {
    ASSERT_TRUE(ring.popWaiting(e, seconds(20)));
    wrong += !whole(e) || e.number != expected;
    if (expected % 1000 == 0) std::this_thread::yield();
  }
  producer.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(ring.dropped(), 0u);
}

TEST(SnapshotRing, aWaitingProducerGivesUpWhenTheRunStops) {
  SnapshotRing<int> ring(2);
  std::atomic<bool> stop{false};
  ring.push(1);
  ring.push(2);
  std::thread producer([&] { EXPECT_FALSE(ring.pushWaiting(3, stop)); });
  stop = true;
  producer.join();
  EXPECT_EQ(ring.dropped(), 1u);
  EXPECT_EQ(ring.size(), 2u);
}

TEST(SnapshotRing, aWaitingReaderIsWokenByTheProducer) {
  SnapshotRing<int> ring(2);
  int value = 0;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_FALSE(ring.popWaiting(value, milliseconds(30)));
  EXPECT_GE(std::chrono::steady_clock::now() - begin, milliseconds(30));
  std::thread producer([&] { ring.push(5); });
  EXPECT_TRUE(ring.popWaiting(value, seconds(20)));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(20));
  EXPECT_EQ(value, 5);
  producer.join();
}

/// Every single wake-up is needed here: a lost one costs the time-out of 20 s.
TEST(WakeUp, losesNoNotificationInAPingPong) {
  constexpr int kRounds = 20000;
  SnapshotRing<int> there(2), back(2);
  std::thread echo([&] {
    int value = 0;
    for (int i = 0; i < kRounds; ++i)
      if (there.popWaiting(value, seconds(20))) back.push(value);
  });
  int value = -1, wrong = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < kRounds; ++i) {
    there.push(i);
    wrong += !back.popWaiting(value, seconds(20)) || value != i;
  }
  echo.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(20));
}

}  // namespace
}  // namespace heerk_rotor
