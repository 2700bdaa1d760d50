#pragma once
#include <cmath>
#include <vector>

#include "heerk_rotor/beam/beam_types.hpp"
#include "heerk_rotor/beam/blade_properties.hpp"

namespace heerk_rotor {

/// A function of the pitch angle theta [rad]: constant + cos1 cos(theta) + sin1 sin(theta) + cos2 cos(2 theta) + sin2 sin(2 theta).
template <class Value>
struct PitchHarmonics {
  Value constant, cos1, sin1, cos2, sin2;

  Value at(BeamReal theta) const { return evenPart(theta) + oddPart(theta); }
  Value evenPart(BeamReal theta) const { return constant + std::cos(2 * theta) * cos2 + std::sin(2 * theta) * sin2; }
  Value oddPart(BeamReal theta) const { return std::cos(theta) * cos1 + std::sin(theta) * sin1; }
};

/// Finite elements of one rotating blade: flap, lag and torsion after Houbolt & Brooks (NACA TR 1346), linear in the elastic
/// displacements, in pitched axes: x outboard, y toward the leading edge, z up, turning with the pitch theta, so that the root clamp
/// stays homogeneous and M, K0 do not depend on theta. Cubic Hermite v and w, linear twist, 5 degrees of freedom per node; section
/// integrals by Gauss quadrature between breaks, exact for piecewise linear properties where the twist is constant, and to rounding
/// for the twist angles of blades. No bending rotary inertia (as Houbolt & Brooks).
///
///   M q.. + (C + 2 Omega_x G) q. + K q = load,     K = K0 + Omega^2 (cos^2 p K1e(theta) + K1o(theta) - sin^2 p P)
///
/// with rotor speed Omega, precone p and Omega_x = Omega sin p + theta., the turn rate about the blade's own axis. K1e and K1o are
/// the even and odd harmonics of K1: the odd ones stem from the root lead e0, on which both components of Omega act alike. All
/// matrices are in the free degrees of freedom (size n), SI, symmetric to the last bit except G, which is antisymmetric.
struct BladeMatrices {
  BeamMatrix M;                    // mass
  BeamMatrix K0;                   // elastic stiffness, hinge springs included
  PitchHarmonics<BeamMatrix> K1;   // tension, in-plane inertia relief and tennis-racket term, per Omega^2
  BeamMatrix P;                    // int m (v^2 + w^2 + ...): relief by a rotation about x, per square of its rate
  BeamMatrix G;                    // Coriolis: row v carries -w., row w carries +v., taken at the mass centre
  BeamMatrix C_hinge;              // hinge dampers [N m s/rad]
  PitchHarmonics<BeamVector> steady;  // centrifugal load per Omega^2: offsets, untwisting by tension, propeller moment
  BeamVector steady_x;             // centrifugal load of a rotation about x, without the part of e0, per square of its rate

  /// Generalised loads of unit accelerations: int m (a . displacement of the mass centre). Hub motion, gravity, precone and pitch
  /// acceleration are combinations of these.
  BeamVector inertia_v;    // of 1 m/s^2 along y
  BeamVector inertia_w;    // of 1 m/s^2 along z
  BeamVector inertia_rv;   // of r times 1 rad/s^2 along y: angular acceleration about z
  BeamVector inertia_rw;   // of r times 1 rad/s^2 along z
  BeamVector inertia_twist;  // of 1 rad/s^2 about x: int m (km1^2 + km2^2) phi and the mass-centre offset
  BeamVector inertia_u;      // of 1 m/s^2 along x: displacements along the blade that are linear in the degrees of freedom

  /// Second-order displacements of the mass: int m u = inertia_u' q - q' T0 q / 2 with foreshortening by slopes and twist, and
  /// int m v = inertia_v' q - q' E_v q / 2, likewise w, from turning the mass-centre offset.
  BeamMatrix T0, E_v, E_w;
  /// The undeformed blade about the origin of its axes, without root lead.
  double mass = 0.0;                                        // [kg]
  Eigen::Vector3d first_moment = Eigen::Vector3d::Zero();   // int m r [kg m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();        // int m (r^2 I - r r') [kg m^2]

  std::vector<double> nodes;  // [m]
  std::vector<int> free_dof;  // global number 5 * node + NodeDof -> row here, or -1 where held
  double alpha = 0.0;         // of C = alpha M + beta K + C_hinge [1/s]
  double beta = 0.0;          // [s]

  Eigen::Index size() const { return M.rows(); }

  /// K at rotor speed [rad/s], pitch [rad] and precone [rad].
  BeamMatrix stiffness(BeamReal omega, BeamReal theta = 0, BeamReal precone = 0) const;

  /// alpha M + beta K + C_hinge for that K.
  BeamMatrix damping(const BeamMatrix& K) const;

  /// Steady load of rotation at constant speed: offsets and twist, and with precone the flattening -Omega^2 sin p cos p m r toward
  /// the disc.
  BeamVector steadyLoad(BeamReal omega, BeamReal theta = 0, BeamReal precone = 0) const;

  /// Displacements, twist and slopes at radius r per unit of each free degree of freedom, (kShapeRows x n).
  /// Throws std::invalid_argument for r outside the nodes.
  BeamMatrix shapeRows(double r) const;
};

/// Assembles one blade. Throws std::invalid_argument with all problems of the properties.
BladeMatrices assembleBlade(const BladeProperties& properties);

}  // namespace heerk_rotor
