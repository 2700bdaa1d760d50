#include "heerk_rotor/ros/shaft_markers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "heerk_rotor/config/configuration.hpp"

namespace heerk_rotor {
namespace {

using visualization_msgs::Marker;

struct ShaftMarkers : ::testing::Test {
  ShaftGeometry geometry = readShaftGeometry(Configuration::load(HEERK_SOURCE_DIR "/config/dual_disc.yaml"));
  ShaftReading reading;
  ShaftShape shape;
  OrbitTrail trail;
  visualization_msgs::MarkerArray message;

  void draw() { toMarkers(reading, shape, trail, geometry, ros::Time(5.0), message); }
  const Marker* find(const std::string& space, int id = 0) const {
    for (const Marker& marker : message.markers)
      if (marker.ns == space && marker.id == id) return &marker;
    return nullptr;
  }
  /// One turn per 100 readings.
  void turn(int readings, std::uint32_t epoch = 0) {
    for (int i = 0; i < readings; ++i) {
      reading.epoch = epoch;
      reading.discs = 2;
      reading.azimuth += 2.0 * M_PI / 100.0;
      reading.journal_x = 1e-5 * std::cos(reading.azimuth);
      reading.journal_y = 1e-5 * std::sin(reading.azimuth);
      reading.disc_x[1] = 3e-5;
      trail.add(reading);
    }
  }
};

TEST_F(ShaftMarkers, sizesComeFromTheConfiguration) {
  ASSERT_EQ(geometry.nodes.size(), 9u);
  EXPECT_NEAR(geometry.length(), 0.564, 1e-12);
  ASSERT_EQ(geometry.discs.size(), 2u);
  EXPECT_NEAR(geometry.discs[0].z, 0.144, 1e-12);
  EXPECT_NEAR(geometry.discs[0].radius, std::sqrt(2.0 * 0.1882 / 18.745), 1e-12);
  // Both discs have the same thickness: that is what the second one's polar inertia was derived from.
  EXPECT_NEAR(geometry.discs[0].thickness, geometry.discs[1].thickness, 2e-4);
  ASSERT_EQ(geometry.bearings.size(), 2u);
  EXPECT_NEAR(geometry.journal, 0.538, 1e-12);
  EXPECT_EQ(geometry.clearance, 1.6e-4);
  EXPECT_NEAR(geometry.housing_y, 0.32e-4, 1e-18);  // the journal rests below the centre
  EXPECT_EQ(geometry.magnification(), 500.0);       // 0.15 x 0.564 m / 0.16 mm = 529
}

TEST_F(ShaftMarkers, displacementsAreMagnifiedAndTheTextSaysSo) {
  reading.discs = 2;
  reading.disc_x = {1e-4, -2e-4};
  reading.disc_y = {3e-5, 4e-5};
  reading.journal_y = -5e-5;
  shape.nodes = 9;
  shape.x[4] = 1.5e-4f;
  draw();
  ASSERT_NE(find("centres", 1), nullptr);
  EXPECT_DOUBLE_EQ(find("centres", 1)->pose.position.x, -0.1);
  EXPECT_DOUBLE_EQ(find("centres", 1)->pose.position.y, 0.02);
  EXPECT_DOUBLE_EQ(find("centres", 2)->pose.position.y, -0.025);
  EXPECT_NEAR(find("shaft")->points[4].x, 0.075, 1e-6);
  EXPECT_NE(find("text")->text.find("displacements x 500"), std::string::npos) << find("text")->text;
  for (const Marker& marker : message.markers) {
    EXPECT_EQ(marker.header.frame_id, "shaft_link");
    EXPECT_EQ(marker.header.stamp, ros::Time(5.0));
  }
}

TEST_F(ShaftMarkers, theClearanceCircleStandsAroundTheHousing) {
  draw();
  const Marker* circle = find("clearance");
  ASSERT_NE(circle, nullptr);
  for (const geometry_msgs::Point& p : circle->points) EXPECT_NEAR(std::hypot(p.x, p.y - 500.0 * 0.32e-4), 500.0 * 1.6e-4, 1e-12);
}

TEST_F(ShaftMarkers, orbitsHoldTheLastTurnsOnly) {
  turn(50);
  draw();
  ASSERT_NE(find("orbits", 2), nullptr);
  EXPECT_EQ(find("orbits", 2)->points.size(), 50u);
  turn(1000);
  draw();
  const Marker* journal = find("orbits", 2);
  EXPECT_NEAR(static_cast<double>(journal->points.size()), 300.0, 1.0);
  EXPECT_EQ(journal->colors.size(), journal->points.size());
  EXPECT_LT(journal->colors.front().a, 0.3f);
  EXPECT_EQ(journal->colors.back().a, 1.0f);
  EXPECT_DOUBLE_EQ(journal->points.back().x, 500.0 * reading.journal_x);
  EXPECT_NEAR(journal->points.front().z, geometry.journal, 1e-12);
  EXPECT_DOUBLE_EQ(find("orbits", 1)->points.front().x, 0.015);
}

TEST_F(ShaftMarkers, anotherEpochBeginsAnotherOrbit) {
  turn(500);
  turn(20, 1);
  draw();
  EXPECT_EQ(find("orbits", 2)->points.size(), 20u);
}

TEST_F(ShaftMarkers, withoutADamperThereIsNoneInThePicture) {
  geometry.clearance = 0.0;
  turn(50);
  draw();
  EXPECT_EQ(find("clearance"), nullptr);
  EXPECT_EQ(find("orbits", 2), nullptr);
  EXPECT_NE(find("orbits", 1), nullptr);
}

}  // namespace
}  // namespace heerk_rotor
