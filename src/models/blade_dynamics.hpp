#pragma once
#include <cstdint>
#include <vector>

#include "blade_coefficients.hpp"
#include "heerk_rotor/beam/beam_types.hpp"
#include "lane_vector.hpp"

namespace heerk_rotor {

/// How the axes of the blades move: rotating blade axes R (x outboard, y toward the leading edge, z along the shaft) and the blades' own
/// pitched axes B (R turned up by the precone, then nose up by the pitch), per blade.
template <int L>
struct BladeAxes {
  LaneVector<L> sine, cosine;             // of the azimuth of each blade
  LaneVector<L> pitch_sine, pitch_cosine;
  Lanes3<L> omega;                        // angular velocity of R, in R [rad/s]
  LaneVector<L> pitch_rate;               // [rad/s]
  LaneVector<L> speed;                    // of the rotor relative to the mount [rad/s]
  LaneVector<L> precone_sine, precone_cosine;

  Lanes3<L> toBlade(const Lanes3<L>& v_R) const noexcept;     // R to B
  Lanes3<L> fromBlade(const Lanes3<L>& v_B) const noexcept;   // B to R
  Lanes3<L> fromHub(const double* v_H) const noexcept;        // hub_link to R
  Lanes3<L> toHub(const Lanes3<L>& v_R) const noexcept;
  Lanes3<L> omegaOfBlade() const noexcept;                    // angular velocity of B, in B
};

/// What the hub does to the blades at one instant, apart from the axes' own rates: in R.
template <int L>
struct HubAcceleration {
  Lanes3<L> linear;             // specific force: acceleration minus gravity, of the origin [m/s^2]
  Lanes3<L> angular;            // of R [rad/s^2]
  LaneVector<L> pitch;          // [rad/s^2]
};

/// Displacements at one radius.
template <int L>
struct SectionMotion {
  LaneVector<L> v, w, twist, slope_v, slope_w;  // in B
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
/// momentum and energy balance exactly, whatever the hub does. Frame of all: B. State: modal q, then q', [mode][blade].
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
  using Pair = LaneVector<2 * L>;  // two quantities of all blades; mostly a displacement and its rate

  explicit BladeDynamics(const FeRotorParameters& parameters);

  const BladeCoefficients& coefficients() const { return c_; }

  /// Level 1. x: state.
  void deform(const double* x) noexcept;
  /// Displacements, and their rates, at section j (sections: tip).
  SectionMotion<L> displacement(int j) const noexcept {
    const Pair* const at = section_.data() + kShapeRows * j;
    return {firstOf<L>(at[kRowV]), firstOf<L>(at[kRowW]), firstOf<L>(at[kRowTwist]), firstOf<L>(at[kRowSlopeV]), firstOf<L>(at[kRowSlopeW])};
  }
  SectionMotion<L> displacementRate(int j) const noexcept {
    const Pair* const at = section_.data() + kShapeRows * j;
    return {secondOf<L>(at[kRowV]), secondOf<L>(at[kRowW]), secondOf<L>(at[kRowTwist]), secondOf<L>(at[kRowSlopeV]), secondOf<L>(at[kRowSlopeW])};
  }

  /// Level 2. loads: [section][fx fy fz in R, pitching moment][blade]. version: differs whenever the axes do, and stands for them when
  /// arguments are compared.
  void load(const BladeAxes<L>& axes, std::uint64_t version, const double* loads) noexcept;

  /// Level 3. Root lead, precone and pitch rate are accounted for here.
  void accelerate(const BladeAxes<L>& axes, const HubAcceleration<L>& hub) noexcept;
  /// q'' - S x: what remains beside the modal oscillators, [mode].
  const Vec* remainder() noexcept;
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
  template <bool equal> static Vec at(const std::vector<double>& values, std::size_t index) noexcept;
  Vec read(const std::vector<double>& values, std::size_t index) const noexcept { return c_.copies == 1 ? at<true>(values, index) : at<false>(values, index); }
  template <bool equal, bool offset> void deformImpl() noexcept;
  template <bool equal> void applyForms() noexcept;
  template <bool equal> void applyLines() noexcept;
  template <bool equal, int rows, int columns, bool rates> void applyPart(const BladeCoefficients::FormPart& part) noexcept;
  template <bool equal, bool offset> void findRowProducts() noexcept;
  template <bool equal, bool offset> Vec hubRow(int row, std::size_t mode) const noexcept;
  template <bool equal> void loadImpl(const BladeAxes<L>& axes, const double* loads) noexcept;
  template <int rows> void sumOverSlots(int kind, const Vec* factor) noexcept;
  template <bool equal, bool offset> void loadOnHub() noexcept;
  template <bool equal, bool offset> void remainderImpl() noexcept;
  void accelerateImpl(const BladeAxes<L>& axes, const HubAcceleration<L>& hub) noexcept;
  /// S, S', J, J', h of the deformed blade about the origin of B.
  struct Inertia {
    Vec xx, yy, zz, xy, xz, yz;
    Vec3 operator*(const Vec3& w) const noexcept { return {xx * w.x + xy * w.y + xz * w.z, xy * w.x + yy * w.y + yz * w.z, xz * w.x + yz * w.y + zz * w.z}; }
  };
  struct MassMoments {
    Vec3 first, first_rate, deformation_momentum;
    Inertia second, second_rate;
  };
  void findMassMoments() noexcept;
  Vec rigid(int i) const noexcept { return read(c_.rigid, static_cast<std::size_t>(i)); }
  std::size_t root(NodeDof dof) const noexcept { return static_cast<std::size_t>(c_.kind_begin[dof / 2] + dof % 2); }

  BladeCoefficients c_;
  double root_lead_;

  // Level 1
  std::vector<double> state_key_;
  bool state_valid_ = false;
  std::vector<Pair> q_;                         // (modal) q, q'
  std::vector<Pair> d_;                         // (nodal) d, d'
  std::vector<Pair> section_;                   // [section][ShapeRow]
  std::vector<Vec> slot_[kDofKinds];            // [node][slot][row of the node] what makes up the nodal loads
  Vec line_[kLines], line_rate_[kLines];        // linear forms of d and d'
  Vec form_[kForms], form_rate_[kForms];        // d.A d and d'.A d
  Vec rate_shortening_, rate_offset_v_, rate_offset_w_, spin_momentum_;  // d'.T0 d', d'.E d', -d.G d'
  MassMoments moments_;
  std::vector<Pair> nodal_x_, nodal_y_;         // (nodal) -T0 d, G d;  -E_v d, -E_w d
  std::vector<Pair> row_constant_x_, row_constant_y_, row_x_, row_y_;  // (modal) hub rows x, turn x;  y, z
  Vec row_products_[kHubPairs];                 // rows'rows
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
  std::vector<Vec> remainder_, q_acceleration_, d_acceleration_;
  Vec3 root_force_, root_moment_;
};

}  // namespace heerk_rotor
