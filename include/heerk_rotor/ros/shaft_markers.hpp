#pragma once
#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>

#include "heerk_rotor/assembly/shaft_shape.hpp"
#include "heerk_rotor/ros/orbit_trail.hpp"
#include "heerk_rotor/ros/shaft_geometry.hpp"

namespace heerk_rotor {

/// Draws a shaft in shaft_link: its centre line and discs, the orbits of disc centres and journal over the last turns, the
/// journal's circle of clearance in its housing, bearings, the film force, and a text that states the magnification, by which all
/// displacements are enlarged. Sizes along and of the shaft are true. Fills an existing message.
void toMarkers(const ShaftReading& reading, const ShaftShape& shape, const OrbitTrail& trail, const ShaftGeometry& geometry, const ros::Time& stamp,
               visualization_msgs::MarkerArray& message);

}  // namespace heerk_rotor
