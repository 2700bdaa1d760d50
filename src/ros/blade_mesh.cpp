#include "heerk_rotor/ros/blade_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace heerk_rotor {
namespace {

using Eigen::Vector3d;

constexpr double kTwoPi = 6.283185307179586476925;
constexpr double kGripRadius = 0.04;     // the picture's blade begins here [R]
constexpr double kShankWidth = 0.4;      // of the chord, inboard of the aerofoil
constexpr double kThickness = 0.12;      // of the chord, of a helicopter's usual aerofoils
constexpr double kAxisPosition = 0.25;   // elastic axis behind the leading edge [chord]

/// A profile at one place of the span.
struct Profile {
  Vector3d position;   // of the elastic axis
  Vector3d chordwise;  // to the leading edge, unit length
  double chord, thickness;
  std_msgs::ColorRGBA colour;
};

Vector3d vector(const float* values) { return {values[0], values[1], values[2]}; }

std_msgs::ColorRGBA colour(double red, double green, double blue) {
  std_msgs::ColorRGBA c;
  c.r = static_cast<float>(red);
  c.g = static_cast<float>(green);
  c.b = static_cast<float>(blue);
  c.a = 1.0f;
  return c;
}

/// Profiles from root to tip, in the blade's own axes. Beyond the outer sections the axis goes on straight: at a free end there is no
/// bending moment.
void layProfiles(const BladeShapes& shapes, int blade, const RotorGeometry& geometry, double full_load, std::vector<Profile>& profiles) {
  profiles.clear();
  const auto& sections = shapes.section[static_cast<std::size_t>(blade)];
  const Index total = static_cast<Index>(geometry.sections.size());
  for (int i = 0; i < shapes.sections; ++i) {
    const BladeShapes::Section& s = sections[static_cast<std::size_t>(i)];
    const RotorGeometry::Section& size = geometry.sections[static_cast<std::size_t>(BladeShapeView::chosenSection(i, total))];
    profiles.push_back({vector(s.position), vector(s.chordwise), size.chord, kThickness * size.chord, loadColour(s.load / (size.width * full_load))});
  }
  if (profiles.size() < 2) return;
  const auto extended = [](const Profile& end, const Profile& neighbour, double radius) {
    Profile profile = end;
    const Vector3d along = end.position - neighbour.position;
    profile.position += along * (radius - end.position.x()) / along.x();
    return profile;
  };
  const Profile tip = extended(profiles.back(), profiles[profiles.size() - 2], geometry.radius);
  const Profile cutout = extended(profiles[0], profiles[1], geometry.root_cutout);
  profiles.push_back(tip);
  profiles.insert(profiles.begin(), cutout);
  // The shank: straight to the hub, without air load; orange on blade 1, to tell the azimuth.
  const double grip = kGripRadius * geometry.radius;
  if (geometry.root_cutout < 2.0 * grip) return;
  Profile shank = cutout;
  shank.chord *= kShankWidth;
  shank.colour = blade == 0 ? colour(0.96, 0.45, 0.05) : colour(0.42, 0.44, 0.47);
  Profile root = shank;
  shank.position *= 1.0 - 0.25 * cutout.chord / geometry.root_cutout;
  root.position *= grip / geometry.root_cutout;
  profiles.insert(profiles.begin(), {root, shank});
}

}  // namespace

std_msgs::ColorRGBA loadColour(double share) {
  static const std::array<std::array<double, 3>, 4> kStops{{{0.20, 0.33, 0.55}, {0.62, 0.66, 0.70}, {0.93, 0.83, 0.55}, {0.78, 0.30, 0.13}}};
  const double at = std::clamp(2.0 * share + 1.0, 0.0, 3.0);  // -0.5, 0, 0.5, 1
  const std::size_t i = std::min<std::size_t>(static_cast<std::size_t>(at), 2);
  const double part = at - static_cast<double>(i);
  const auto mix = [&](std::size_t c) { return (1.0 - part) * kStops[i][c] + part * kStops[i + 1][c]; };
  return colour(mix(0), mix(1), mix(2));
}

void toBladeMesh(const BladeShapes& shapes, int blade, const RotorGeometry& geometry, double full_load, visualization_msgs::Marker& marker) {
  marker.points.clear();
  marker.colors.clear();
  std::vector<Profile> profiles;
  profiles.reserve(BladeShapes::kMaxSections + 4);
  layProfiles(shapes, blade, geometry, full_load, profiles);

  // A clockwise rotor's axes are the mirror image: y and the sense of rotation change sign.
  const double mirror = geometry.clockwise ? -1.0 : 1.0, angle = mirror * kTwoPi * blade / shapes.blades;
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const auto corner = [&](const Profile& profile, int number) {
    const Vector3d up = Vector3d::UnitX().cross(profile.chordwise).normalized();
    Vector3d p = profile.position;
    switch (number % 4) {
      case 0: p += kAxisPosition * profile.chord * profile.chordwise; break;           // leading edge
      case 1: p += 0.5 * profile.thickness * up; break;
      case 2: p -= (1.0 - kAxisPosition) * profile.chord * profile.chordwise; break;   // trailing edge
      case 3: p -= 0.5 * profile.thickness * up; break;
    }
    geometry_msgs::Point point;
    point.x = cosine * p.x() - sine * mirror * p.y();
    point.y = sine * p.x() + cosine * mirror * p.y();
    point.z = p.z();
    return point;
  };
  const auto add = [&](const Profile& profile, int number) {
    marker.points.push_back(corner(profile, number));
    marker.colors.push_back(profile.colour);
  };
  for (std::size_t i = 0; i + 1 < profiles.size(); ++i)
    for (int side = 0; side < 4; ++side) {
      const Profile &inner = profiles[i], &outer = profiles[i + 1];
      add(inner, side), add(outer, side), add(outer, side + 1);
      add(inner, side), add(outer, side + 1), add(inner, side + 1);
    }
  if (!profiles.empty())  // closed at the tip
    for (const int number : {0, 1, 2, 0, 2, 3}) add(profiles.back(), number);
}

}  // namespace heerk_rotor
