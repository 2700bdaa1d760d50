#include "heerk_rotor/shaft/shaft_matrices.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "heerk_rotor/shaft/shaft_element.hpp"

namespace heerk_rotor {
namespace {

/// Where the dofs of one plane of an element stand, and the sign with which its slope is a tilt.
struct Plane {
  std::array<Eigen::Index, 4> row;
  std::array<ShaftReal, 4> sign;
};

Plane planeX(int left) {
  return {{shaftRow(left, kShaftX), shaftRow(left, kShaftTiltY), shaftRow(left + 1, kShaftX), shaftRow(left + 1, kShaftTiltY)}, {1, 1, 1, 1}};
}
Plane planeY(int left) {
  return {{shaftRow(left, kShaftY), shaftRow(left, kShaftTiltX), shaftRow(left + 1, kShaftY), shaftRow(left + 1, kShaftTiltX)}, {1, -1, 1, -1}};
}

void add(ShaftMatrix& A, const Plane& rows, const Plane& columns, const ElementPlane& part) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) A(rows.row[i], columns.row[j]) += rows.sign[i] * columns.sign[j] * part(i, j);
}

void addSegments(ShaftMatrices& shaft, const ShaftProperties& p) {
  for (int i = 0; i + 1 < p.nodes(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const ShaftElement::Section section{p.diameter[p.diameter.size() == 1 ? 0 : k], p.inner_diameter[p.inner_diameter.size() == 1 ? 0 : k],
                                        p.youngs_modulus, p.density, p.poisson_ratio, p.shear};
    const ShaftElement element(section, p.segments[k]);
    const Plane x = planeX(i), y = planeY(i);
    for (const Plane& plane : {x, y}) {
      add(shaft.M, plane, plane, element.mass + element.rotary);
      add(shaft.K, plane, plane, element.stiffness);
    }
    // A section of polar inertia 2 rho I per length: H_x = J_p omega tilt_y, H_y = -J_p omega tilt_x.
    add(shaft.G, x, y, -2 * element.rotary);
    add(shaft.G, y, x, 2 * element.rotary);
  }
}

void addDisc(ShaftMatrices& shaft, const ShaftDisc& disc) {
  const Eigen::Index x = shaftRow(disc.node, kShaftX), y = shaftRow(disc.node, kShaftY);
  const Eigen::Index tilt_x = shaftRow(disc.node, kShaftTiltX), tilt_y = shaftRow(disc.node, kShaftTiltY);
  for (const Eigen::Index row : {x, y}) shaft.M(row, row) += disc.mass;
  for (const Eigen::Index row : {tilt_x, tilt_y}) shaft.M(row, row) += disc.diametral_inertia;
  shaft.G(tilt_x, tilt_y) -= disc.polar_inertia;
  shaft.G(tilt_y, tilt_x) += disc.polar_inertia;

  const ShaftReal along = disc.unbalance * std::cos(static_cast<ShaftReal>(disc.unbalance_angle));
  const ShaftReal ahead = disc.unbalance * std::sin(static_cast<ShaftReal>(disc.unbalance_angle));
  shaft.unbalance(x, 0) += along;
  shaft.unbalance(y, 0) += ahead;
  shaft.unbalance(x, 1) -= ahead;
  shaft.unbalance(y, 1) += along;
}

void addBearing(ShaftMatrices& shaft, const ShaftBearing& bearing) {
  const Eigen::Index x = shaftRow(bearing.node, kShaftX), y = shaftRow(bearing.node, kShaftY);
  shaft.K(x, x) += bearing.stiffness_x;
  shaft.K(y, y) += bearing.stiffness_y;
  shaft.C(x, x) += bearing.damping_x;
  shaft.C(y, y) += bearing.damping_y;
}

}  // namespace

ShaftMatrices assembleShaft(const ShaftProperties& p) {
  const std::vector<std::string> problems = shaftProblems(p);
  if (!problems.empty()) {
    std::string text = "assembleShaft: " + std::to_string(problems.size()) + " problem(s):";
    for (const std::string& problem : problems) text += "\n  " + problem;
    throw std::invalid_argument(text);
  }
  ShaftMatrices shaft;
  const Eigen::Index n = static_cast<Eigen::Index>(kShaftNodeDofs) * p.nodes();
  for (ShaftMatrix* A : {&shaft.M, &shaft.G, &shaft.K}) A->setZero(n, n);
  shaft.unbalance.setZero(n, 2);
  addSegments(shaft, p);
  shaft.C = p.stiffness_damping * shaft.K;  // before the bearings' stiffness comes in: they have their own dampers
  for (const ShaftDisc& disc : p.discs) addDisc(shaft, disc);
  for (const ShaftBearing& bearing : p.bearings) addBearing(shaft, bearing);
  shaft.C += p.mass_damping * shaft.M;
  return shaft;
}

}  // namespace heerk_rotor
