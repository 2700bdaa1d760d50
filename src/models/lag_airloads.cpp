#include "heerk_rotor/models/lag_airloads.hpp"

#include <cmath>

#include "heerk_rotor/core/branch_free_math.hpp"

namespace heerk_rotor {
namespace {

enum Input_ { kAzimuth, kSpeed, kPitch = 4, kLagRate = 8, kVelocityX = 12, kVelocityY };
enum Output_ { kBladeLoad, kThrustLoad, kThrustCoefficient, kTorqueCoefficient, kPowerCoefficient, kAdvanceRatio, kInflow };

// Five Gauss-Legendre points integrate polynomials up to degree 9 exactly; the integrands here, such as
// (r - a) theta U_T^2, have degree 4.
constexpr int kPoints = 5;
constexpr double kNode[kPoints] = {-0.906179845938663992797626878299, -0.538469310105683091036314420700, 0.0,
                                   0.538469310105683091036314420700, 0.906179845938663992797626878299};
constexpr double kWeight[kPoints] = {0.236926885056189087514264040720, 0.478628670499366468041291514836, 0.568888888888888888888888888889,
                                     0.478628670499366468041291514836, 0.236926885056189087514264040720};

}  // namespace

LagAirloads::LagAirloads(const Parameters& parameters) : p_(parameters), disc_area_(M_PI * p_.radius * p_.radius) {
  const double half = 0.5 * (p_.radius - p_.root_cutout);
  for (int j = 0; j < kPoints; ++j) {
    radius_.push_back(p_.root_cutout + half * (1.0 + kNode[j]));
    weight_.push_back(half * kWeight[j]);
    pitch_offset_.push_back(p_.twist * (radius_.back() / p_.radius - 0.75));
  }
}

std::vector<InputPort> LagAirloads::inputs() const {
  return {hubMotionInput(),
          {"pitch", kBlades, "rad", "pitch of each blade at 0.75 R, nose up positive", Unconnected::kError},
          {"lag_rate", kBlades, "rad/s", "lag rate of each blade, lead positive", Unconnected::kError},
          {"hub_velocity", 3, "m/s", "velocity of the hub in hub_link (x forward, y left, z up; z is not used)", Unconnected::kDefault, {}, {"x", "y", "z"}}};
}

std::vector<OutputPort> LagAirloads::outputs() const {
  const std::vector<std::string> all{"hub_motion", "pitch", "lag_rate", "hub_velocity"};
  return {{"blade_load", 2 * kBlades, "N, N m", "tangential force of each blade towards lead, then its moment about the lag hinge", all, 1e3,
           {"force_1", "force_2", "force_3", "force_4", "hinge_moment_1", "hinge_moment_2", "hinge_moment_3", "hinge_moment_4"}, false,
           {"N", "N", "N", "N", "N m", "N m", "N m", "N m"}},
          {"thrust_load", 3, "N, N m", "thrust, rolling and pitching moment at the hub, in hub_link", all, 1e4, {"thrust", "roll_moment", "pitch_moment"}, true, {"N", "N m", "N m"}},
          {"thrust_coefficient", 1, "-", "T / (rho A (Omega R)^2)", all, 1e-2, {}, true},
          {"torque_coefficient", 1, "-", "Q / (rho A (Omega R)^2 R), Q the torque that turns the rotor", all, 1e-3, {}, true},
          {"power_coefficient", 1, "-", "Q omega / (rho A (Omega R)^3)", all, 1e-3, {}, true},
          {"advance_ratio", 1, "-", "in-plane hub speed / (Omega R)", {"hub_velocity"}, 0.1, {}, false},
          {"inflow", 1, "-", "uniform induced velocity / (Omega R), downwards positive", all, 0.05, {}, true}};
}

/// The root of 2 rho A v sqrt(V^2 + v^2) = thrust0 - slope v, which is unique because the left side rises and the right falls.
double LagAirloads::inducedVelocity(double thrust0, double slope, double speed_squared) const noexcept {
  const double disc = 2.0 * p_.air_density * disc_area_;
  const double sign = thrust0 < 0.0 ? -1.0 : 1.0, target = std::abs(thrust0);
  // Hover (V = 0) gives an upper bound in closed form; from there Newton descends monotonically, the function being convex.
  double v = 2.0 * target / (slope + std::sqrt(slope * slope + 4.0 * disc * target) + 1e-300);
  for (int i = 0; i < 20 && speed_squared > 0.0; ++i) {
    const double root = std::sqrt(speed_squared + v * v);
    const double step = (disc * v * root + slope * v - target) / (disc * (root + v * v / root) + slope);
    v -= step;
    if (std::abs(step) <= 1e-15 * v) break;
  }
  return sign * v;
}

LagAirloads::Loads LagAirloads::loads(const In& u) const noexcept {
  const auto [s, c] = sineCosine(u[kAzimuth]);
  const double omega = u[kSpeed];
  // e_r = (-cos, -sin), e_t = (sin, -cos) in hub_link, psi = 0 aft
  const double sine[kBlades] = {s, c, -s, -c}, cosine[kBlades] = {c, -s, -c, s};
  const double half_rho_c = 0.5 * p_.air_density * p_.chord;

  // Thrust is linear in the induced velocity v: sums of |U_T| U_T theta and of |U_T|, with their moments.
  double lift[kBlades] = {}, lift_slope[kBlades] = {}, arm[kBlades] = {}, arm_slope[kBlades] = {};
  double tangential[kBlades][kPoints];
  double thrust0 = 0.0, slope = 0.0;
  for (int i = 0; i < kBlades; ++i) {
    const double hub = u[kVelocityX] * sine[i] - u[kVelocityY] * cosine[i];
    for (int j = 0; j < kPoints; ++j) {
      const double r = radius_[j], ut = omega * r + u[kLagRate + i] * (r - p_.hinge_offset) + hub;
      const double k = half_rho_c * p_.lift_slope * weight_[j] * std::abs(ut), l = k * ut * (u[kPitch + i] + pitch_offset_[j]);
      tangential[i][j] = ut;
      lift[i] += l;
      lift_slope[i] += k;
      arm[i] += r * l;
      arm_slope[i] += r * k;
    }
    thrust0 += lift[i];
    slope += lift_slope[i];
  }
  const double v = inducedVelocity(thrust0, slope, u[kVelocityX] * u[kVelocityX] + u[kVelocityY] * u[kVelocityY]);

  Loads result{};
  result.inflow = v / (p_.rotor_speed * p_.radius);
  for (int i = 0; i < kBlades; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      const double ut = tangential[i][j], theta = u[kPitch + i] + pitch_offset_[j];
      const double direction = ut < 0.0 ? -1.0 : 1.0;
      const double drag = half_rho_c * weight_[j] * (direction * p_.lift_slope * (theta * ut - v) * v + p_.profile_drag * std::abs(ut) * ut);
      result.force[i] -= drag;
      result.moment[i] -= (radius_[j] - p_.hinge_offset) * drag;
    }
    result.thrust += lift[i] - v * lift_slope[i];
    // e_r x z: thrust at radius r gives roll +(y r) and pitch -(x r)
    const double moment = arm[i] - v * arm_slope[i];
    result.roll -= sine[i] * moment;
    result.pitch += cosine[i] * moment;
    result.torque -= result.moment[i] + p_.hinge_offset * result.force[i];
  }
  return result;
}

void LagAirloads::evalOutput(Index port, double, const In&, const In& u, Out y) noexcept {
  const double tip_speed = p_.rotor_speed * p_.radius;
  if (port == kAdvanceRatio) {
    y[0] = std::hypot(u[kVelocityX], u[kVelocityY]) / tip_speed;
    return;
  }
  const Loads l = loads(u);
  const double reference = p_.air_density * disc_area_ * tip_speed * tip_speed;
  switch (port) {
    case kBladeLoad:
      for (int i = 0; i < kBlades; ++i) {
        y[i] = l.force[i];
        y[kBlades + i] = l.moment[i];
      }
      break;
    case kThrustLoad: y << l.thrust, l.roll, l.pitch; break;
    case kThrustCoefficient: y[0] = l.thrust / reference; break;
    case kTorqueCoefficient: y[0] = l.torque / (reference * p_.radius); break;
    case kPowerCoefficient: y[0] = l.torque * u[kSpeed] / (reference * tip_speed); break;
    case kInflow: y[0] = l.inflow; break;
  }
}

}  // namespace heerk_rotor
