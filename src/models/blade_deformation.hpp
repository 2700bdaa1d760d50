#pragma once
#include <vector>

#include "blade_arrays.hpp"
#include "heerk_rotor/beam/beam_types.hpp"

namespace heerk_rotor {

/// What follows from the state of all blades alone, blades in lanes: displacements at the sections, mass moments, the parts of the nodal loads, and how
/// accelerations of the hub load the modes. See BladeDynamics for the equations; frame of all: B. Made anew only when the state differs bitwise from
/// last time (a pure function with a memory of its last value).
template <int L>
class BladeDeformation {
 public:
  using Vec = LaneVector<L>;
  using Vec3 = Lanes3<L>;
  using Pair = LaneVector<2 * L>;  // two quantities of all blades; mostly a displacement and its rate

  explicit BladeDeformation(const FeRotorParameters& parameters);

  const BladeCoefficients& coefficients() const { return c_; }

  /// x: modal q, then q', [mode][blade], p and p' for modes that count from the drive; twist: of the mast, and its rate; same_x: x is known to be that of the
  /// last call. Returns whether anything changed.
  bool deform(const double* x, const double (&twist)[2], bool same_x) noexcept;

  /// Displacements, and their rates, at section j (sections: tip).
  SectionMotion<L> displacement(int j) const noexcept {
    const Pair* const at = section_.data() + kShapeRows * j;
    return {firstOf<L>(at[kRowV]), firstOf<L>(at[kRowW]), firstOf<L>(at[kRowTwist]), firstOf<L>(at[kRowSlopeV]), firstOf<L>(at[kRowSlopeW])};
  }
  SectionMotion<L> displacementRate(int j) const noexcept {
    const Pair* const at = section_.data() + kShapeRows * j;
    return {secondOf<L>(at[kRowV]), secondOf<L>(at[kRowW]), secondOf<L>(at[kRowTwist]), secondOf<L>(at[kRowSlopeV]), secondOf<L>(at[kRowSlopeW])};
  }
  /// Rate of a degree of freedom of the root node.
  Vec rootRate(NodeDof dof) const noexcept { return secondOf<L>(d_[static_cast<std::size_t>(c_.kind_begin[dof / 2] + dof % 2)]); }
  /// Modal coordinate and its rate, by modal entry.
  Pair modal(std::size_t m) const noexcept { return q_[m]; }

  /// S, S', J, J', h of the deformed blade about the origin of B.
  struct Inertia {
    Vec xx, yy, zz, xy, xz, yz;
    Vec3 operator*(const Vec3& w) const noexcept { return {xx * w.x + xy * w.y + xz * w.z, xy * w.x + yy * w.y + yz * w.z, xz * w.x + yz * w.y + zz * w.z}; }
  };
  struct MassMoments {
    Vec3 first, first_rate, deformation_momentum;
    Inertia second, second_rate;
  };
  const MassMoments& moments() const noexcept { return moments_; }
  /// What S'' contains beside the modes' own accelerations: by foreshortening and turning mass centres.
  Vec3 firstByRates() const noexcept { return {-rate_shortening_, -rate_offset_v_, -rate_offset_w_}; }
  /// d.A d of a form.
  Vec form(BladeForm form) const noexcept { return form_[form]; }
  Vec rigid(int i) const noexcept { return entry<L>(c_, c_.rigid, static_cast<std::size_t>(i)); }

  /// [node][slot][row of the node]: what makes up the nodal loads of one kind (BladeCoefficients).
  const Vec* slots(int kind) const noexcept { return slot_[kind].data(); }

  /// Load on a modal entry by a unit acceleration of the hub, and the sum over the modes of the products of two of them.
  template <bool equal, bool offset>
  Vec hubRow(int row, std::size_t m) const noexcept {
    if (row == kRowX) return firstOf<L>(row_x_[m]);
    if (row == kRowTurnX) return secondOf<L>(row_x_[m]);
    if (offset && row == kRowY) return firstOf<L>(row_y_[m]);
    if (offset && row == kRowZ) return secondOf<L>(row_y_[m]);
    return entry<equal, L>(c_.hub_rows, m * kHubRows + static_cast<std::size_t>(row));
  }
  Vec hubRowProduct(int i, int j) const noexcept { return row_products_[i < j ? hubPair(i, j) : hubPair(j, i)]; }

 private:
  template <bool equal, bool offset> void deformImpl() noexcept;
  template <bool equal> void applyForms() noexcept;
  template <bool equal> void applyLines() noexcept;
  template <bool equal, int rows, int columns, bool rates> void applyPart(const BladeCoefficients::FormPart& part) noexcept;
  template <bool equal, bool offset> void findRowProducts() noexcept;
  void findMassMoments() noexcept;

  BladeCoefficients c_;
  std::vector<double> state_key_;
  double twist_key_[2] = {};
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
};

}  // namespace heerk_rotor
