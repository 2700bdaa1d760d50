#include "heerk_rotor/shaft/shaft_element.hpp"

namespace heerk_rotor {
namespace {

constexpr ShaftReal kPi = 3.14159265358979323846264338327950288L;

/// The symmetric pattern all three matrices share: forces and moments at both ends mirror each other.
ElementPlane mirrored(ShaftReal force, ShaftReal moment, ShaftReal other_force, ShaftReal other_moment, ShaftReal angle, ShaftReal other_angle) {
  ElementPlane A;
  A << force, moment, other_force, other_moment,
       moment, angle, -other_moment, other_angle,
       other_force, -other_moment, force, -moment,
       other_moment, other_angle, -moment, angle;
  return A;
}

}  // namespace

ShaftReal shearCoefficient(ShaftReal outer, ShaftReal inner, ShaftReal nu) {
  const ShaftReal m2 = (inner / outer) * (inner / outer), s = (1 + m2) * (1 + m2);
  return 6 * (1 + nu) * s / ((7 + 6 * nu) * s + (20 + 12 * nu) * m2);
}

ShaftElement::ShaftElement(const Section& section, ShaftReal l) {
  const ShaftReal d2 = section.outer * section.outer, b2 = section.inner * section.inner;
  const ShaftReal area = kPi / 4 * (d2 - b2), I = kPi / 64 * (d2 * d2 - b2 * b2);
  const ShaftReal EI = section.youngs_modulus * I;
  const ShaftReal shear_modulus = section.youngs_modulus / (2 * (1 + section.poisson_ratio));
  const ShaftReal kappa = shearCoefficient(section.outer, section.inner, section.poisson_ratio);
  const ShaftReal f = section.shear ? 12 * EI / (kappa * shear_modulus * area * l * l) : 0;  // Phi
  const ShaftReal g = 1 + f, f2 = f * f;

  stiffness = EI / (l * l * l * g) * mirrored(12, 6 * l, -12, 6 * l, (4 + f) * l * l, (2 - f) * l * l);
  mass = section.density * area * l / (g * g) *
         mirrored(13.0L / 35 + 7 * f / 10 + f2 / 3, (11.0L / 210 + 11 * f / 120 + f2 / 24) * l,
                  9.0L / 70 + 3 * f / 10 + f2 / 6, -(13.0L / 420 + 3 * f / 40 + f2 / 24) * l,
                  (1.0L / 105 + f / 60 + f2 / 120) * l * l, -(1.0L / 140 + f / 60 + f2 / 120) * l * l);
  rotary = section.density * I / (l * g * g) *
           mirrored(6.0L / 5, (1.0L / 10 - f / 2) * l, -6.0L / 5, (1.0L / 10 - f / 2) * l,
                    (2.0L / 15 + f / 6 + f2 / 3) * l * l, (-1.0L / 30 - f / 6 + f2 / 6) * l * l);
}

}  // namespace heerk_rotor
