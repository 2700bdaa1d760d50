#include "heerk_rotor/realtime/latest_value.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

namespace heerk_rotor {
namespace {

TEST(LatestValue, isEmptyUntilTheFirstWriteAndGivesEachValueOnce) {
  LatestValue<int> latest;
  int value = 7;
  EXPECT_FALSE(latest.read(value));
  EXPECT_EQ(value, 7);
  latest.write(1);
  EXPECT_TRUE(latest.read(value));
  EXPECT_EQ(value, 1);
  EXPECT_FALSE(latest.read(value));
}

TEST(LatestValue, keepsOnlyTheNewest) {
  LatestValue<int> latest;
  for (int i = 0; i < 10; ++i) latest.write(i);
  int value = -1;
  EXPECT_TRUE(latest.read(value));
  EXPECT_EQ(value, 9);
  EXPECT_FALSE(latest.read(value));
}

/// A value that spans several cache lines shows any mixture of two writes.
struct Wide {
  std::array<std::uint64_t, 64> words{};
};

TEST(LatestValue, isNeverTornNorGoesBackUnderContention) {
  LatestValue<Wide> latest;
  std::atomic<bool> enough{false};
  std::uint64_t written = 0;
  std::thread writer([&] {
    Wide wide;
    while (!enough) {
      wide.words.fill(++written);
      latest.write(wide);
    }
  });
  Wide seen;
  std::uint64_t last = 0, torn = 0, backwards = 0;
  const auto check = [&] {
    for (const std::uint64_t word : seen.words) torn += word != seen.words[0];
    backwards += seen.words[0] <= last;
    last = seen.words[0];
  };
  // As many reads as it takes while the writer is at work, however the machine shares out its cores.
  for (int reads = 0; reads < 1000;) {
    if (latest.read(seen)) {
      check();
      ++reads;
    } else {
      std::this_thread::yield();
    }
  }
  enough = true;
  writer.join();
  if (latest.read(seen)) check();
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backwards, 0u);
  EXPECT_EQ(last, written);  // the newest value is never lost
}

}  // namespace
}  // namespace heerk_rotor
