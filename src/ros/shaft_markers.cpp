#include "heerk_rotor/ros/shaft_markers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "heerk_rotor/ros/conversions.hpp"

namespace heerk_rotor {
namespace {

using visualization_msgs::Marker;

constexpr double kTwoPi = 6.283185307179586476925;
constexpr double kForceLength = 2e-4;  // arrow per film force [m/N]: 100 mm for 500 N

std_msgs::ColorRGBA colour(float r, float g, float b, float a) {
  std_msgs::ColorRGBA c;
  c.r = r, c.g = g, c.b = b, c.a = a;
  return c;
}

/// Of disc 1, 2, .. and of the journal.
std_msgs::ColorRGBA discColour(std::size_t disc, float alpha) { return disc % 2 == 0 ? colour(0.25f, 0.62f, 0.95f, alpha) : colour(0.35f, 0.8f, 0.55f, alpha); }
std_msgs::ColorRGBA journalColour(float alpha) { return colour(1.0f, 0.62f, 0.2f, alpha); }

geometry_msgs::Point point(double x, double y, double z) {
  geometry_msgs::Point p;
  p.x = x, p.y = y, p.z = z;
  return p;
}

/// Takes one marker of the message after the other, so that its memory is used again.
class Drawing {
 public:
  Drawing(const ros::Time& stamp, visualization_msgs::MarkerArray& message) : stamp_(stamp), message_(message) {}

  Marker& next(const char* space, int id, int type, double size, const std_msgs::ColorRGBA& c) {
    if (used_ == message_.markers.size()) message_.markers.emplace_back();
    Marker& marker = message_.markers[used_++];
    marker.header.stamp = stamp_;
    marker.header.frame_id = frames::kShaft;
    marker.ns = space;
    marker.id = id;
    marker.type = type;
    marker.action = Marker::ADD;
    marker.frame_locked = true;
    marker.pose.orientation.w = 1.0;
    marker.scale.x = marker.scale.y = marker.scale.z = size;
    marker.color = c;
    marker.points.clear();
    marker.colors.clear();
    return marker;
  }
  void finish() { message_.markers.resize(used_); }

 private:
  const ros::Time& stamp_;
  visualization_msgs::MarkerArray& message_;
  std::size_t used_ = 0;
};

void drawOrbits(const OrbitTrail& trail, const ShaftGeometry& geometry, double scale, Drawing& drawing) {
  const std::size_t begin = trail.begin(), discs = geometry.discs.size();
  if (trail.size() - begin < 2) return;
  for (std::size_t orbit = 0; orbit <= discs; ++orbit) {
    const bool journal = orbit == discs;
    if (journal && geometry.clearance <= 0.0) return;
    Marker& line = drawing.next("orbits", static_cast<int>(orbit), Marker::LINE_STRIP, 0.0025, colour(1, 1, 1, 1));
    for (std::size_t i = begin; i < trail.size(); ++i) {
      const ShaftReading& r = trail[i];
      const float age = static_cast<float>(trail.size() - 1 - i) / static_cast<float>(trail.size() - begin);
      const double x = journal ? r.journal_x : r.disc_x[orbit], y = journal ? r.journal_y : r.disc_y[orbit];
      line.points.push_back(point(scale * x, scale * y, journal ? geometry.journal : geometry.discs[orbit].z));
      line.colors.push_back(journal ? journalColour(1.0f - 0.8f * age) : discColour(orbit, 1.0f - 0.8f * age));
    }
  }
}

void drawShaft(const ShaftReading& reading, const ShaftShape& shape, const ShaftGeometry& geometry, double scale, Drawing& drawing) {
  Marker& axis = drawing.next("axis", 0, Marker::LINE_STRIP, 0.001, colour(0.75f, 0.75f, 0.75f, 0.5f));
  axis.points.push_back(point(0.0, 0.0, -0.05 * geometry.length()));
  axis.points.push_back(point(0.0, 0.0, 1.05 * geometry.length()));
  if (shape.nodes == static_cast<int>(geometry.nodes.size()) && shape.nodes > 1) {
    Marker& line = drawing.next("shaft", 0, Marker::LINE_STRIP, 0.2 * geometry.diameter, colour(0.85f, 0.87f, 0.9f, 1.0f));
    for (std::size_t i = 0; i < geometry.nodes.size(); ++i)
      line.points.push_back(point(scale * static_cast<double>(shape.x[i]), scale * static_cast<double>(shape.y[i]), geometry.nodes[i]));
  }
  for (std::size_t i = 0; i < geometry.discs.size(); ++i) {
    const ShaftGeometry::Disc& disc = geometry.discs[i];
    const geometry_msgs::Point centre = point(scale * reading.disc_x[i], scale * reading.disc_y[i], disc.z);
    Marker& body = drawing.next("discs", static_cast<int>(i), Marker::CYLINDER, 2.0 * disc.radius, discColour(i, 0.22f));
    body.pose.position = centre;
    body.scale.z = disc.thickness;
    drawing.next("centres", static_cast<int>(i), Marker::SPHERE, 0.009, discColour(i, 1.0f)).pose.position = centre;
  }
}

void drawDamper(const ShaftReading& reading, const ShaftGeometry& geometry, double scale, Drawing& drawing) {
  if (geometry.clearance <= 0.0) return;
  constexpr int kPoints = 72;
  Marker& circle = drawing.next("clearance", 0, Marker::LINE_STRIP, 0.003, colour(0.95f, 0.95f, 0.95f, 0.9f));
  for (int i = 0; i <= kPoints; ++i) {
    const double angle = kTwoPi * i / kPoints;
    circle.points.push_back(point(scale * (geometry.housing_x + geometry.clearance * std::cos(angle)), scale * (geometry.housing_y + geometry.clearance * std::sin(angle)), geometry.journal));
  }
  const geometry_msgs::Point journal = point(scale * reading.journal_x, scale * reading.journal_y, geometry.journal);
  drawing.next("centres", static_cast<int>(geometry.discs.size()), Marker::SPHERE, 0.009, journalColour(1.0f)).pose.position = journal;
  Marker& force = drawing.next("film_force", 0, Marker::ARROW, 0.005, colour(0.95f, 0.3f, 0.25f, 1.0f));
  force.scale.y = 0.012;  // head: diameter, length
  force.scale.z = 0.015;
  force.points.push_back(journal);
  force.points.push_back(point(journal.x + kForceLength * reading.film_force_x, journal.y + kForceLength * reading.film_force_y, journal.z));
}

void drawText(const ShaftReading& reading, const ShaftGeometry& geometry, double scale, Drawing& drawing) {
  Marker& marker = drawing.next("text", 0, Marker::TEXT_VIEW_FACING, 0.028, colour(0.95f, 0.95f, 0.95f, 1.0f));
  char text[256];
  std::snprintf(text, sizeof text, "displacements x %.0f, orbits of the last %.0f turns\n%.0f rpm, journal eccentricity %.3f of the clearance", scale, OrbitTrail::kTurns,
                reading.rotor_speed * 60.0 / kTwoPi, reading.eccentricity_ratio);
  marker.text = text;
  double top = 0.0;
  for (const ShaftGeometry::Disc& disc : geometry.discs) top = std::max(top, disc.radius);
  marker.pose.position = point(0.0, top + 0.15 * geometry.length(), 0.5 * geometry.length());
}

}  // namespace

void toMarkers(const ShaftReading& reading, const ShaftShape& shape, const OrbitTrail& trail, const ShaftGeometry& geometry, const ros::Time& stamp,
               visualization_msgs::MarkerArray& message) {
  const double scale = geometry.magnification();
  Drawing drawing(stamp, message);
  drawShaft(reading, shape, geometry, scale, drawing);
  drawDamper(reading, geometry, scale, drawing);
  drawOrbits(trail, geometry, scale, drawing);
  drawText(reading, geometry, scale, drawing);
  for (std::size_t i = 0; i < geometry.bearings.size(); ++i)
    drawing.next("bearings", static_cast<int>(i), Marker::CUBE, 0.7 * geometry.diameter, colour(0.55f, 0.57f, 0.6f, 0.35f)).pose.position = point(0.0, 0.0, geometry.bearings[i]);
  drawing.finish();
}

}  // namespace heerk_rotor
