#include "blade_coefficients.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "heerk_rotor/beam/blade_modes.hpp"

namespace heerk_rotor {
namespace {

/// A matrix over the free degrees of freedom, read by nodal number.
BeamReal entry(const BeamMatrix& A, const std::vector<int>& free_dof, int i, int j) {
  const int row = free_dof[static_cast<std::size_t>(i)], column = free_dof[static_cast<std::size_t>(j)];
  return row < 0 || column < 0 ? 0 : A(row, column);
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
  shape.node = left;
  shape.radius = r;
  shape.built_in_twist = static_cast<double>(bladeSection(properties, r).twist);
  return shape;
}

/// The factor by which all values are multiples of others, or 0. Both are rounded to 80 bits from sums of the same integrals.
double multiple(const std::vector<BeamReal>& values, const std::vector<BeamReal>& of) {
  std::size_t largest = 0;
  BeamReal scale = 0;
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (std::abs(of[i]) > std::abs(of[largest])) largest = i;
    scale = std::max(scale, std::abs(values[i]));
  }
  const BeamReal factor = values[largest] / of[largest];
  for (std::size_t i = 0; i < of.size(); ++i)
    if (std::abs(values[i] - factor * of[i]) > 1e-17L * scale) return 0.0;
  return static_cast<double>(factor);
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
  modes = static_cast<int>(blade_modes[0].size());
  int next = 0;
  for (int kind = 0; kind < kDofKinds; ++kind) {
    kind_begin[kind] = next + kKindSize[kind];
    next = kind_begin[kind] + rows(kind) + kKindSize[kind];
  }
  nodal_size = next + 1;
  const std::vector<int>& free_dof = matrices[0].free_dof;
  first_node = std::all_of(free_dof.begin(), free_dof.begin() + kNodeDofs, [](int row) { return row < 0; }) ? 1 : 0;
  // Number of a nodal displacement in BladeMatrices.
  const auto dofOf = [](int kind, int node, int which) { return kNodeDofs * node + 2 * kind + which; };

  // Modes.
  for (int i = 0; i < modes; ++i) {
    for (int k = 0; k < blades; ++k) {
      omega.push_back(blade_modes[ofBlade(k)].omega[i]);
      damping.push_back(blade_modes[ofBlade(k)].damping[i]);
      state_names.push_back(blade_modes[ofBlade(k)].name[static_cast<std::size_t>(i)] + "_" + std::to_string(k + 1));
    }
  }

  // Rows of V that move in the same modes side by side, and modes that move the same rows.
  struct Row {
    int position, matrix_row;
    std::vector<bool> moves;  // [mode]
  };
  std::vector<Row> shape_rows;
  for (int kind = 0; kind < kDofKinds; ++kind)
    for (int i = 0; i < rows(kind); ++i) {
      Row row{kind_begin[kind] + i, free_dof[static_cast<std::size_t>(dofOf(kind, i / kKindSize[kind], i % kKindSize[kind]))], std::vector<bool>(static_cast<std::size_t>(modes))};
      if (row.matrix_row < 0) continue;
      for (const BladeModes& blade : blade_modes)
        for (int mode = 0; mode < modes; ++mode) if (blade.V(row.matrix_row, mode) != 0) row.moves[static_cast<std::size_t>(mode)] = true;
      shape_rows.push_back(std::move(row));
    }
  std::stable_sort(shape_rows.begin(), shape_rows.end(), [](const Row& a, const Row& b) { return a.moves > b.moves; });
  const auto moved = [&](int mode) {
    std::vector<bool> list;
    for (const Row& row : shape_rows) list.push_back(row.moves[static_cast<std::size_t>(mode)]);
    return list;
  };
  for (int mode = 0; mode < modes; ++mode) mode_order.push_back(mode);
  std::stable_sort(mode_order.begin(), mode_order.end(), [&](int a, int b) { return moved(a) > moved(b); });
  for (int mode : mode_order)
    for (int k = 0; k < copies; ++k) {
      const double w = blade_modes[of(k)].omega[mode];
      stiffness.push_back(w * w);
      mode_damping.push_back(blade_modes[of(k)].damping[mode]);
    }
  const auto tilesOf = [](std::size_t count) { return (static_cast<int>(count) + kTile - 1) / kTile; };
  row_tiles = tilesOf(shape_rows.size());
  mode_tiles = tilesOf(static_cast<std::size_t>(modes));
  const auto rowAt = [&](int i) { return i < static_cast<int>(shape_rows.size()) ? &shape_rows[static_cast<std::size_t>(i)] : nullptr; };
  for (int i = 0; i < row_tiles * kTile; ++i) row_position.push_back(rowAt(i) ? rowAt(i)->position : nodal_size - 1);
  modes_of_rows.assign(static_cast<std::size_t>(row_tiles), {mode_tiles, 0});
  rows_of_modes.assign(static_cast<std::size_t>(mode_tiles), {row_tiles, 0});
  for (int i = 0; i < row_tiles * kTile; i += kTile)
    for (int entry = 0; entry < modalSize(); ++entry)
      for (int r = i; r < i + kTile; ++r) {
        const Row* const row = entry < modes ? rowAt(r) : nullptr;
        const int mode = row ? mode_order[static_cast<std::size_t>(entry)] : 0;
        for (int k = 0; k < copies; ++k) V.push_back(row ? static_cast<double>(blade_modes[of(k)].V(row->matrix_row, mode)) : 0.0);
        if (!row || !row->moves[static_cast<std::size_t>(mode)]) continue;
        const int row_tile = r / kTile, mode_tile = entry / kTile;
        TileRange &of_rows = modes_of_rows[static_cast<std::size_t>(row_tile)], &of_modes = rows_of_modes[static_cast<std::size_t>(mode_tile)];
        of_rows = of_rows.with({mode_tile, mode_tile + 1});
        of_modes = of_modes.with({row_tile, row_tile + 1});
      }

  // Forms.
  const auto form = [&](const BladeMatrices& b, int which) -> const BeamMatrix& {
    const BeamMatrix* list[kForms] = {&b.K1.constant, &b.K1.cos2, &b.K1.sin2, &b.P, &b.T0, &b.G, &b.E_v, &b.E_w};
    return *list[which];
  };
  for (int row = 0; row < kDofKinds; ++row) {
    for (int column = 0; column < kDofKinds; ++column) {
      std::vector<std::vector<BeamReal>> distinct;  // [part with these rows and columns]
      const std::size_t first = parts.size();
      for (int which = 0; which < kForms; ++which) {
        std::vector<BeamReal> values;
        BeamReal largest = 0, scale = 0;
        for (const BladeMatrices& b : matrices) scale = std::max(scale, form(b, which).cwiseAbs().maxCoeff());
        for (int node = 0; node < nodes; ++node)
          for (int neighbour = node - 1; neighbour <= node + 1; ++neighbour)
            for (int c = 0; c < kKindSize[column]; ++c)
              for (int r = 0; r < kKindSize[row]; ++r)
                for (int k = 0; k < copies; ++k) {
                  const bool exists = neighbour >= 0 && neighbour < nodes;
                  values.push_back(exists ? entry(form(matrices[of(k)], which), free_dof, dofOf(row, node, r), dofOf(column, neighbour, c)) : 0);
                  largest = std::max(largest, std::abs(values.back()));
                }
        if (largest <= 1e-17L * scale) continue;  // nothing but round-off
        double factor = 0.0;
        std::size_t part = 0;
        for (; part < distinct.size() && factor == 0.0; ++part) factor = multiple(values, distinct[part]);
        if (factor != 0.0) {
          parts[first + part - 1].factor[which] = factor;
          continue;
        }
        FormPart added{};
        added.row = row;
        added.column = column;
        added.factor[which] = 1.0;
        added.values.assign(values.begin(), values.end());
        parts.push_back(std::move(added));
        distinct.push_back(std::move(values));
      }
    }
  }
  for (int which = 0; which < kLines; ++which)
    for (int kind = 0; kind < kDofKinds; ++kind) {
      LinePart part{kind, which, -1, {}};
      for (int i = 0; i < rows(kind); ++i)
        for (int k = 0; k < copies; ++k) {
          const BladeMatrices& b = matrices[of(k)];
          const BeamVector* list[kLines] = {&b.steady.constant, &b.steady.cos2, &b.steady.sin2, &b.steady_x, &b.inertia_rv, &b.inertia_rw,
                                            &b.inertia_u, &b.inertia_v, &b.inertia_w, &b.inertia_twist};
          part.values.push_back(entry(*list[which], free_dof, dofOf(kind, i / kKindSize[kind], i % kKindSize[kind])));
        }
      if (std::any_of(part.values.begin(), part.values.end(), [](double value) { return value != 0.0; })) lines.push_back(std::move(part));
    }

  // What is needed of each.
  offset = false;
  for (int kind = 0; kind < kDofKinds; ++kind) {
    int& next_slot = slots[kind] = 0;
    for (LinePart& line : lines) if (line.kind == kind && line.line < kLoadLines) line.slot = next_slot++;
    for (FormPart& part : parts) {
      if (part.row != kind) continue;
      const auto in = [&part](BladeForm form) { return part.factor[form] != 0.0; };
      offset = offset || in(kFormOffsetV) || in(kFormOffsetW);
      part.rates = in(kFormShortening) || in(kFormCoriolis) || in(kFormOffsetV) || in(kFormOffsetW);
      part.slot = in(kFormMean) || in(kFormCosine) || in(kFormSine) || in(kFormSpin) || in(kFormOffsetV) ? next_slot++ : -1;
      part.rate_slot = in(kFormCoriolis) ? next_slot++ : -1;
    }
  }

  // Loads of unit hub accelerations on the modes.
  for (int i : mode_order)
    for (int row = 0; row < kHubRows; ++row)
      for (int k = 0; k < copies; ++k) {
        const BladeMatrices& b = matrices[of(k)];
        const BeamVector* list[kHubRows] = {&b.inertia_u, &b.inertia_v, &b.inertia_w, &b.inertia_twist, &b.inertia_rw, &b.inertia_rv};
        const double value = static_cast<double>(blade_modes[of(k)].V.col(i).dot(*list[row]));
        hub_rows.push_back(row == kRowTurnY ? -value : value);
      }
  for (int row = 0; row < kHubRows; ++row)
    for (int other = row; other < kHubRows; ++other)
      for (int k = 0; k < copies; ++k) {
        BeamReal sum = 0;
        for (int i = 0; i < modes; ++i) {
          const auto at = [&](int which) { return hub_rows[static_cast<std::size_t>((i * kHubRows + which) * copies + k)]; };
          sum += static_cast<BeamReal>(at(row)) * at(other);
        }
        hub_row_products.push_back(static_cast<double>(sum));
      }
  twist_stiffness = twist_damping = 0.0;
  for (int entry = 0; entry < modes; ++entry)
    for (int k = 0; k < copies; ++k) {
      const auto at = [&](int row) { return hub_rows[static_cast<std::size_t>((entry * kHubRows + row) * copies + k)]; };
      const double square_of_omega = stiffness[static_cast<std::size_t>(entry * copies + k)];
      const double share = square_of_omega < p.absolute_below * p.absolute_below ? c * at(kRowTurnZ) + s * at(kRowTurnX) : 0.0;
      twist_share.push_back(share);
      const int alike = copies == 1 ? blades : k < blades ? 1 : 0;  // blades that this one stands for
      twist_stiffness += alike * share * share * square_of_omega;
      twist_damping += alike * share * share * mode_damping[static_cast<std::size_t>(entry * copies + k)];
    }
  absolute = std::any_of(twist_share.begin(), twist_share.end(), [](double share) { return share != 0.0; });
  for (int slope : {static_cast<int>(kDofSlopeV), static_cast<int>(kDofSlopeW)})
    for (int k = 0; k < copies; ++k) hinge_damping.push_back(static_cast<double>(entry(matrices[of(k)].C_hinge, free_dof, slope, slope)));

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
