#pragma once
#include "heerk_rotor/shaft/shaft_types.hpp"

namespace heerk_rotor {

/// One plane of a shaft element: deflection and slope of the left node, then of the right one.
using ElementPlane = Eigen::Matrix<ShaftReal, 4, 4>;

/// Consistent matrices of a circular beam element in one plane, cubic in the deflection.
///
/// Euler-Bernoulli with rotary inertia, or Timoshenko: bending and shear share the deflection by Phi = 12 E I / (kappa G A l^2), exact
/// for loads at the nodes (Przemieniecki, Theory of Matrix Structural Analysis, 1968, eqs. 5.116 and 11.29). kappa after Cowper, J. Appl.
/// Mech. 33 (1966) 335, for circular sections with or without bore. Phi = 0 gives Euler-Bernoulli.
struct ShaftElement {
  ElementPlane stiffness;  // [N/m, N, N m]
  ElementPlane mass;       // of the deflection [kg, kg m, kg m^2]
  ElementPlane rotary;     // of the section's tilt, diametral: the polar one is twice it [kg, kg m, kg m^2]

  struct Section {
    ShaftReal outer = 0, inner = 0;  // diameters [m]
    ShaftReal youngs_modulus = 0;    // [N/m^2]
    ShaftReal density = 0;           // [kg/m^3]
    ShaftReal poisson_ratio = 0;     // [-]
    bool shear = false;
  };
  ShaftElement(const Section& section, ShaftReal length);
};

/// kappa of a circular section [-].
ShaftReal shearCoefficient(ShaftReal outer, ShaftReal inner, ShaftReal poisson_ratio);

}  // namespace heerk_rotor
