#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/beam/beam_types.hpp"

namespace heerk_rotor {

/// How the innermost node is held. Displacements v, w and the elastic twist are always held; a hinge frees the slope.
struct BladeRoot {
  bool flap_hinge = false;   // w' free at the first node, whose radius is the hinge offset
  bool lag_hinge = false;    // v' free at the first node
  double flap_spring = 0.0;  // across the flap hinge [N m/rad]
  double lag_spring = 0.0;   // across the lag hinge [N m/rad]
  double flap_damper = 0.0;  // [N m s/rad]
  double lag_damper = 0.0;   // [N m s/rad]
};

/// One blade: spanwise tables and discretisation. Every table has one value per station, linear between them, or a single value that
/// holds everywhere. Radii count from the centre of rotation.
struct BladeProperties {
  std::vector<double> nodes;             // ends of the elements; first: structural root or hinges, last: tip [m]
  std::vector<double> stations;          // of the tables; from the first node or before to the last node or beyond [m]
  std::vector<double> mass;              // m, per length [kg/m]
  std::vector<double> EI_flap;           // EI1, about the chordwise principal axis [N m^2]
  std::vector<double> EI_lag;            // EI2 [N m^2]
  std::vector<double> GJ;                // [N m^2]
  std::vector<double> km1 = {0.0};       // flapwise radius of gyration [m]
  std::vector<double> km2 = {0.0};       // chordwise radius of gyration about the elastic axis [m]
  std::vector<double> kA = {0.0};        // polar radius of gyration of the tension-carrying area [m]
  std::vector<double> e = {0.0};         // mass centre ahead of the elastic axis [m]
  std::vector<double> eA = {0.0};        // tension axis ahead of the elastic axis [m]
  std::vector<double> EB1 = {0.0};       // section constant of twisted blades (Houbolt & Brooks) [N m^4]
  std::vector<double> EB2 = {0.0};       // [N m^3]
  std::vector<double> twist = {0.0};     // beta, built in, nose up [rad]
  double root_lead = 0.0;                // e0, elastic axis ahead of the radial line, in the hub plane [m]
  double tip_mass = 0.0;                 // point mass on the elastic axis at the last node [kg]
  double damping_mass = 0.0;             // alpha of C = alpha M + beta K [1/s]
  double damping_stiffness = 0.0;        // beta [s]
  BladeRoot root;
};

/// Properties at one radius.
struct BladeSection {
  BeamReal mass, EI_flap, EI_lag, GJ, km1, km2, kA, e, eA, EB1, EB2, twist;
  BeamReal twist_rate;  // d beta / dx [rad/m]
};

/// Twist that is linear over the radius: table for `stations`, zero at `zero_radius`, falling or rising by `per_radius` [rad] over
/// `radius` [m].
std::vector<double> linearTwist(const std::vector<double>& stations, double per_radius, double radius, double zero_radius);

/// Everything that is wrong, one sentence with found and expected each; empty when in order.
std::vector<std::string> bladeProblems(const BladeProperties& properties);

/// Properties at radius x, constant beyond the stations. The twist rate at a station is that of the segment outboard of it.
/// Expects properties without problems.
BladeSection bladeSection(const BladeProperties& properties, BeamReal x);

/// Radii between which all tables are linear, inside one element: nodes and the stations between them, ascending [m].
std::vector<double> bladeBreaks(const BladeProperties& properties);

/// t(x) = T / Omega^2 = int_x^R m r dr + tip mass times R [kg m], exact (a cubic between two breaks).
class BladeTension {
 public:
  /// Expects properties without problems.
  explicit BladeTension(const BladeProperties& properties);
  BeamReal operator()(BeamReal x) const { return outboard(x, 1, from_here_); }
  /// int_x^R m dr + tip mass [kg]: the tension of a unit acceleration along the blade.
  BeamReal massOutboard(BeamReal x) const { return outboard(x, 0, mass_from_here_); }

 private:
  BeamReal outboard(BeamReal x, int power, const std::vector<BeamReal>& from_here) const;

  std::vector<double> breaks_;            // [m]
  std::vector<BeamReal> mass_;            // at the breaks [kg/m]
  std::vector<BeamReal> from_here_;       // t at the breaks [kg m]
  std::vector<BeamReal> mass_from_here_;  // [kg]
};

/// Rigid-body data about the centre of rotation, tip mass included.
struct BladeInertia {
  double mass;           // outboard of the first node [kg]
  double first_moment;   // int m r dr [kg m]
  double second_moment;  // int m r^2 dr [kg m^2]
};
BladeInertia bladeInertia(const BladeProperties& properties);

}  // namespace heerk_rotor
