#pragma once
#include <cstdint>
#include <vector>

#include "blade_axes.hpp"
#include "blade_deformation.hpp"

namespace heerk_rotor {

/// What the hub does to the blades at one instant, apart from the axes' own rates: in R.
template <int L>
struct HubAcceleration {
  Lanes3<L> linear;             // specific force: acceleration minus gravity, of the origin [m/s^2]
  Lanes3<L> angular;            // of R [rad/s^2]
  LaneVector<L> pitch;          // [rad/s^2]
};

/// Equations of motion of all blades as finite elements on a hub that moves in any way, blades in lanes.
///
/// With generalised displacements q, let m, S(q), J(q) be mass, first moment and inertia tensor of a blade about the origin of B and
/// h(q, q') its angular momentum by deformation, all to second order in q (S = int m r, with foreshortening). From
///   L = m v^2/2 + v.(w x S + S') + w.J w/2 + w.h + q'.q'/2 - V
/// follow, with specific force a and angular acceleration w' of B,
///   q'' + c q' + k q = Q - S_q.a - h_q'.w' + (w.J_q w)/2 + ...
///   force  F = m a + w' x S + 2 w x S' + w x (w x S) + S''          that the hub exerts on the blade, less the airloads
///   moment N = J w' + S x a + J' w + w x (J w + h) + h'
/// J, S and h are the very forms that the beam's equations of motion (BladeMatrices) are made of, so that linear and angular
/// momentum and energy balance exactly, whatever the hub does. Frame of all: B. State: modal q, then q', [mode][blade],
/// relative to the drive for slow modes (BladeCoefficients).
///
/// F and N are linear in the accelerations A = (a, w') of the hub: with the modal loads S_q and h_q' of unit accelerations ("hub rows"),
/// q'' = Q' - rows A, and what q'' carries of F and N is rows'q'' = rows'Q' - (rows'rows) A. So the 6 x 6 matrices rows'rows serve every
/// A at one state, and q'' itself is needed only once the hub's accelerations are found.
///
/// Evaluation in three levels, each repeated only when its arguments differ bitwise from last time (a pure function with a memory of
/// its last value):  state -> deformation and forms;  + rates, pitch, airloads -> modal loads;  + accelerations -> F, N, and q'' on demand.
template <int L>
class BladeDynamics {
 public:
  using Vec = LaneVector<L>;
  using Vec3 = Lanes3<L>;

  explicit BladeDynamics(const FeRotorParameters& parameters);
  BladeDynamics(const BladeDynamics&) = delete;
  BladeDynamics& operator=(const BladeDynamics&) = delete;

  const BladeCoefficients& coefficients() const { return deformation_.coefficients(); }

  /// Level 1, arguments as for BladeDeformation.
  void deform(const double* x, const double (&twist)[2], bool same_x) noexcept;
  /// Displacements, and their rates, at section j (sections: tip).
  SectionMotion<L> displacement(int j) const noexcept { return deformation_.displacement(j); }
  SectionMotion<L> displacementRate(int j) const noexcept { return deformation_.displacementRate(j); }

  /// Level 2. loads: [section][fx fy fz in R, pitching moment][blade]. version: differs whenever the axes do, and stands for them when
  /// arguments are compared.
  void load(const BladeAxes<L>& axes, std::uint64_t version, const double* loads) noexcept;

  /// Level 3. Root lead, precone and pitch rate are accounted for here.
  void accelerate(const BladeAxes<L>& axes, const HubAcceleration<L>& hub) noexcept;
  /// What remains of the states' second derivatives beside the modal oscillators of S, [mode][blade]. twist: of the mast, its rate and its acceleration.
  void storeRemainder(const double (&twist)[3], double* to) noexcept;
  /// Second derivative of the displacements at section j.
  SectionMotion<L> displacementAcceleration(int j) noexcept;
  /// Force and moment of the blades on the hub about its centre, in R.
  Vec3 rootForce() const noexcept { return root_force_; }
  Vec3 rootMoment() const noexcept { return root_moment_; }

  /// Linear momentum, and angular momentum about the hub centre, of each blade relative to the earth, in R; velocity: of the hub, in R.
  void momentum(const BladeAxes<L>& axes, const Vec3& velocity, Vec3& linear, Vec3& angular) const noexcept;
  /// Kinetic plus elastic energy [J].
  Vec energy(const BladeAxes<L>& axes, const Vec3& velocity) const noexcept;
  /// Power lost in structural damping and hinge dampers [W].
  Vec dissipation() const noexcept;

  /// Position of the reference line's origin relative to the hub centre, in R (root lead).
  double rootLead() const noexcept { return root_lead_; }

 private:
  template <bool equal> void loadImpl(const BladeAxes<L>& axes, const double* loads) noexcept;
  template <int rows> void sumOverSlots(int kind, const Vec* factor) noexcept;
  template <bool equal, bool offset> void loadOnHub() noexcept;
  void findRemainder() noexcept;
  template <bool equal, bool offset> void remainderImpl() noexcept;
  void accelerateImpl(const BladeAxes<L>& axes, const HubAcceleration<L>& hub) noexcept;

  BladeDeformation<L> deformation_;   // level 1
  const BladeCoefficients& c_;        // of it
  double root_lead_;

  // Level 2
  std::vector<double> load_key_;
  bool load_valid_ = false;
  std::uint64_t axes_version_ = 0;
  std::vector<Vec> nodal_load_;
  std::vector<Vec> modal_load_;                 // without the hub's accelerations
  Vec3 air_force_, air_moment_;                 // about the origin of B, in B
  Vec3 hub_force_, hub_moment_;                 // on the blade less the airloads, without the hub's accelerations
  Vec turning_y_, turning_z_;                   // acceleration of B by the turning of its pitch axis
  // Level 3
  std::vector<double> acceleration_key_;
  bool acceleration_valid_ = false, remainder_valid_ = false, d_acceleration_valid_ = false;
  Vec acceleration_[kHubRows];                  // of the hub, in B
  std::vector<Vec> remainder_;                  // (modal) of q'' beside the modal oscillators
  std::vector<Vec> q_acceleration_, d_acceleration_;
  Vec3 root_force_, root_moment_;
};

}  // namespace heerk_rotor
