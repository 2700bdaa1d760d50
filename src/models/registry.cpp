#include "heerk_rotor/models/registry.hpp"

#include <algorithm>

#include "heerk_rotor/models/drive.hpp"
#include "heerk_rotor/models/elastic_mast.hpp"
#include "heerk_rotor/models/lag_airloads.hpp"
#include "heerk_rotor/models/lag_rotor.hpp"
#include "heerk_rotor/models/monolithic_lag_rotor.hpp"
#include "heerk_rotor/models/swashplate.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {
namespace {

/// A spring-mounted hub needs inertia of its own: without hinge offset or blade inertia, common lag motion balances the
/// hub completely (kappa is infinite) and the coupled system is not index 1. Long before that its equations lose all
/// digits, because the hub acceleration is a difference that is kappa times smaller than its parts.
bool checkMastInertia(Section& section, const LagRotorParameters& rotor) {
  constexpr double kLargestKappa = 1e8;  // leaves half of the digits
  if (LagRotorConstants(rotor).kappa <= kLargestKappa) return true;
  section.problem("type", "rigid_mast, because with so small a hinge_offset or blade_inertia of the rotor the hub has no inertia against "
                          "common lag motion, and an elastic mast makes the system not index 1");
  return false;
}

Made makeLagRotor(Section& section, const BuildContext& context) {
  return std::make_unique<LagRotor>(readLagRotorParameters(section), formulationOf(context));
}

Made makeElasticMast(Section& section, const BuildContext& context) {
  ElasticMast::Parameters p;
  p.stiffness = section.number("stiffness", p.stiffness, "N m/rad", positive());
  p.damping = section.number("damping", p.damping, "N m s/rad", nonNegative());
  p.rotor_speed = context.simulation.rotor_speed;
  const LagRotorParameters rotor = rotorOfMast(section, context);
  section.finish();
  if (!checkMastInertia(section, rotor)) return nullptr;
  return std::make_unique<ElasticMast>(p, mastLoad(rotor, formulationOf(context), p.rotor_speed));
}

Made makeRigidMast(Section& section, const BuildContext& context) {
  // Keys of elastic_mast, without effect here: one line, `type`, swaps the masts.
  section.number("stiffness", 0.0, "N m/rad", positive());
  section.number("damping", 0.0, "N m s/rad", nonNegative());
  const LagRotorParameters rotor = rotorOfMast(section, context);
  section.finish();
  return std::make_unique<RigidMast>(context.simulation.rotor_speed, mastLoad(rotor, formulationOf(context), context.simulation.rotor_speed));
}

Made makeDrive(Section& section, const BuildContext& context) {
  Drive::Parameters p;
  p.rotor_speed = context.simulation.rotor_speed;
  p.frequency = section.number("frequency", p.frequency, "rad/s", positive());
  p.damping_ratio = section.number("damping_ratio", p.damping_ratio, "-", positive());
  p.max_acceleration = section.number("max_acceleration", p.max_acceleration, "rad/s^2", positive());
  p.min_speed = section.number("min_speed", 0.5 * p.rotor_speed, "rad/s", nonNegative());
  p.max_speed = section.number("max_speed", 1.2 * p.rotor_speed, "rad/s", {p.min_speed, 1e4, false});
  section.finish();
  return std::make_unique<Drive>(p);
}

Made makeSwashplate(Section& section, const BuildContext&) {
  Swashplate::Parameters p;
  p.frequency = section.number("frequency", p.frequency, "rad/s", positive());
  p.damping_ratio = section.number("damping_ratio", p.damping_ratio, "-", positive());
  p.rate_limit = section.number("rate_limit", p.rate_limit, "rad/s", positive());
  p.collective_min = section.number("collective_min", p.collective_min, "rad", {-0.6, 0.6, false});
  p.collective_max = section.number("collective_max", p.collective_max, "rad", {p.collective_min, 0.6, true});
  p.cyclic_limit = section.number("cyclic_limit", p.cyclic_limit, "rad", {0.0, 0.6, false});
  p.trim[0] = section.number("trim_collective", 0.0, "rad", {p.collective_min, p.collective_max, false});
  p.trim[1] = section.number("trim_lateral_cyclic", 0.0, "rad", {-p.cyclic_limit, p.cyclic_limit, false});
  p.trim[2] = section.number("trim_longitudinal_cyclic", 0.0, "rad", {-p.cyclic_limit, p.cyclic_limit, false});
  section.finish();
  return std::make_unique<Swashplate>(p);
}

Made makeLagAirloads(Section& section, const BuildContext& context) {
  LagAirloads::Parameters p;
  p.rotor_speed = context.simulation.rotor_speed;
  p.radius = section.number("radius", p.radius, "m", positive());
  p.root_cutout = section.number("root_cutout", p.root_cutout, "m", {0.0, p.radius, false});
  p.chord = section.number("chord", p.chord, "m", positive());
  p.twist = section.number("twist", p.twist, "rad", {-1.0, 1.0, false});
  p.lift_slope = section.number("lift_slope", p.lift_slope, "1/rad", positive());
  p.profile_drag = section.number("profile_drag", p.profile_drag, "-", nonNegative());
  p.air_density = section.number("air_density", p.air_density, "kg/m^3", positive());
  p.hinge_offset = rotorOfMast(section, context).hinge_offset;
  section.finish();
  return std::make_unique<LagAirloads>(p);
}

Made makeMonolithicLagRotor(Section& section, const BuildContext& context) {
  MonolithicLagRotor::Parameters p;
  p.rotor_speed = context.simulation.rotor_speed;
  p.mast_stiffness = section.number("mast_stiffness", p.mast_stiffness, "N m/rad", positive());
  const std::string part = section.word("linear_part", "exact", {"zero", "paper", "exact"});
  p.linear_part = part == "zero" ? MonolithicLagRotor::LinearPart::kZero : part == "paper" ? MonolithicLagRotor::LinearPart::kPaper : MonolithicLagRotor::LinearPart::kExact;
  const auto lag = section.numbers("reference_lag", kLagBlades, 0.0, "rad");
  std::copy(lag.begin(), lag.end(), p.reference_lag.begin());
  // A.2 knows neither dampers nor a mass that differs between the axes; silence would look as if they acted.
  for (const char* key : {"lag_damper", "fuselage_damping_x", "fuselage_damping_y", "fuselage_mass_x", "fuselage_mass_y"})
    if (section.has(key)) section.problem(key, "not given: the monolithic form has no dampers and one fuselage mass (use lag_rotor with elastic_mast)");
  if (section.has("second_order_hub_terms") && section.flag("second_order_hub_terms", false))
    section.problem("second_order_hub_terms", "false: the monolithic form is the paper's, without them");
  p.rotor = readLagRotorParameters(section);
  return std::make_unique<MonolithicLagRotor>(p);
}

}  // namespace

std::string BuildContext::onlySubsystemOfType(const std::string& type) const {
  std::string found;
  const YAML::Node subsystems = configuration.root()["subsystems"];
  if (!subsystems || !subsystems.IsMap()) return found;
  for (const auto& entry : subsystems) {
    if (!entry.second.IsMap() || !entry.second["type"] || !entry.second["type"].IsScalar() || entry.second["type"].Scalar() != type) continue;
    if (!found.empty()) return "";
    found = entry.first.Scalar();
  }
  return found;
}

const std::vector<ModelType>& modelTypes() {
  static const std::vector<ModelType> types{
      {"lag_rotor", "four lag-hinged blades on a fuselage (HEERK paper, Section 3)", makeLagRotor},
      {"elastic_mast", "torsion spring between drive and hub", makeElasticMast},
      {"rigid_mast", "hub that follows the drive exactly", makeRigidMast},
      {"drive", "drive train that follows a speed command", makeDrive},
      {"swashplate", "second-order actuators, collective and cyclic blade pitch", makeSwashplate},
      {"lag_airloads", "blade-element airloads with uniform inflow for the lag rotor", makeLagAirloads},
      {"fe_rotor", "elastic rotor: flap, lag and torsion of the blades as finite elements (HEERK paper, Section 4)", makeFeRotor},
      {"blade_airloads", "blade-element airloads of elastic blades: linear or tabulated polars, unsteady lift", makeBladeAirloads},
      {"monolithic_lag_rotor", "lag rotor and elastic mast as one equation (HEERK paper, A.2)", makeMonolithicLagRotor},
      {"mount", "what carries the hub: wind-tunnel mount, fuselage on springs, free rigid body", makeMount},
  };
  return types;
}

}  // namespace heerk_rotor
