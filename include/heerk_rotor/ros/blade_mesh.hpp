#pragma once
#include <visualization_msgs/Marker.h>

#include "heerk_rotor/assembly/blade_shapes.hpp"
#include "heerk_rotor/ros/rotor_geometry.hpp"

namespace heerk_rotor {

/// Draws one elastic blade as triangles: the deformed elastic axis carries a lens-shaped profile with the local chord, pitch and
/// twist, from the hub's grip to the tip. Coloured by the local air load per span, `full_load` [N/m] upwards getting the end of the scale:
/// slate blue for downward load, grey for none, sand, rust for full load. Blade 1 has an orange shank.
/// Axes of the picture: rotor_link, with blade `blade` at its place in the sense of rotation. Fills points and colours.
void toBladeMesh(const BladeShapes& shapes, int blade, const RotorGeometry& geometry, double full_load, visualization_msgs::Marker& marker);

/// The colour of that scale for load / full load.
std_msgs::ColorRGBA loadColour(double share);

}  // namespace heerk_rotor
