#pragma once
#include <string>
#include <vector>

namespace heerk_rotor {

/// A rigid disc on a node. Its mass centre lies unbalance / mass from the axis, at unbalance_angle ahead of the rotor's azimuth.
struct ShaftDisc {
  int node = 0;
  double mass = 0.0;               // [kg]
  double diametral_inertia = 0.0;  // [kg m^2]
  double polar_inertia = 0.0;      // [kg m^2]
  double unbalance = 0.0;          // [kg m]
  double unbalance_angle = 0.0;    // [rad]
};

/// A linear bearing between a node and the ground.
struct ShaftBearing {
  int node = 0;
  double stiffness_x = 0.0, stiffness_y = 0.0;  // [N/m]
  double damping_x = 0.0, damping_y = 0.0;      // [N s/m]
};

/// A rotating shaft of circular section: segments from node 0 on, discs and bearings on the nodes.
struct ShaftProperties {
  std::vector<double> segments;              // length of each finite element [m]
  std::vector<double> diameter;              // one, or one per segment [m]
  std::vector<double> inner_diameter = {0};  // of the bore; one, or one per segment [m]
  double youngs_modulus = 2.1e11;            // [N/m^2]
  double density = 7850.0;                   // [kg/m^3]
  double poisson_ratio = 0.3;                // [-], for shear only
  bool shear = false;                        // Timoshenko instead of Euler-Bernoulli
  double mass_damping = 0.0;                 // C = alpha M + beta K of the shaft: alpha [1/s]
  double stiffness_damping = 0.0;            // beta [s], of the segments' stiffness in fixed axes
  std::vector<ShaftDisc> discs;
  std::vector<ShaftBearing> bearings;

  int nodes() const { return static_cast<int>(segments.size()) + 1; }
};

/// Everything that is wrong, one sentence with found and expected each; empty when in order.
std::vector<std::string> shaftProblems(const ShaftProperties& properties);

}  // namespace heerk_rotor
