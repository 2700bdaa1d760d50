#include "heerk_rotor/models/registry.hpp"

#include <algorithm>

#include "heerk_rotor/models/lag_airloads.hpp"
#include "heerk_rotor/models/lag_rotor.hpp"
#include "heerk_rotor/models/monolithic_lag_rotor.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {
namespace {

Made makeLagRotor(Section& section, const BuildContext& context) {
  return std::make_unique<LagRotor>(readLagRotorParameters(section), formulationOf(context));
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

bool BuildContext::connects(const std::string& output, const std::string& input) const {
  const YAML::Node connections = configuration.root()["connections"];
  if (!connections || !connections.IsSequence()) return false;
  for (const auto& pair : connections)
    if (pair.IsSequence() && pair.size() == 2 && pair[0].IsScalar() && pair[1].IsScalar() && pair[0].Scalar() == output && pair[1].Scalar() == input) return true;
  return false;
}

const std::vector<ModelType>& modelTypes() {
  static const std::vector<ModelType> types{
      {"lag_rotor", "four lag-hinged blades on a fuselage (HEERK paper, Section 3)", makeLagRotor},
      {"elastic_mast", "torsion spring between drive and hub", makeElasticMast},
      {"rigid_mast", "hub that follows the drive exactly", makeRigidMast},
      {"drive", "drive train that follows a speed command", makeDrive},
      {"governed_drive", "engine with speed governor, or free rotor speed", makeGovernedDrive},
      {"swashplate", "second-order actuators, collective and cyclic blade pitch", makeSwashplate},
      {"uniform_inflow", "uniform induced flow after Glauert", makeUniformInflow},
      {"drees_inflow", "linear induced flow after Drees", makeDreesInflow},
      {"prescribed_inflow", "induced flow as commanded", makePrescribedInflow},
      {"pitt_peters_inflow", "dynamic induced flow after Pitt and Peters, three states", makePittPetersInflow},
      {"rotor_coefficients", "thrust, torque, power and moment coefficients, multiblade coordinates", makeRotorCoefficients},
      {"lag_airloads", "blade-element airloads with uniform inflow for the lag rotor", makeLagAirloads},
      {"fe_rotor", "elastic rotor: flap, lag and torsion of the blades as finite elements (HEERK paper, Section 4)", makeFeRotor},
      {"blade_airloads", "blade-element airloads of elastic blades: linear or tabulated polars, unsteady lift", makeBladeAirloads},
      {"mount", "what carries the hub: wind-tunnel mount, fuselage on springs, free rigid body", makeMount},
      {"shaft_rotor", "rotating shaft with discs and bearings as finite elements (Liu & Zhang)", makeShaftRotor},
      {"squeeze_film_damper", "squeeze film around a journal, short bearing, half or full film (Liu & Zhang, eq. 15)", makeSqueezeFilmDamper},
      {"speed_ramp", "rotor speed as a function of time: constant or a run-up", makeSpeedRamp},
      {"monolithic_lag_rotor", "lag rotor and elastic mast as one equation (HEERK paper, A.2)", makeMonolithicLagRotor},
  };
  return types;
}

}  // namespace heerk_rotor
