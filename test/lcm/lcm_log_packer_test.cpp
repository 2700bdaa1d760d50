#include "heerk_rotor/lcm/lcm_log_packer.hpp"

#include <gtest/gtest.h>

namespace heerk_rotor {
namespace {

using ShaftPacker = LcmLogPacker<ShaftInstant>;

/// Every field another value, so that a mix-up shows.
ShaftInstant instant(std::uint64_t step, std::uint32_t epoch = 0) {
  ShaftInstant i;
  ShaftReading& r = i.reading;
  r.step = step;
  r.epoch = epoch;
  r.discs = 2;
  double next = 1000.0 * static_cast<double>(step);
  for (double* value : {&r.sim_time, &r.azimuth, &r.rotor_speed, &r.disc_x[0], &r.disc_x[1], &r.disc_y[0], &r.disc_y[1], &r.journal_x, &r.journal_y, &r.eccentricity_ratio,
                        &r.bearing_force_x, &r.bearing_force_y, &r.film_force_x, &r.film_force_y})
    *value = next++;
  r.newton_iterations = static_cast<std::uint32_t>(step) + 1;
  r.residual_evaluations = static_cast<std::uint32_t>(step) + 2;
  return i;
}

/// Decodes what it is given.
struct Log {
  std::vector<shaft_batch_t> batches;
  LcmEventWriter writer = [this](const LcmPackedEvent& event) {
    EXPECT_STREQ(event.channel, "SHAFT_STATE_BATCH");
    batches.emplace_back();
    EXPECT_EQ(batches.back().decode(event.data.data(), 0, static_cast<int>(event.data.size())), static_cast<int>(event.data.size()));
    EXPECT_EQ(event.stamp, batches.back().stamp);
    return true;
  };
};

TEST(LcmLogPacker, everyFieldOfEveryStepSurvives) {
  Log log;
  ShaftPacker packer(1);
  for (std::uint64_t k = 3; k < 253; ++k) EXPECT_TRUE(packer.add(instant(k), {static_cast<std::int64_t>(10 * k), k, 2 * k}, log.writer));
  EXPECT_EQ(log.batches.size(), 2u);
  EXPECT_TRUE(packer.flush(log.writer));
  EXPECT_TRUE(packer.flush(log.writer));  // nothing left
  ASSERT_EQ(log.batches.size(), 3u);
  EXPECT_EQ(log.batches[0].steps, 100);
  EXPECT_EQ(log.batches[2].steps, 50);
  std::uint64_t k = 3;
  for (const shaft_batch_t& b : log.batches) {
    EXPECT_EQ(b.stride, 1);
    EXPECT_EQ(b.stamp, static_cast<std::int64_t>(10 * k));
    ASSERT_EQ(b.discs, 2);
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.steps); ++i, ++k) {
      const ShaftReading r = instant(k).reading;
      ASSERT_EQ(b.step + static_cast<std::int64_t>(i), static_cast<std::int64_t>(k));
      EXPECT_EQ(b.sim_time[i], r.sim_time);
      EXPECT_EQ(b.azimuth[i], r.azimuth);
      EXPECT_EQ(b.rotor_speed[i], r.rotor_speed);
      for (std::size_t disc = 0; disc < 2; ++disc) {
        EXPECT_EQ(b.disc_x[disc][i], r.disc_x[disc]);
        EXPECT_EQ(b.disc_y[disc][i], r.disc_y[disc]);
      }
      EXPECT_EQ(b.journal_x[i], r.journal_x);
      EXPECT_EQ(b.journal_y[i], r.journal_y);
      EXPECT_EQ(b.eccentricity_ratio[i], r.eccentricity_ratio);
      EXPECT_EQ(b.bearing_force_x[i], r.bearing_force_x);
      EXPECT_EQ(b.bearing_force_y[i], r.bearing_force_y);
      EXPECT_EQ(b.film_force_x[i], r.film_force_x);
      EXPECT_EQ(b.film_force_y[i], r.film_force_y);
      EXPECT_EQ(b.newton_iterations[i], static_cast<std::int32_t>(r.newton_iterations));
      EXPECT_EQ(b.residual_evaluations[i], static_cast<std::int32_t>(r.residual_evaluations));
    }
    EXPECT_EQ(b.overruns, static_cast<std::int64_t>(k - 1));
    EXPECT_EQ(b.dropped, static_cast<std::int64_t>(2 * (k - 1)));
  }
  EXPECT_EQ(k, 253u);
}

TEST(LcmLogPacker, aBatchEndsBeforeAGapAndBeforeAnotherEpoch) {
  Log log;
  ShaftPacker packer(2);
  for (const std::uint64_t step : {4u, 6u, 8u, 12u, 14u}) packer.add(instant(step), {}, log.writer);
  for (const std::uint64_t step : {14u, 16u}) packer.add(instant(step, 1), {}, log.writer);
  packer.flush(log.writer);
  ASSERT_EQ(log.batches.size(), 3u);
  const std::int64_t first[] = {4, 12, 14};
  const std::int32_t steps[] = {3, 2, 2}, epoch[] = {0, 0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(log.batches[i].step, first[i]);
    EXPECT_EQ(log.batches[i].steps, steps[i]);
    EXPECT_EQ(log.batches[i].epoch, epoch[i]);
    EXPECT_EQ(log.batches[i].stride, 2);
  }
}

TEST(LcmLogPacker, saysWhenABatchCouldNotBeWritten) {
  ShaftPacker packer(1);
  const LcmEventWriter refuse = [](const LcmPackedEvent&) { return false; };
  for (std::uint64_t k = 0; k < 99; ++k) EXPECT_TRUE(packer.add(instant(k), {}, refuse));
  EXPECT_FALSE(packer.add(instant(99), {}, refuse));
  EXPECT_TRUE(packer.add(instant(100), {}, refuse));
  EXPECT_FALSE(packer.add(instant(200), {}, refuse));  // the one before it
}

TEST(LcmLogPacker, theSizeItTellsIsRight) {
  std::size_t bytes = 0;
  ShaftPacker packer(1);
  for (std::uint64_t k = 0; k < 1000; ++k)
    packer.add(instant(k), {}, [&bytes](const LcmPackedEvent& event) { return bytes += event.data.size() + 28 + std::string(event.channel).size(), true; });
  EXPECT_NEAR(static_cast<double>(bytes) / 1000.0, ShaftPacker::kBytesPerInstant, 1.0);
}

TEST(LcmLogPacker, theLiveMessageHasTheSameNumbers) {
  const ShaftReading r = instant(5, 2).reading;
  shaft_state_t written, m;
  toLcmState(instant(5, 2), {77, 8, 9}, written);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(written.getEncodedSize()));
  written.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  ASSERT_EQ(m.decode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  EXPECT_STREQ(LcmState<ShaftInstant>::kChannel, "SHAFT_STATE");
  EXPECT_EQ(m.stamp, 77);
  EXPECT_EQ(m.step, 5);
  EXPECT_EQ(m.epoch, 2);
  EXPECT_EQ(m.sim_time, r.sim_time);
  EXPECT_EQ(m.azimuth, r.azimuth);
  EXPECT_EQ(m.rotor_speed, r.rotor_speed);
  EXPECT_EQ(m.disc_x, (std::vector<double>{r.disc_x[0], r.disc_x[1]}));
  EXPECT_EQ(m.disc_y, (std::vector<double>{r.disc_y[0], r.disc_y[1]}));
  EXPECT_EQ(m.journal_x, r.journal_x);
  EXPECT_EQ(m.journal_y, r.journal_y);
  EXPECT_EQ(m.eccentricity_ratio, r.eccentricity_ratio);
  EXPECT_EQ(m.bearing_force_x, r.bearing_force_x);
  EXPECT_EQ(m.bearing_force_y, r.bearing_force_y);
  EXPECT_EQ(m.film_force_x, r.film_force_x);
  EXPECT_EQ(m.film_force_y, r.film_force_y);
  EXPECT_EQ(m.newton_iterations, 6);
  EXPECT_EQ(m.residual_evaluations, 7);
  EXPECT_EQ(m.overruns, 8);
  EXPECT_EQ(m.dropped, 9);
}

}  // namespace
}  // namespace heerk_rotor
