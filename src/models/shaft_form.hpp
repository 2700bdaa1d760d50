#pragma once
#include <vector>

#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/shaft/shaft_matrices.hpp"

namespace heerk_rotor {

/// A shaft at nominal speed as x' = S x + force F, (q, q') = observe x: the coordinates are the only difference between the forms.
struct ShaftForm {
  std::vector<State> states;  // (N)
  StiffPart S;
  Matrix observe;             // (2n x N)
  Matrix force;               // (N x n)
  Matrix energy;              // (2n x N) energy = |energy x|^2 / 2
  Vector start;               // (N) x of q = q' = 0 at t = 0
  Index phasor_cos = -1;      // states that hold cos and sin of Omega t and drive the unbalance of nominal speed inside S;
  Index phasor_sin = -1;      // -1: the unbalance is not in S
};

/// Eigenvectors of the shaft at nominal speed; with the unbalance inside S counted from the steady response to it. Throws std::exception when there is no such form.
ShaftForm modalShaftForm(const ShaftMatrices& shaft, double rotor_speed, bool unbalance_inside);

/// Displacements, then their rates.
ShaftForm physicalShaftForm(const ShaftMatrices& shaft, double rotor_speed);

}  // namespace heerk_rotor
