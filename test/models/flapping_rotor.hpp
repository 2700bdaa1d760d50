#pragma once
#include "models/rotor_runs.hpp"

/// The textbook's rotor made of the FE rotor: rigid blades that flap about a hinge at the shaft (e = 0), uniform mass, linear lift without drag,
/// tip loss and compressibility. The blade becomes rigid by keeping its lowest mode only: a straight line through the hinge, which is
/// an exact mode of the elements.
namespace heerk_rotor::test::flapping_rotor {

constexpr double kOmega = 44.4, kR = 4.91, kMass = 5.55, kRho = 1.225, kSlope = 5.73, kLock = 8.0;
const double kInertia = kMass * kR * kR * kR / 3.0;

struct Controls {
  double theta0, twist, theta1c, theta1s, lambda, lambda1c, lambda1s;  // [rad, -]
};

inline std::string digits(double value) { return set("", value).substr(1); }

/// Small angles hold in the airloads and in the structure, or in the structure only.
enum class Kinematics { kSmall, kFullAirloads, kFull };

/// The Bo105 configuration with such blades, two of them, in a wind tunnel with the flow edgewise at mu and prescribed inflow.
inline Overrides flapping(double mu, const Controls& c, Kinematics kinematics = Kinematics::kSmall) {
  Overrides list{"subsystems.drive.type=drive", "subsystems.mast.type=rigid_mast", "subsystems.fuselage.mode=rigid", "subsystems.fuselage.gravity=0",
                 "subsystems.fuselage.shaft_tilt_forward_deg=0", "subsystems.airloads.polar=linear", "subsystems.airloads.compressible=false",
                     "subsystems.airloads.drag=[0.0]",
                 "subsystems.airloads.tip_loss_factor=1.0", "subsystems.inflow.type=prescribed_inflow", "subsystems.rotor.blades=2",
                     "subsystems.rotor.precone_deg=0",
                 "subsystems.rotor.zero_twist_radius=0.75", "subsystems.rotor.root_cutout=0", "subsystems.rotor.section_rule=gauss",
                     "subsystems.rotor.sections=6",
                 "subsystems.rotor.flap_hinge=true", "subsystems.rotor.modes=1", "subsystems.rotor.damping_mass=0",
                     "subsystems.rotor.damping_stiffness=0",
                 "subsystems.rotor.km1=0", "simulation.newton_tolerance=1e-13"};
  const auto number = [&](const std::string& key, double value) { list.push_back(set(key, value)); };
  const auto table = [&](const std::string& key, double value) { list.push_back(set("subsystems.rotor." + key, value)); };
  list.push_back("subsystems.rotor.nodes=[0.0, 2.0, 4.91]");
  list.push_back("subsystems.rotor.stations=[0.0, 4.91]");
  // Stiff against the hinge spring as well; the mode that is kept is at 1 to 1.2 per rev all the same.
  for (const char* stiffness : {"EI_flap", "EI_lag", "GJ"}) table(stiffness, 1e13);
  table("mass", kMass);
  table("twist_deg_per_R", c.twist * 180 / M_PI);
  number("subsystems.airloads.lift_slope", kSlope);
  number("subsystems.airloads.air_density", kRho);
  number("subsystems.airloads.chord", kLock * kInertia / (kRho * kSlope * std::pow(kR, 4)));
  // theta0 is that of the straight root; the hinge turns with the pitch at 0.75 R, which matters with full kinematics only.
  number("subsystems.swashplate.trim_collective", c.theta0 + 0.75 * c.twist);
  number("subsystems.swashplate.trim_lateral_cyclic", c.theta1c);
  number("subsystems.swashplate.trim_longitudinal_cyclic", c.theta1s);
  number("subsystems.inflow.mean", c.lambda);
  number("subsystems.inflow.sine", c.lambda1s);
  number("subsystems.inflow.cosine", c.lambda1c);
  list.push_back("subsystems.fuselage.wind=[" + digits(-mu * kOmega * kR) + ", 0, 0]");
  if (kinematics != Kinematics::kFull) list.push_back("subsystems.rotor.kinematics=small_angle");
  if (kinematics == Kinematics::kSmall) list.push_back("subsystems.airloads.kinematics=small_angle");
  return list;
}

}  // namespace heerk_rotor::test::flapping_rotor
