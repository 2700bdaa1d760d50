#include "element_shapes.hpp"

namespace heerk_rotor {

ElementShapes::ElementShapes(BeamReal s, BeamReal l) {
  for (ElementVector* rows : {&v, &slope_v, &curvature_v, &w, &slope_w, &curvature_w, &twist, &twist_rate}) rows->setZero();

  // Cubic Hermite polynomials: displacement left, slope left, displacement right, slope right.
  const BeamReal value[4] = {1 + s * s * (2 * s - 3), l * s * (1 - s) * (1 - s), s * s * (3 - 2 * s), l * s * s * (s - 1)};
  const BeamReal first[4] = {6 * s * (s - 1) / l, (1 - s) * (1 - 3 * s), 6 * s * (1 - s) / l, s * (3 * s - 2)};
  const BeamReal second[4] = {(12 * s - 6) / (l * l), (6 * s - 4) / l, (6 - 12 * s) / (l * l), (6 * s - 2) / l};
  const int v_dof[4] = {kDofV, kDofSlopeV, kNodeDofs + kDofV, kNodeDofs + kDofSlopeV};
  const int w_dof[4] = {kDofW, kDofSlopeW, kNodeDofs + kDofW, kNodeDofs + kDofSlopeW};
  for (int i = 0; i < 4; ++i) {
    v[v_dof[i]] = w[w_dof[i]] = value[i];
    slope_v[v_dof[i]] = slope_w[w_dof[i]] = first[i];
    curvature_v[v_dof[i]] = curvature_w[w_dof[i]] = second[i];
  }

  twist[kDofTwist] = 1 - s;
  twist[kNodeDofs + kDofTwist] = s;
  twist_rate[kDofTwist] = -1 / l;
  twist_rate[kNodeDofs + kDofTwist] = 1 / l;
}

}  // namespace heerk_rotor
