#include "blade_coefficients.hpp"

#include <array>
#include <cmath>

#include "heerk_rotor/beam/blade_modes.hpp"

namespace heerk_rotor {
namespace {

/// A matrix over the free degrees of freedom, read by nodal number.
double entry(const BeamMatrix& A, const std::vector<int>& free_dof, int i, int j) {
  const int row = free_dof[static_cast<std::size_t>(i)], column = free_dof[static_cast<std::size_t>(j)];
  return row < 0 || column < 0 ? 0.0 : static_cast<double>(A(row, column));
}

double entry(const BeamVector& f, const std::vector<int>& free_dof, int i) {
  const int row = free_dof[static_cast<std::size_t>(i)];
  return row < 0 ? 0.0 : static_cast<double>(f[row]);
}

/// The shape functions at r, condensed to what is not zero by construction. Those of held degrees of freedom are left out: they stay zero.
BladeCoefficients::SectionShape sectionShape(const BladeMatrices& blade, const BladeProperties& properties, double r) {
  BladeCoefficients::SectionShape shape{};
  int left = 0;
  while (left + 2 < static_cast<int>(blade.nodes.size()) && blade.nodes[static_cast<std::size_t>(left) + 1] <= r) ++left;
  const BeamMatrix rows = blade.shapeRows(r);
  const auto value = [&](ShapeRow row, int node, NodeDof dof) {
    const int column = blade.free_dof[static_cast<std::size_t>(kNodeDofs * node + dof)];
    return column < 0 ? 0.0 : static_cast<double>(rows(row, column));
  };
  // v and w have the same functions; a hinge may free the slope of one of them only.
  const auto either = [&](ShapeRow row_v, NodeDof dof_v, ShapeRow row_w, NodeDof dof_w, int node) {
    const double of_v = value(row_v, node, dof_v);
    return of_v != 0.0 ? of_v : value(row_w, node, dof_w);
  };
  for (int side = 0; side < 2; ++side) {
    const int node = left + side;
    shape.v[2 * side] = either(kRowV, kDofV, kRowW, kDofW, node);
    shape.v[2 * side + 1] = either(kRowV, kDofSlopeV, kRowW, kDofSlopeW, node);
    shape.slope[2 * side] = either(kRowSlopeV, kDofV, kRowSlopeW, kDofW, node);
    shape.slope[2 * side + 1] = either(kRowSlopeV, kDofSlopeV, kRowSlopeW, kDofSlopeW, node);
    shape.twist[side] = value(kRowTwist, node, kDofTwist);
  }
  shape.element = left;
  shape.radius = r;
  shape.built_in_twist = static_cast<double>(bladeSection(properties, r).twist);
  return shape;
}

}  // namespace

BladeCoefficients::BladeCoefficients(const FeRotorParameters& p, int lanes_)
    : blades(p.sections.blades), lanes(lanes_), copies(p.equalBlades() ? 1 : lanes_), sections(static_cast<int>(p.sections.count())) {
  const double c = std::cos(p.precone), s = std::sin(p.precone), square = p.rotor_speed * p.rotor_speed;
  nominal_mean = square * c * c;
  nominal_spin = square * s * s;
  nominal_lead_v = square * p.blades.front().root_lead;

  // Matrices and modes of each different blade; padding lanes repeat the first.
  std::vector<BladeMatrices> matrices;
  std::vector<BladeModes> blade_modes;
  for (int k = 0; k < (copies == 1 ? 1 : blades); ++k) {
    matrices.push_back(assembleBlade(p.blades[static_cast<std::size_t>(k)]));
    blade_modes.push_back(bladeModes(matrices.back(), matrices.back().stiffness(p.rotor_speed, 0, p.precone), p.modes));
  }
  const auto of = [this](int copy) { return static_cast<std::size_t>(copy < blades ? copy : 0); };
  const auto ofBlade = [this](int blade) { return static_cast<std::size_t>(copies == 1 ? 0 : blade); };

  nodes = static_cast<int>(matrices[0].nodes.size());
  dofs = kNodeDofs * nodes;
  modes = static_cast<int>(blade_modes[0].size());
  dof_blocks = (dofs + kBlock - 1) / kBlock;
  mode_blocks = (modes + kBlock - 1) / kBlock;
  const std::vector<int>& free_dof = matrices[0].free_dof;
  bool offset = false;
  for (const BladeMatrices& blade : matrices) offset = offset || blade.E_v.cwiseAbs().maxCoeff() > 0 || blade.E_w.cwiseAbs().maxCoeff() > 0;
  forms = offset ? kForms : kFormOffsetV;

  // Modes.
  for (int i = 0; i < modes; ++i) {
    for (int k = 0; k < blades; ++k) {
      omega.push_back(blade_modes[ofBlade(k)].omega[i]);
      damping.push_back(blade_modes[ofBlade(k)].damping[i]);
      state_names.push_back(blade_modes[ofBlade(k)].name[static_cast<std::size_t>(i)] + "_" + std::to_string(k + 1));
    }
    for (int k = 0; k < copies; ++k) {
      const double w = blade_modes[of(k)].omega[i];
      stiffness.push_back(w * w);
      mode_damping.push_back(blade_modes[of(k)].damping[i]);
    }
  }
  const auto shape = [&](int copy, int dof, int mode) {
    const int row = dof < dofs ? free_dof[static_cast<std::size_t>(dof)] : -1;
    return row < 0 || mode >= modes ? 0.0 : static_cast<double>(blade_modes[of(copy)].V(row, mode));
  };
  for (int block = 0; block < dof_blocks; ++block)
    for (int i = 0; i < modes; ++i)
      for (int r = 0; r < kBlock; ++r)
        for (int k = 0; k < copies; ++k) to_nodes.push_back(shape(k, block * kBlock + r, i));
  for (int block = 0; block < mode_blocks; ++block)
    for (int dof = 0; dof < dofs; ++dof)
      for (int r = 0; r < kBlock; ++r)
        for (int k = 0; k < copies; ++k) to_modes.push_back(shape(k, dof, block * kBlock + r));

  // Forms.
  const auto form = [&](const BladeMatrices& b, int which) -> const BeamMatrix& {
    const BeamMatrix* list[kForms] = {&b.K1.constant, &b.K1.cos2, &b.K1.sin2, &b.P, &b.T0, &b.G, &b.E_v, &b.E_w};
    return *list[which];
  };
  for (int dof = 0; dof < dofs; ++dof)
    for (int column = 0; column < kBand; ++column)
      for (int which = 0; which < forms; ++which)
        for (int k = 0; k < copies; ++k) {
          const int other = kNodeDofs * (dof / kNodeDofs - 1) + column;
          band.push_back(other < 0 || other >= dofs ? 0.0 : entry(form(matrices[of(k)], which), free_dof, dof, other));
        }
  for (int dof = 0; dof < dofs; ++dof)
    for (int which = 0; which < kLines; ++which)
      for (int k = 0; k < copies; ++k) {
        const BladeMatrices& b = matrices[of(k)];
        const BeamVector* list[kLines] = {&b.steady.constant, &b.steady.cos2, &b.steady.sin2, &b.steady_x, &b.inertia_u, &b.inertia_v, &b.inertia_w,
                                          &b.inertia_rv, &b.inertia_rw, &b.inertia_twist};
        lines.push_back(entry(*list[which], free_dof, dof));
      }

  // Loads of unit hub accelerations on the modes.
  for (int row = 0; row < 6; ++row)
    for (int i = 0; i < modes; ++i)
      for (int k = 0; k < copies; ++k) {
        const BladeMatrices& b = matrices[of(k)];
        const BeamVector* list[6] = {&b.inertia_u, &b.inertia_v, &b.inertia_w, &b.inertia_twist, &b.inertia_rw, &b.inertia_rv};
        const double value = static_cast<double>(blade_modes[of(k)].V.col(i).dot(*list[row]));
        hub_rows.push_back(row == 4 ? -value : value);
      }
  for (int slope : {static_cast<int>(kDofSlopeV), static_cast<int>(kDofSlopeW)})
    for (int k = 0; k < copies; ++k) hinge_damping.push_back(entry(matrices[of(k)].C_hinge, free_dof, slope, slope));

  // The undeformed blade.
  std::vector<std::array<double, 10>> undeformed;
  for (const BladeMatrices& b : matrices)
    undeformed.push_back({b.mass, b.first_moment[0], b.first_moment[1], b.first_moment[2], b.inertia(0, 0), b.inertia(1, 1), b.inertia(2, 2),
                          b.inertia(0, 1), b.inertia(0, 2), b.inertia(1, 2)});
  for (std::size_t i = 0; i < 10; ++i)
    for (int k = 0; k < copies; ++k) rigid.push_back(undeformed[of(k)][i]);

  for (double r : p.sections.r) shapes.push_back(sectionShape(matrices[0], p.blades[0], r));
  shapes.push_back(sectionShape(matrices[0], p.blades[0], p.sections.radius));
}

}  // namespace heerk_rotor
