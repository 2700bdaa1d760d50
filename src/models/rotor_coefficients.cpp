#include "heerk_rotor/models/rotor_coefficients.hpp"

#include <cmath>

#include "heerk_rotor/models/inflow_ports.hpp"
#include "heerk_rotor/models/rotor_sections.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLeastPower = 1e-9;  // [-], far below the profile power of any blade (1e-4)

enum Input_ { kForce, kMoment = 3, kReaction = 5, kAzimuth, kSpeed, kFlow = 10, kInflow = 13, kFlap = 16 };
enum Output_ {
  kThrust, kTorque, kPower, kInPlaneForce, kHubMoment, kBladeLoading, kFigureOfMerit, kAdvanceRatio, kAxialAdvanceRatio, kInflowRatio, kShaftAngle, kTipPathPlaneAngle,
  kFlapCoordinates, kLagCoordinates
};

double shaftAngle(const In& u) noexcept { return std::atan2(-u[kFlow + 2], std::hypot(u[kFlow], u[kFlow + 1])); }

}  // namespace

RotorCoefficients::RotorCoefficients(const Parameters& parameters) : p_(parameters), azimuths_(parameters.blades) {
  const double tip_speed = p_.rotor_speed * p_.radius;
  per_force_ = 1.0 / (p_.air_density * kPi * p_.radius * p_.radius * tip_speed * tip_speed);
  per_moment_ = per_force_ / p_.radius;
  solidity_ = p_.blades * p_.chord / (kPi * p_.radius);
}

std::vector<InputPort> RotorCoefficients::inputs() const {
  return {{"rotor_force", 3, "N", "force of the rotor on the fuselage at the hub, in hub_link"},
          {"tilting_moment", 2, "N m", "moment of the rotor on the fuselage about x and y of hub_link"},
          {"blade_reaction", 1, "N m", "moment of the blades on the hub about +z"},
          hubMotionInput(),
          {"hub_flow", 3, "-", "velocity of the hub through the air in hub_link over Omega R (forward, left, up)", Unconnected::kDefault, {}, {"forward", "left", "up"}},
          {"inflow", 3, "-", "induced flow over Omega R, downwards positive: mean, sine and cosine part", Unconnected::kDefault, {}, {"mean", "sine", "cosine"}},
          {"flap", p_.blades, "rad", "flap angle of each blade, up positive"},
          {"lag", p_.blades, "rad", "lag angle of each blade, lead positive"}};
}

std::vector<OutputPort> RotorCoefficients::outputs() const {
  const bool even = p_.blades % 2 == 0;
  const auto coordinates = [even](const std::string& angle) {
    std::vector<std::string> names{angle + "_collective", angle + "_cosine", angle + "_sine"};
    if (even) names.push_back(angle + "_differential");
    return names;
  };
  const Index size = even ? 4 : 3;
  return {{"thrust_coefficient", 1, "-", "CT, thrust along +z of hub_link over rho A (Omega R)^2", {"rotor_force"}, 1e-2, {}, true},
          {"torque_coefficient", 1, "-", "CQ, torque the rotor needs over rho A (Omega R)^2 R", {"blade_reaction"}, 1e-3, {}, true},
          {"power_coefficient", 1, "-", "CP, shaft power at the hub's speed over rho A (Omega R)^3", {"blade_reaction", "hub_motion"}, 1e-3, {}, true},
          {"in_plane_force_coefficients", 2, "-", "CH (aft positive) and CY (right positive)", {"rotor_force"}, 1e-3, {"h_force_coefficient", "side_force_coefficient"}, true},
          {"hub_moment_coefficients", 2, "-", "moments of the rotor on the fuselage about x (roll right) and y (nose down) of hub_link over rho A (Omega R)^2 R", {"tilting_moment"}, 1e-3,
           {"roll_moment_coefficient", "pitch_moment_coefficient"}, true},
          {"blade_loading", 1, "-", "CT over solidity", {"rotor_force"}, 0.1, {}, true},
          {"figure_of_merit", 1, "-", "ideal over actual hover power, 0 without thrust or power", {"rotor_force", "blade_reaction", "hub_motion"}, 1.0, {}, true},
          {"advance_ratio", 1, "-", "mu, in-plane velocity of the hub through the air over Omega R", {"hub_flow"}, 0.1, {}, true},
          {"axial_advance_ratio", 1, "-", "mu_z, upward velocity of the hub through the air over Omega R", {"hub_flow"}, 0.1, {}, true},
          {"inflow_ratio", 1, "-", "lambda = mu_z + mean induced flow over Omega R, downwards positive", {"hub_flow", "inflow"}, 0.1, {}, true},
          {"shaft_angle", 1, "rad", "angle of attack of the hub plane, nose up positive", {"hub_flow"}, 0.1, {}, true},
          {"tip_path_plane_angle", 1, "rad", "angle of attack of the tip-path plane, nose up positive", {"hub_flow", "hub_motion", "flap"}, 0.1, {}, true},
          {"flap_coordinates", size, "rad", "multiblade coordinates of the flap angles", {"hub_motion", "flap"}, 0.1, coordinates("flap"), true},
          {"lag_coordinates", size, "rad", "multiblade coordinates of the lag angles", {"hub_motion", "lag"}, 0.1, coordinates("lag"), true}};
}

void RotorCoefficients::multiblade(const In& u, Index first, Out y) const noexcept {
  double cosine[BladeAzimuths::kMaxBlades], sine[BladeAzimuths::kMaxBlades];
  azimuths_.evaluate(u[kAzimuth], cosine, sine);
  y.setZero();
  for (int k = 0; k < p_.blades; ++k) {
    const double share = u[first + k] / p_.blades;
    y[0] += share;
    y[1] += 2.0 * share * cosine[k];
    y[2] += 2.0 * share * sine[k];
    if (y.size() > 3) y[3] += k % 2 == 0 ? share : -share;
  }
}

double RotorCoefficients::tipPathPlaneAngle(const In& u) const noexcept {
  double flap[4], sine_wind, cosine_wind;
  multiblade(u, kFlap, Out(flap, p_.blades % 2 == 0 ? 4 : 3));
  WindAxes(u[kFlow], u[kFlow + 1]).toWind(flap[2], flap[1], sine_wind, cosine_wind);
  return shaftAngle(u) - cosine_wind;
}

double RotorCoefficients::powerCoefficient(const In& u) const noexcept { return -per_moment_ * u[kReaction] * u[kSpeed] / p_.rotor_speed; }

void RotorCoefficients::evalOutput(Index port, double, const In&, const In& u, Out y) noexcept {
  const auto thrust = [&] { return per_force_ * u[kForce + 2]; };
  switch (port) {
    case kThrust: y[0] = thrust(); break;
    case kTorque: y[0] = -per_moment_ * u[kReaction]; break;
    case kPower: y[0] = powerCoefficient(u); break;
    case kInPlaneForce: y << -per_force_ * u[kForce], -per_force_ * u[kForce + 1]; break;
    case kHubMoment: y << per_moment_ * u[kMoment], per_moment_ * u[kMoment + 1]; break;
    case kBladeLoading: y[0] = thrust() / solidity_; break;
    case kFigureOfMerit: {
      const double power = powerCoefficient(u);
      y[0] = thrust() > 0.0 && power > kLeastPower ? thrust() * std::sqrt(0.5 * thrust()) / power : 0.0;
      break;
    }
    case kAdvanceRatio: y[0] = std::hypot(u[kFlow], u[kFlow + 1]); break;
    case kAxialAdvanceRatio: y[0] = u[kFlow + 2]; break;
    case kInflowRatio: y[0] = u[kFlow + 2] + u[kInflow]; break;
    case kShaftAngle: y[0] = shaftAngle(u); break;
    case kTipPathPlaneAngle: y[0] = tipPathPlaneAngle(u); break;
    case kFlapCoordinates: multiblade(u, kFlap, y); break;
    case kLagCoordinates: multiblade(u, kFlap + p_.blades, y); break;
  }
}

Made makeRotorCoefficients(Section& section, const BuildContext& context) {
  RotorCoefficients::Parameters p;
  const RotorSections rotor = sectionsOfRotor(section, context);
  p.blades = rotor.blades;
  p.radius = rotor.radius;
  p.rotor_speed = context.simulation.rotor_speed;
  p.air_density = section.number("air_density", p.air_density, "kg/m^3", positive());
  p.chord = section.number("chord", p.chord, "m", positive());
  section.finish();
  return std::make_unique<RotorCoefficients>(p);
}

}  // namespace heerk_rotor
