#include "heerk_rotor/beam/blade_elements.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "element_shapes.hpp"
#include "heerk_rotor/beam/gauss_rule.hpp"

namespace heerk_rotor {
namespace {

/// Degree of the highest polynomial, tension (3) times v'^2 (4) is 7: 4 points; the rest serves sines and cosines of the twist.
constexpr int kGaussPoints = 7;

/// The integrals of one element (or of one point mass).
struct ElementIntegrals {
  ElementMatrix M, K0, P, G, T0, E_v, E_w;
  PitchHarmonics<ElementMatrix> K1;
  PitchHarmonics<ElementVector> steady;
  ElementVector inertia_v, inertia_w, inertia_rv, inertia_rw, inertia_twist, inertia_u, steady_x;

  ElementIntegrals() {
    for (ElementMatrix* A : {&M, &K0, &P, &G, &T0, &E_v, &E_w, &K1.constant, &K1.cos1, &K1.sin1, &K1.cos2, &K1.sin2}) A->setZero();
    for (ElementVector* f : {&steady.constant, &steady.cos1, &steady.sin1, &steady.cos2, &steady.sin2, &inertia_v, &inertia_w,
                             &inertia_rv, &inertia_rw, &inertia_twist, &inertia_u, &steady_x})
      f->setZero();
  }
};

/// A += a (row . q)^2 as a matrix of q.
void addSquare(ElementMatrix& A, BeamReal a, const ElementVector& row) { A += a * (row * row.transpose()); }

/// A += 2 a (first . q)(second . q) as a symmetric matrix of q.
void addTwice(ElementMatrix& A, BeamReal a, const ElementVector& first, const ElementVector& second) {
  const ElementMatrix product = first * second.transpose();
  A += a * (product + product.transpose());
}

/// Adds what the mass `dm` [kg] at radius x contributes. b = beta + theta turns with the pitch; its sines and cosines are expanded.
void addMass(ElementIntegrals& sum, BeamReal dm, BeamReal x, const BladeSection& section, BeamReal e0, const ElementShapes& n) {
  const BeamReal c = std::cos(section.twist), s = std::sin(section.twist);
  const BeamReal c2 = c * c - s * s, s2 = 2 * s * c;
  const BeamReal e = section.e;
  const BeamReal km1_2 = section.km1 * section.km1, km2_2 = section.km2 * section.km2;
  const ElementVector v_mass = n.v - e * s * n.twist;  // displacement of the mass centre
  const ElementVector w_mass = n.w + e * c * n.twist;

  // Kinetic energy.
  addSquare(sum.M, dm, v_mass);
  addSquare(sum.M, dm, w_mass);
  addSquare(sum.M, dm * (km1_2 + km2_2 - e * e), n.twist);
  const ElementMatrix turn = w_mass * v_mass.transpose();
  sum.G += dm * (turn - turn.transpose());

  // Rotation about z_H: in-plane distance Y = (v cos(theta) - w sin(theta)) + chordwise offset cos(b) - f sin(b); -m Y^2.
  addSquare(sum.K1.constant, -dm / 2, n.v);
  addSquare(sum.K1.cos2, -dm / 2, n.v);
  addTwice(sum.K1.sin2, dm / 2, n.v, n.w);
  addSquare(sum.K1.constant, -dm / 2, n.w);
  addSquare(sum.K1.cos2, dm / 2, n.w);
  // 2 m e f sin(b) (v cos(theta) - w sin(theta))
  addTwice(sum.K1.constant, dm * e / 2, n.twist, s * n.v - c * n.w);
  addTwice(sum.K1.cos2, dm * e / 2, n.twist, s * n.v + c * n.w);
  addTwice(sum.K1.sin2, dm * e / 2, n.twist, c * n.v - s * n.w);
  // [m (km2^2 - km1^2) cos(2 b) + m e e0 cos(b)] f^2
  addSquare(sum.K1.cos2, dm * (km2_2 - km1_2) * c2, n.twist);
  addSquare(sum.K1.sin2, -dm * (km2_2 - km1_2) * s2, n.twist);
  addSquare(sum.K1.cos1, dm * e * e0 * c, n.twist);
  addSquare(sum.K1.sin1, -dm * e * e0 * s, n.twist);
  // 2 m x e f (c w' - s v'): the radial force on the mass centre, which the pitch does not turn
  addTwice(sum.K1.constant, dm * x * e, n.twist, c * n.slope_w - s * n.slope_v);

  // Second-order displacements of the mass centre: x by turning its offset with the slopes, y and z by turning it with the twist.
  addTwice(sum.T0, dm * e, n.twist, c * n.slope_w - s * n.slope_v);
  addSquare(sum.E_v, dm * e * c, n.twist);
  addSquare(sum.E_w, dm * e * s, n.twist);
  sum.inertia_u -= dm * e * (s * n.slope_w + c * n.slope_v);

  // Rotation about x: -m (y^2 + z^2), whose only products with f are those of the mass centre's offset.
  addSquare(sum.P, dm, n.v);
  addSquare(sum.P, dm, n.w);
  addTwice(sum.P, dm * e, n.twist, c * n.w - s * n.v);

  // Steady loads: m (e0 + e cos(b)) toward (v cos(theta) - w sin(theta)), the radial force at the offset, the propeller moment.
  sum.steady.cos1 += dm * e0 * n.v;
  sum.steady.sin1 -= dm * e0 * n.w;
  sum.steady.constant += dm * e / 2 * (c * n.v + s * n.w);
  sum.steady.cos2 += dm * e / 2 * (c * n.v - s * n.w);
  sum.steady.sin2 -= dm * e / 2 * (s * n.v + c * n.w);
  sum.steady.constant -= dm * x * e * (s * n.slope_w + c * n.slope_v);
  sum.steady.cos2 -= dm * (km2_2 - km1_2) / 2 * s2 * n.twist;
  sum.steady.sin2 -= dm * (km2_2 - km1_2) / 2 * c2 * n.twist;
  sum.steady_x += dm * e * (c * n.v + s * n.w);
  sum.steady.cos1 -= dm * e * e0 * s * n.twist;
  sum.steady.sin1 -= dm * e * e0 * c * n.twist;

  // Unit accelerations.
  sum.inertia_v += dm * v_mass;
  sum.inertia_w += dm * w_mass;
  sum.inertia_rv += dm * x * v_mass;
  sum.inertia_rw += dm * x * w_mass;
  sum.inertia_twist += dm * ((km1_2 + km2_2) * n.twist + e * (c * n.w - s * n.v));
}

/// Adds elastic energy, the work of the tension t [kg m] over the length dx [m], and with the mass t0 [kg] outboard of it the
/// foreshortening that this tension works on.
void addElastic(ElementIntegrals& sum, BeamReal dx, BeamReal t, BeamReal t0, const BladeSection& section, const ElementShapes& n) {
  const BeamReal c = std::cos(section.twist), s = std::sin(section.twist);
  const BeamReal EI1 = section.EI_flap, EI2 = section.EI_lag, rate = section.twist_rate;
  addSquare(sum.K0, dx * (EI1 * c * c + EI2 * s * s), n.curvature_w);
  addSquare(sum.K0, dx * (EI1 * s * s + EI2 * c * c), n.curvature_v);
  addTwice(sum.K0, dx * (EI2 - EI1) * s * c, n.curvature_v, n.curvature_w);
  addSquare(sum.K0, dx * (section.GJ + section.EB1 * rate * rate), n.twist_rate);
  addTwice(sum.K0, -dx * section.EB2 * rate, n.twist_rate, c * n.curvature_v + s * n.curvature_w);

  const BeamReal kA_2 = section.kA * section.kA;
  const auto addTension = [&](ElementMatrix& quadratic, ElementVector& linear, BeamReal tension) {
    addSquare(quadratic, dx * tension, n.slope_v);
    addSquare(quadratic, dx * tension, n.slope_w);
    addSquare(quadratic, dx * tension * kA_2, n.twist_rate);
    addTwice(quadratic, dx * tension * section.eA, n.twist, s * n.curvature_v - c * n.curvature_w);
    linear += dx * tension * (section.eA * (s * n.curvature_w + c * n.curvature_v) - kA_2 * rate * n.twist_rate);
  };
  addTension(sum.K1.constant, sum.steady.constant, t);
  addTension(sum.T0, sum.inertia_u, t0);
}

/// Adds the mass `dm` at x to the inertia of the undeformed blade.
void addRigid(BladeMatrices& blade, BeamReal dm, BeamReal x, const BladeSection& section) {
  const double m = static_cast<double>(dm), r = static_cast<double>(x);
  const double c = static_cast<double>(std::cos(section.twist)), s = static_cast<double>(std::sin(section.twist));
  const double e = static_cast<double>(section.e), flapwise = static_cast<double>(section.km1 * section.km1), chordwise = static_cast<double>(section.km2 * section.km2);
  const double y2 = chordwise * c * c + flapwise * s * s, z2 = chordwise * s * s + flapwise * c * c, yz = (chordwise - flapwise) * s * c;
  blade.mass += m;
  blade.first_moment += m * Eigen::Vector3d(r, e * c, e * s);
  Eigen::Matrix3d J;
  J << y2 + z2, -r * e * c, -r * e * s,
       -r * e * c, r * r + z2, -yz,
       -r * e * s, -yz, r * r + y2;
  blade.inertia += m * J;
}

/// Places element integrals into the blade's matrices.
class Assembly {
 public:
  explicit Assembly(BladeMatrices& blade) : blade_(blade) {
    const Eigen::Index n = std::count_if(blade.free_dof.begin(), blade.free_dof.end(), [](int row) { return row >= 0; });
    for (BeamMatrix* A : {&blade.M, &blade.K0, &blade.P, &blade.G, &blade.T0, &blade.E_v, &blade.E_w, &blade.C_hinge, &blade.K1.constant, &blade.K1.cos1, &blade.K1.sin1,
                          &blade.K1.cos2, &blade.K1.sin2})
      A->setZero(n, n);
    for (BeamVector* f : {&blade.steady.constant, &blade.steady.cos1, &blade.steady.sin1, &blade.steady.cos2, &blade.steady.sin2,
                          &blade.inertia_v, &blade.inertia_w, &blade.inertia_rv, &blade.inertia_rw, &blade.inertia_twist,
                          &blade.inertia_u, &blade.steady_x})
      f->setZero(n);
  }

  void add(int element, const ElementIntegrals& sum) {
    for (int i = 0; i < kElementDofs; ++i) {
      const int row = blade_.free_dof[kNodeDofs * element + i];
      if (row < 0) continue;
      addVectors(row, i, sum);
      for (int j = 0; j < kElementDofs; ++j) {
        const int column = blade_.free_dof[kNodeDofs * element + j];
        if (column >= 0) addMatrices(row, column, i, j, sum);
      }
    }
  }

  /// a (r_i r_j) and a (r_j r_i) may differ in the last bit.
  void symmetrise() {
    for (BeamMatrix* A :
         {&blade_.M, &blade_.K0, &blade_.P, &blade_.T0, &blade_.E_v, &blade_.E_w, &blade_.K1.constant, &blade_.K1.cos1, &blade_.K1.sin1, &blade_.K1.cos2, &blade_.K1.sin2})
      *A = (BeamReal(0.5) * (*A + A->transpose())).eval();
  }

 private:
  void addVectors(int row, int i, const ElementIntegrals& sum) {
    blade_.steady.constant[row] += sum.steady.constant[i];
    blade_.steady.cos1[row] += sum.steady.cos1[i];
    blade_.steady.sin1[row] += sum.steady.sin1[i];
    blade_.steady.cos2[row] += sum.steady.cos2[i];
    blade_.steady.sin2[row] += sum.steady.sin2[i];
    blade_.inertia_v[row] += sum.inertia_v[i];
    blade_.inertia_w[row] += sum.inertia_w[i];
    blade_.inertia_rv[row] += sum.inertia_rv[i];
    blade_.inertia_rw[row] += sum.inertia_rw[i];
    blade_.inertia_twist[row] += sum.inertia_twist[i];
    blade_.inertia_u[row] += sum.inertia_u[i];
    blade_.steady_x[row] += sum.steady_x[i];
  }

  void addMatrices(int row, int column, int i, int j, const ElementIntegrals& sum) {
    blade_.M(row, column) += sum.M(i, j);
    blade_.K0(row, column) += sum.K0(i, j);
    blade_.P(row, column) += sum.P(i, j);
    blade_.G(row, column) += sum.G(i, j);
    blade_.T0(row, column) += sum.T0(i, j);
    blade_.E_v(row, column) += sum.E_v(i, j);
    blade_.E_w(row, column) += sum.E_w(i, j);
    blade_.K1.constant(row, column) += sum.K1.constant(i, j);
    blade_.K1.cos1(row, column) += sum.K1.cos1(i, j);
    blade_.K1.sin1(row, column) += sum.K1.sin1(i, j);
    blade_.K1.cos2(row, column) += sum.K1.cos2(i, j);
    blade_.K1.sin2(row, column) += sum.K1.sin2(i, j);
  }

  BladeMatrices& blade_;
};

std::vector<int> numberFreeDofs(const BladeProperties& p) {
  std::vector<int> free_dof(kNodeDofs * p.nodes.size());
  int next = 0;
  for (std::size_t dof = 0; dof < free_dof.size(); ++dof) {
    const bool free = dof >= kNodeDofs || (dof == kDofSlopeV && p.root.lag_hinge) || (dof == kDofSlopeW && p.root.flap_hinge);
    free_dof[dof] = free ? next++ : -1;
  }
  return free_dof;
}

void addHinges(BladeMatrices& blade, const BladeRoot& root) {
  const auto add = [&](int row, double spring, double damper) {
    if (row < 0) return;
    blade.K0(row, row) += spring;
    blade.C_hinge(row, row) += damper;
  };
  add(blade.free_dof[kDofSlopeW], root.flap_spring, root.flap_damper);
  add(blade.free_dof[kDofSlopeV], root.lag_spring, root.lag_damper);
}

}  // namespace

BladeMatrices assembleBlade(const BladeProperties& p) {
  const std::vector<std::string> problems = bladeProblems(p);
  if (!problems.empty()) {
    std::string text = "assembleBlade: " + std::to_string(problems.size()) + " problem(s):";
    for (const std::string& problem : problems) text += "\n  " + problem;
    throw std::invalid_argument(text);
  }

  BladeMatrices blade;
  blade.nodes = p.nodes;
  blade.free_dof = numberFreeDofs(p);
  blade.alpha = p.damping_mass;
  blade.beta = p.damping_stiffness;
  Assembly assembly(blade);

  // Integrate between breaks, so that no property has a kink inside a quadrature interval.
  const GaussRule gauss(kGaussPoints);
  const BladeTension tension(p);
  const std::vector<double> breaks = bladeBreaks(p);
  std::size_t next = 0;
  const int elements = static_cast<int>(p.nodes.size()) - 1;
  for (int element = 0; element < elements; ++element) {
    const BeamReal left = p.nodes[element];
    const BeamReal length = p.nodes[element + 1] - left;
    ElementIntegrals sum;
    for (; breaks[next] < p.nodes[element + 1]; ++next) {
      const BeamReal a = breaks[next];
      const BeamReal width = breaks[next + 1] - a;
      for (int k = 0; k < kGaussPoints; ++k) {
        const BeamReal x = a + gauss.node[k] * width;
        const BeamReal dx = gauss.weight[k] * width;
        const BladeSection section = bladeSection(p, x);
        const ElementShapes shapes((x - left) / length, length);
        addMass(sum, section.mass * dx, x, section, p.root_lead, shapes);
        addElastic(sum, dx, tension(x), tension.massOutboard(x), section, shapes);
        addRigid(blade, section.mass * dx, x, section);
      }
    }
    if (element == elements - 1 && p.tip_mass > 0) {
      BladeSection point = bladeSection(p, p.nodes.back());
      point.e = point.km1 = point.km2 = 0;  // on the elastic axis, without extension
      addRigid(blade, p.tip_mass, p.nodes.back(), point);
      addMass(sum, p.tip_mass, p.nodes.back(), point, p.root_lead, ElementShapes(1, length));
    }
    assembly.add(element, sum);
  }
  assembly.symmetrise();
  addHinges(blade, p.root);
  return blade;
}

BeamMatrix BladeMatrices::stiffness(BeamReal omega, BeamReal theta, BeamReal precone) const {
  const BeamReal c = std::cos(precone), s = std::sin(precone);
  return K0 + omega * omega * (c * c * K1.evenPart(theta) + K1.oddPart(theta) - s * s * P);
}

BeamMatrix BladeMatrices::damping(const BeamMatrix& K) const { return alpha * M + beta * K + C_hinge; }

BeamVector BladeMatrices::steadyLoad(BeamReal omega, BeamReal theta, BeamReal precone) const {
  const BeamReal c = std::cos(precone), s = std::sin(precone);
  const BeamVector coning = std::sin(theta) * inertia_rv + std::cos(theta) * inertia_rw;
  return omega * omega * (c * c * steady.evenPart(theta) + steady.oddPart(theta) + s * s * steady_x - s * c * coning);
}

BeamMatrix BladeMatrices::shapeRows(double r) const {
  if (!(r >= nodes.front() && r <= nodes.back()))
    throw std::invalid_argument("BladeMatrices::shapeRows: r = " + std::to_string(r) + " m, expected " + std::to_string(nodes.front()) +
                                " m (root) .. " + std::to_string(nodes.back()) + " m (tip)");
  const std::size_t right = std::upper_bound(nodes.begin(), nodes.end() - 1, r) - nodes.begin();
  const BeamReal left = nodes[right - 1];
  const BeamReal length = nodes[right] - left;
  const ElementShapes shapes((r - left) / length, length);

  BeamMatrix rows = BeamMatrix::Zero(kShapeRows, size());
  for (int i = 0; i < kElementDofs; ++i) {
    const int column = free_dof[kNodeDofs * (right - 1) + i];
    if (column < 0) continue;
    rows(kRowV, column) = shapes.v[i];
    rows(kRowW, column) = shapes.w[i];
    rows(kRowTwist, column) = shapes.twist[i];
    rows(kRowSlopeV, column) = shapes.slope_v[i];
    rows(kRowSlopeW, column) = shapes.slope_w[i];
  }
  return rows;
}

}  // namespace heerk_rotor
