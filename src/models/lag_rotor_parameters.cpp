#include "heerk_rotor/models/lag_rotor_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "heerk_rotor/models/registry.hpp"

namespace heerk_rotor {

LagRotorParameters readLagRotorParameters(Section& section) {
  LagRotorParameters p;
  p.hinge_offset = section.number("hinge_offset", p.hinge_offset, "m", nonNegative());
  p.blade_length = section.number("blade_length", p.blade_length, "m", positive());
  p.blade_mass = section.number("blade_mass", p.blade_mass, "kg", positive());
  p.blade_inertia = section.number("blade_inertia", p.blade_inertia, "kg m^2", nonNegative());
  const double mass = section.number("fuselage_mass", p.fuselage_mass_x, "kg", positive());
  if (section.has("fuselage_mass") && (section.has("fuselage_mass_x") || section.has("fuselage_mass_y")))
    section.problem("fuselage_mass", "either fuselage_mass, or fuselage_mass_x and fuselage_mass_y");
  p.fuselage_mass_x = section.number("fuselage_mass_x", mass, "kg", positive());
  p.fuselage_mass_y = section.number("fuselage_mass_y", mass, "kg", positive());
  const auto frequency = section.numbers("lag_frequency", kLagBlades, p.lag_frequency[0], "rad/s", nonNegative());
  std::copy_n(frequency.begin(), kLagBlades, p.lag_frequency.begin());
  const auto damper = section.numbers("lag_damper", kLagBlades, 0.0, "N m s/rad", nonNegative());
  std::copy_n(damper.begin(), kLagBlades, p.lag_damper.begin());
  p.fuselage_frequency_x = section.number("fuselage_frequency_x", p.fuselage_frequency_x, "rad/s", nonNegative());
  p.fuselage_frequency_y = section.number("fuselage_frequency_y", p.fuselage_frequency_y, "rad/s", nonNegative());
  p.fuselage_damping_x = section.number("fuselage_damping_x", p.fuselage_damping_x, "N s/m", nonNegative());
  p.fuselage_damping_y = section.number("fuselage_damping_y", p.fuselage_damping_y, "N s/m", nonNegative());
  p.second_order_hub_terms = section.flag("second_order_hub_terms", p.second_order_hub_terms);
  section.finish();
  return p;
}

LagRotorConstants::LagRotorConstants(const LagRotorParameters& p) {
  const double a = p.hinge_offset, b = p.blade_length, m = p.blade_mass;
  mass_x = p.fuselage_mass_x + kLagBlades * m;
  mass_y = p.fuselage_mass_y + kLagBlades * m;
  static_moment = m * b;
  r_mx = static_moment / mass_x;
  r_my = static_moment / mass_y;
  lag_inertia = m * b * b + p.blade_inertia;
  r_b = static_moment / lag_inertia;
  r_a2 = a * r_b;
  g = 1.0 + r_a2;
  hub_inertia = kLagBlades * ((a + b) * (a + b) * m + p.blade_inertia);
  coupling_inertia = b * (a + b) * m + p.blade_inertia;
  load = 1.0 / lag_inertia;
  for (int i = 0; i < kLagBlades; ++i) {
    spring[i] = p.lag_frequency[i] * p.lag_frequency[i];
    damper[i] = p.lag_damper[i] / lag_inertia;
  }
  per_mass_x = 1.0 / mass_x;
  per_mass_y = 1.0 / mass_y;
  damping_x = p.fuselage_damping_x / mass_x;
  damping_y = p.fuselage_damping_y / mass_y;
  spring_x = p.fuselage_frequency_x * p.fuselage_frequency_x;
  spring_y = p.fuselage_frequency_y * p.fuselage_frequency_y;
  gain_x = 1.0 / (1.0 - 2.0 * r_mx * r_b);
  gain_y = 1.0 / (1.0 - 2.0 * r_my * r_b);
  q = kLagBlades * coupling_inertia * g / hub_inertia;
  // J - 4 S_h g written without cancellation: the inertia about the hub that pure lag motion cannot balance,
  // J - 4 S_h^2 / I_l = 4 a^2 m_b I_zb / I_l.
  kappa = hub_inertia * lag_inertia / (kLagBlades * a * a * m * p.blade_inertia);
}

MastLoad mastLoad(const LagRotorParameters& p, LagFormulation formulation, double rotor_speed) {
  const LagRotorConstants c(p);
  MastLoad load;
  load.formulation = formulation;
  load.inertia = c.hub_inertia;
  if (formulation == LagFormulation::kPrinted) return load;
  load.inertia = c.hub_inertia / c.kappa;
  for (int i = 0; i < kLagBlades; ++i) {
    const double k = c.r_a2 * rotor_speed * rotor_speed + p.lag_frequency[i] * p.lag_frequency[i];
    load.stiffness += c.coupling_inertia * c.g * k;
    load.damping += c.coupling_inertia * c.g * p.lag_damper[i] / c.lag_inertia;
  }
  return load;
}

LagRotorParameters rotorOfMast(Section& section, const BuildContext& context) {
  const std::string only = context.onlySubsystemOfType("lag_rotor");
  const std::string name = section.word("rotor", only);
  if (name.empty()) {
    section.problem("rotor", "the name of the lag_rotor on this mast (the configuration has not exactly one)");
    return {};
  }
  Problems reported_by_the_rotor_itself;
  Section rotor(context.configuration, "subsystems." + name, reported_by_the_rotor_itself);
  if (rotor.word("type", "") != "lag_rotor") {
    section.problem("rotor", "the name of a subsystem of type lag_rotor");
    return {};
  }
  return readLagRotorParameters(rotor);
}

LagFormulation formulationOf(const BuildContext& context) {
  return context.simulation.formulation == "printed" ? LagFormulation::kPrinted : LagFormulation::kAbsoluteLag;
}

}  // namespace heerk_rotor
