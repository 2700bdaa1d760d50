#pragma once
#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>

#include "heerk_rotor/assembly/blade_shapes.hpp"
#include "heerk_rotor/assembly/rotor_view.hpp"
#include "heerk_rotor/ros/rotor_geometry.hpp"

namespace heerk_rotor {

/// Scales of the picture.
struct MarkerScale {
  double lag_range = 0.02;         // lag angle away from the blades' mean that gets the full colour [rad]
  double force_length = 1e-4;      // arrow length per force [m/N]: 3 m for the weight of 3 t
  double lift_coefficient = 0.5;   // at 0.8 R and sea level; the air load that this makes gets the end of the colour scale [-]
};

/// Draws one instant: the blades in rotor_link; the path of their tips and an arrow of the hub force in hub_link.
/// Elastic blades are drawn deformed and coloured by their air load (blade_mesh.hpp). A rigid one is a plate at its azimuth, flap, lag
/// and pitch, grey where it lags as much as the mean of all, red where it leads and blue where it lags behind it. Fills an existing
/// message.
void toMarkers(const RotorReading& reading, const BladeShapes& shapes, const RotorGeometry& geometry, const MarkerScale& scale, const ros::Time& stamp,
               visualization_msgs::MarkerArray& message);

}  // namespace heerk_rotor
