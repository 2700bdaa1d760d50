// The dual-disc rotor recorded to all three formats: they must tell the same story.
#include <gtest/gtest.h>

#include "program.hpp"

#if defined(HEERK_WITH_ROS) && defined(HEERK_WITH_LCM)

#include <lcm/lcm-cpp.hpp>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "heerk_rotor/ShaftState.h"
#include "heerk_rotor/shaft_batch_t.hpp"

namespace heerk_rotor {
namespace {

class SimulateShaft : public ::testing::Test {
 protected:
  static constexpr int kEvery = 7;

  void SetUp() override {
    const Finished run = simulate({shippedConfiguration("dual_disc.yaml"), "--duration", "0.02", "--every", std::to_string(kEvery), "--output", csv(), "--output", bag(),
                                   "--output", lcm()});
    ASSERT_EQ(run.status, 0) << run.err;
    table_ = parseTable(readText(csv()));
    ASSERT_EQ(table_.rows.size(), 2000u / kEvery + 1);
  }

  std::string csv() const { return folder_.file("x.csv"); }
  std::string bag() const { return folder_.file("x.bag"); }
  std::string lcm() const { return folder_.file("x.lcm"); }

  TestFolder folder_;
  Table table_;
};

TEST_F(SimulateShaft, theBagHoldsTheNumbersOfTheCsvFile) {
  const rosbag::Bag file(bag(), rosbag::bagmode::Read);
  std::size_t row = 0;
  for (const rosbag::MessageInstance& instance : rosbag::View(file)) {
    ASSERT_EQ(instance.getTopic(), "/shaft/state");
    const auto state = instance.instantiate<ShaftState>();
    ASSERT_NE(state, nullptr);
    ASSERT_LT(row, table_.rows.size());
    EXPECT_EQ(state->step, row * kEvery);
    EXPECT_EQ(state->sim_time, table_.number(row, "time [s]"));
    EXPECT_EQ(state->azimuth, table_.number(row, "azimuth [rad]"));
    ASSERT_EQ(state->disc_x.size(), 2u);
    EXPECT_EQ(state->disc_x[0], table_.number(row, "shaft.disc_1_x [m]"));
    EXPECT_EQ(state->disc_y[1], table_.number(row, "shaft.disc_2_y [m]"));
    EXPECT_EQ(state->journal_x, table_.number(row, "shaft.journal_x [m]"));
    EXPECT_EQ(state->journal_y, table_.number(row, "shaft.journal_y [m]"));
    EXPECT_EQ(state->bearing_force_x, table_.number(row, "shaft.bearing_1_x [N]"));
    EXPECT_EQ(state->film_force_y, table_.number(row, "film.film_force_y [N]"));
    EXPECT_EQ(state->eccentricity_ratio, table_.number(row, "film.eccentricity_ratio [-]"));
    ++row;
  }
  EXPECT_EQ(row, table_.rows.size());
}

TEST_F(SimulateShaft, theLcmLogHoldsTheNumbersOfTheCsvFile) {
  ::lcm::LogFile log(lcm(), "r");
  ASSERT_TRUE(log.good());
  std::size_t row = 0;
  while (const ::lcm::LogEvent* event = log.readNextEvent()) {
    ASSERT_EQ(event->channel, "SHAFT_STATE_BATCH");
    shaft_batch_t batch;
    ASSERT_EQ(batch.decode(event->data, 0, event->datalen), event->datalen);
    EXPECT_EQ(batch.stride, kEvery);
    EXPECT_EQ(event->timestamp, batch.step * 10) << "simulation time [us]";
    EXPECT_EQ(batch.stamp, batch.step * 10000) << "simulation time [ns]";
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.steps); ++i, ++row) {
      ASSERT_LT(row, table_.rows.size());
      EXPECT_EQ(batch.step + static_cast<std::int64_t>(i) * kEvery, static_cast<std::int64_t>(row) * kEvery);
      EXPECT_EQ(batch.sim_time[i], table_.number(row, "time [s]"));
      EXPECT_EQ(batch.disc_x[0][i], table_.number(row, "shaft.disc_1_x [m]"));
      EXPECT_EQ(batch.film_force_x[i], table_.number(row, "film.film_force_x [N]"));
    }
  }
  EXPECT_EQ(row, table_.rows.size());
}

}  // namespace
}  // namespace heerk_rotor

#endif
