#include "heerk_rotor/ros/rotor_markers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include <Eigen/Geometry>

namespace heerk_rotor {
namespace {

const RotorGeometry kGeometry{0.2, 5.0, 0.8, 0.32};

visualization_msgs::MarkerArray draw(const RotorReading& reading) {
  visualization_msgs::MarkerArray markers;
  toMarkers(reading, kGeometry, MarkerScale(), ros::Time(1, 0), markers);
  return markers;
}

RotorReading fourBlades(double azimuth) {
  RotorReading r;
  r.blades = 4;
  r.azimuth = azimuth;
  return r;
}

Eigen::Vector3d position(const visualization_msgs::Marker& m) { return {m.pose.position.x, m.pose.position.y, m.pose.position.z}; }
Eigen::Quaterniond rotation(const visualization_msgs::Marker& m) { return {m.pose.orientation.w, m.pose.orientation.x, m.pose.orientation.y, m.pose.orientation.z}; }
/// The end of the blade plate.
Eigen::Vector3d tip(const visualization_msgs::Marker& m) { return position(m) + rotation(m) * Eigen::Vector3d(0.5 * m.scale.x, 0.0, 0.0); }

TEST(RotorMarkers, bladesStandInTheTurningFrameWhateverTheAzimuth) {
  const auto markers = draw(fourBlades(1.234));
  ASSERT_EQ(markers.markers.size(), 5u);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(markers.markers[k].header.frame_id, "rotor_link");
    const double psi = k * 0.5 * M_PI;
    EXPECT_LT((tip(markers.markers[k]) - Eigen::Vector3d(5.0 * std::cos(psi), 5.0 * std::sin(psi), 0.0)).norm(), 1e-12) << k;
  }
  EXPECT_EQ(markers.markers[4].header.frame_id, "hub_link");
}

TEST(RotorMarkers, leadTurnsTheBladeWithTheRotationAboutItsHinge) {
  RotorReading r = fourBlades(0.0);
  r.lag[0] = 0.1;
  const Eigen::Vector3d expected(0.2 + 4.8 * std::cos(0.1), 4.8 * std::sin(0.1), 0.0);
  EXPECT_LT((tip(draw(r).markers[0]) - expected).norm(), 1e-12);
}

TEST(RotorMarkers, flapLiftsTheTipAndPitchRaisesTheLeadingEdge) {
  RotorReading r = fourBlades(0.0);
  r.flap[0] = 0.05;
  r.pitch[1] = 0.2;
  const auto markers = draw(r);
  EXPECT_NEAR(tip(markers.markers[0]).z(), 4.8 * std::sin(0.05), 1e-12);
  // The leading edge is +y of the blade.
  EXPECT_NEAR((rotation(markers.markers[1]) * Eigen::Vector3d::UnitY()).z(), std::sin(0.2), 1e-12);
}

TEST(RotorMarkers, aBladeThatLeadsTheMeanIsRedAndOneThatLagsIsBlue) {
  RotorReading r = fourBlades(1.0);
  r.lag_collective = -0.03;
  r.lag = {-0.01, -0.05, -0.03, -0.03};
  const auto markers = draw(r);
  EXPECT_GT(markers.markers[0].color.r, 0.8);
  EXPECT_LT(markers.markers[0].color.b, 0.2);
  EXPECT_GT(markers.markers[1].color.b, 0.8);
  EXPECT_LT(markers.markers[1].color.r, 0.2);
  EXPECT_EQ(markers.markers[2].color.r, markers.markers[2].color.b);
}

TEST(RotorMarkers, theArrowShowsTheHubForce) {
  RotorReading r = fourBlades(0.0);
  r.hub_force = {1000.0, -2000.0, 30000.0};
  const auto& arrow = draw(r).markers.back();
  ASSERT_EQ(arrow.points.size(), 2u);
  EXPECT_NEAR(arrow.points[1].x, 0.1, 1e-12);
  EXPECT_NEAR(arrow.points[1].y, -0.2, 1e-12);
  EXPECT_NEAR(arrow.points[1].z, 3.0, 1e-12);
}

}  // namespace
}  // namespace heerk_rotor
