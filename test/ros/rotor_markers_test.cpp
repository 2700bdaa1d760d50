#include "heerk_rotor/ros/rotor_markers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "heerk_rotor/ros/blade_mesh.hpp"

namespace heerk_rotor {
namespace {

const RotorGeometry kGeometry{0.2, 5.0, 0.8, 0.32, false, {}};

visualization_msgs::MarkerArray draw(const RotorReading& reading) {
  visualization_msgs::MarkerArray markers;
  toMarkers(reading, BladeShapes(), kGeometry, MarkerScale(), ros::Time(1, 0), markers);
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
  ASSERT_EQ(markers.markers.size(), 6u);
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

TEST(RotorMarkers, theTipPathIsConedAndTiltedByTheFlap) {
  RotorReading r = fourBlades(0.7);
  r.flap_collective = 0.05;
  r.flap_cosine = 0.02;  // aft side up
  r.flap_sine = 0.01;    // right side up
  const auto& ring = draw(r).markers[4];
  EXPECT_EQ(ring.header.frame_id, "hub_link");
  ASSERT_EQ(ring.points.size(), 73u);
  EXPECT_NEAR(ring.points[0].x, -5.0, 1e-12);  // psi = 0: over the tail
  EXPECT_NEAR(ring.points[0].z, 4.8 * 0.07, 1e-12);
  EXPECT_NEAR(ring.points[18].y, -5.0, 1e-12);  // 90 deg: right
  EXPECT_NEAR(ring.points[18].z, 4.8 * 0.06, 1e-12);
  EXPECT_NEAR(ring.points[36].z, 4.8 * 0.03, 1e-12);
}

/// Three straight sections of blade `blade` of `blades` at flap angle beta, with the leading edge along y; loads ascending.
BladeShapes straightBlades(int blades, double beta) {
  BladeShapes shapes;
  shapes.blades = blades;
  shapes.sections = 3;
  for (int k = 0; k < blades; ++k)
    for (int i = 0; i < 3; ++i) {
      const double r = 1.5 + i;
      shapes.section[k][i] = {{static_cast<float>(r), 0.0f, static_cast<float>(r * std::tan(beta))}, {0.0f, 1.0f, 0.0f}, 500.0f * static_cast<float>(i)};
    }
  return shapes;
}

RotorGeometry elasticGeometry(bool clockwise) { return {0.0, 4.0, 1.0, 0.4, clockwise, {{1.0, 0.4}, {1.0, 0.4}, {1.0, 0.4}}}; }

visualization_msgs::Marker drawElastic(int blades, int k, bool clockwise) {
  RotorReading r;
  r.blades = blades;
  r.rotor_speed = 40.0;
  visualization_msgs::MarkerArray markers;
  toMarkers(r, straightBlades(blades, 0.1), elasticGeometry(clockwise), MarkerScale(), ros::Time(1, 0), markers);
  EXPECT_EQ(markers.markers.size(), static_cast<std::size_t>(blades) + 2);
  return markers.markers[static_cast<std::size_t>(k)];
}

TEST(RotorMarkers, elasticBladesReachFromTheGripToTheTipAlongTheirAxis) {
  const visualization_msgs::Marker blade = drawElastic(5, 0, false);
  EXPECT_EQ(blade.type, visualization_msgs::Marker::TRIANGLE_LIST);
  EXPECT_EQ(blade.header.frame_id, "rotor_link");
  // 7 profiles: root, shank, root cut-out, 3 sections, tip; 4 faces of 2 triangles between two of them; the tip's cap.
  ASSERT_EQ(blade.points.size(), 6u * 4 * 2 * 3 + 6);
  ASSERT_EQ(blade.colors.size(), blade.points.size());
  double least = 1e9, most = 0.0, leading = 0.0, trailing = 0.0;
  for (const geometry_msgs::Point& p : blade.points) {
    least = std::min(least, p.x);
    most = std::max(most, p.x);
    leading = std::max(leading, p.y);
    trailing = std::min(trailing, p.y);
    EXPECT_NEAR(p.z, p.x * std::tan(0.1), 0.5 * 0.12 * 0.4 + 1e-6);  // half the thickness
  }
  EXPECT_NEAR(least, 0.16, 1e-6);  // 0.04 R
  EXPECT_NEAR(most, 4.0, 1e-6);
  EXPECT_NEAR(leading, 0.25 * 0.4, 1e-6);
  EXPECT_NEAR(trailing, -0.75 * 0.4, 1e-6);
}

TEST(RotorMarkers, aClockwiseRotorIsTheMirrorImage) {
  for (int k = 0; k < 5; ++k) {
    const visualization_msgs::Marker ccw = drawElastic(5, k, false), cw = drawElastic(5, k, true);
    ASSERT_EQ(ccw.points.size(), cw.points.size());
    for (std::size_t i = 0; i < ccw.points.size(); ++i) {
      ASSERT_NEAR(cw.points[i].x, ccw.points[i].x, 1e-12);
      ASSERT_NEAR(cw.points[i].y, -ccw.points[i].y, 1e-12);
      ASSERT_NEAR(cw.points[i].z, ccw.points[i].z, 1e-12);
    }
  }
  // Rigid blades likewise: lead is with the rotation, the leading edge goes up with the pitch.
  RotorReading r = fourBlades(0.0);
  r.lag = {0.1, 0.02, 0.0, 0.0};
  r.pitch = {0.2, 0.1, 0.0, 0.0};
  RotorGeometry mirrored = kGeometry;
  mirrored.clockwise = true;
  visualization_msgs::MarkerArray markers;
  toMarkers(r, BladeShapes(), mirrored, MarkerScale(), ros::Time(1, 0), markers);
  const auto usual = draw(r);
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d a = tip(usual.markers[k]), b = tip(markers.markers[k]);
    EXPECT_LT((Eigen::Vector3d(a.x(), -a.y(), a.z()) - b).norm(), 1e-12) << k;
    EXPECT_NEAR((rotation(markers.markers[k]) * -Eigen::Vector3d::UnitY()).z(), (rotation(usual.markers[k]) * Eigen::Vector3d::UnitY()).z(), 1e-12) << k;
  }
}

TEST(RotorMarkers, theColourFollowsTheLoadPerSpan) {
  const visualization_msgs::Marker blade = drawElastic(4, 1, false);
  // 1000 N on 1 m over what a lift coefficient of 0.5 makes of 0.4 m chord at 0.8 R.
  const double full = 0.5 * 1.225 * std::pow(0.8 * 4.0 * 40.0, 2) * 0.4 * 0.5;
  const std_msgs::ColorRGBA expected = loadColour(1000.0 / full), none = loadColour(0.0);
  EXPECT_NEAR(blade.colors.back().r, expected.r, 1e-6);
  EXPECT_NEAR(blade.colors.back().b, expected.b, 1e-6);
  EXPECT_GT(expected.r - expected.b, none.r - none.b + 0.05);           // lift is warm
  EXPECT_LT(loadColour(-0.5).r - loadColour(-0.5).b, none.r - none.b);  // download is cold
  EXPECT_EQ(loadColour(7.0).r, loadColour(1.0).r);
}

}  // namespace
}  // namespace heerk_rotor
