#include "heerk_rotor/models/swashplate.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

#include "heerk_rotor/models/rotor_sections.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {
namespace {

enum Input_ { kCommand, kAzimuth = 3, kSpeed, kHubAcceleration = 7, kDriveAcceleration, kFlap };
enum Output_ { kPitch, kPitchRate, kPitchAcceleration, kPosition };
const char* const kNames[] = {"collective", "lateral_cyclic", "longitudinal_cyclic"};

}  // namespace

struct Swashplate::Harmonics {
  double collective, cosine, sine;
};

Swashplate::Swashplate(const Parameters& parameters)
    : p_(parameters), azimuths_(parameters.blades), coupling_(std::tan(parameters.delta3)),
      low_{p_.collective_min, -p_.cyclic_limit, -p_.cyclic_limit}, high_{p_.collective_max, p_.cyclic_limit, p_.cyclic_limit} {
  // As if NaN had been asked for last: should that be the first argument, NaN is the answer.
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  azimuth_key_ = kNaN;
  std::fill(std::begin(saturation_key_), std::end(saturation_key_), kNaN);
  saturation_.fill(kNaN);
  std::fill(std::begin(cosine_), std::end(cosine_), kNaN);
  std::fill(std::begin(sine_), std::end(sine_), kNaN);
}

std::vector<State> Swashplate::states() const {
  std::vector<State> list;
  for (std::size_t i = 0; i < 3; ++i) list.push_back({kNames[i], "rad", std::string("actual ") + kNames[i], p_.trim[i]});
  for (int i = 0; i < 3; ++i) list.push_back({std::string(kNames[i]) + "_demand", "rad/s", "actuator rate asked for, before the limit"});
  return list;
}

std::vector<InputPort> Swashplate::inputs() const {
  std::vector<InputPort> list{{"command", 3, "rad", "collective at 0.75 R, lateral cyclic theta_1c, longitudinal cyclic theta_1s", Unconnected::kCommand,
                               {p_.trim[0], p_.trim[1], p_.trim[2]}, {kNames[0], kNames[1], kNames[2]}, {low_.begin(), low_.end()}, {high_.begin(), high_.end()}},
                              hubMotionInput(),
                              {"hub_acceleration", 2, "rad/s^2", "angular acceleration of the hub and of the drive", Unconnected::kDefault, {}, {"hub", "drive"}}};
  if (coupling_ != 0.0) {
    list.push_back({"flap", p_.blades, "rad", "flap angle of each blade, up positive"});
    list.push_back({"flap_rate", p_.blades, "rad/s", "its rate"});
    list.push_back({"flap_acceleration", p_.blades, "rad/s^2", "its acceleration", Unconnected::kDefault});
  }
  return list;
}

std::vector<OutputPort> Swashplate::outputs() const {
  std::vector<std::string> pitch{"hub_motion"}, rate{"hub_motion"}, acceleration{"command", "hub_motion", "hub_acceleration"};
  if (coupling_ != 0.0) {
    pitch.push_back("flap");
    rate.push_back("flap_rate");
    acceleration.push_back("flap_acceleration");
  }
  return {{"pitch", p_.blades, "rad", "pitch of each blade at 0.75 R, nose up positive", pitch, 0.1, {}, true},
          {"pitch_rate", p_.blades, "rad/s", "time derivative of the pitch", rate, 1.0, {}, false},
          {"pitch_acceleration", p_.blades, "rad/s^2", "second time derivative of the pitch", acceleration, 100.0, {}, false},
          {"position", 3, "rad", "actual collective, lateral and longitudinal cyclic", {}, 0.1, {kNames[0], kNames[1], kNames[2]}, true}};
}

double Swashplate::limitedCommand(const In& u, Index i) const noexcept {
  const auto k = static_cast<std::size_t>(i);
  return std::clamp(u[kCommand + i], low_[k], high_[k]);
}

Swashplate::Harmonics Swashplate::pitch(const In& x) const noexcept { return {x[0], x[1], x[2]}; }

const std::array<double, 3>& Swashplate::saturation(const In& x) noexcept {
  if (std::memcmp(saturation_key_, x.data() + 3, sizeof saturation_key_) != 0) {
    std::memcpy(saturation_key_, x.data() + 3, sizeof saturation_key_);
    for (Index i = 0; i < 3; ++i) saturation_[static_cast<std::size_t>(i)] = std::tanh(x[3 + i] / p_.rate_limit);
  }
  return saturation_;
}

void Swashplate::turnTo(double azimuth) noexcept {
  if (std::memcmp(&azimuth_key_, &azimuth, sizeof azimuth) == 0) return;
  azimuth_key_ = azimuth;
  azimuths_.evaluate(azimuth + p_.phase, cosine_, sine_);
}

Swashplate::Harmonics Swashplate::pitchRate(const In& x, double speed) noexcept {
  const auto& saturated = saturation(x);
  const double rate[3] = {p_.rate_limit * saturated[0], p_.rate_limit * saturated[1], p_.rate_limit * saturated[2]};
  return {rate[0], rate[1] + speed * x[2], rate[2] - speed * x[1]};
}

Swashplate::Harmonics Swashplate::pitchAcceleration(const In& x, const In& u) noexcept {
  const auto& saturated = saturation(x);
  double rate[3], acceleration[3];
  for (int i = 0; i < 3; ++i) {
    const double s = saturated[static_cast<std::size_t>(i)];
    const double demand_rate = p_.frequency * p_.frequency * (limitedCommand(u, i) - x[i]) - 2.0 * p_.damping_ratio * p_.frequency * x[3 + i];
    rate[i] = p_.rate_limit * s;
    acceleration[i] = (1.0 - s * s) * demand_rate;
  }
  const double speed = u[kSpeed], alpha = u[kHubAcceleration];
  return {acceleration[0],
          acceleration[1] + 2.0 * speed * rate[2] + alpha * x[2] - speed * speed * x[1],
          acceleration[2] - 2.0 * speed * rate[1] - alpha * x[1] - speed * speed * x[2]};
}

void Swashplate::evalOutput(Index port, double, const In& x, const In& u, Out y) noexcept {
  if (port == kPosition) {
    y = x.head(3);
    return;
  }
  turnTo(u[kAzimuth]);
  const Harmonics part = port == kPitch ? pitch(x) : port == kPitchRate ? pitchRate(x, u[kSpeed]) : pitchAcceleration(x, u);
  for (int k = 0; k < p_.blades; ++k) y[k] = part.collective + part.cosine * cosine_[k] + part.sine * sine_[k];
  if (coupling_ != 0.0) y -= coupling_ * u.segment(kFlap + port * p_.blades, p_.blades);  // flap and its derivatives, in the order of the outputs
}

bool Swashplate::outputJacobian(Index port, double, const In& x, const In& u, Eigen::Map<Matrix> jacobian) noexcept {
  if (port != kPitchAcceleration) return false;  // the others read nothing that is in a loop
  turnTo(u[kAzimuth]);
  const auto& saturated = saturation(x);
  double gain[3];
  for (int i = 0; i < 3; ++i) {
    const double s = saturated[static_cast<std::size_t>(i)];
    const bool within = limitedCommand(u, i) == u[kCommand + i];
    gain[i] = within ? (1.0 - s * s) * p_.frequency * p_.frequency : 0.0;
  }
  const Harmonics part = pitchAcceleration(x, u), rate = pitchRate(x, u[kSpeed]);
  for (int k = 0; k < p_.blades; ++k) {
    const double c = cosine_[k], s = sine_[k];
    jacobian(k, kCommand) = gain[0];
    jacobian(k, kCommand + 1) = gain[1] * c;
    jacobian(k, kCommand + 2) = gain[2] * s;
    jacobian(k, kAzimuth) = part.sine * c - part.cosine * s;
    jacobian(k, kSpeed) = 2.0 * (rate.sine * c - rate.cosine * s);
    jacobian(k, kHubAcceleration) = x[2] * c - x[1] * s;
    if (coupling_ != 0.0) jacobian(k, kFlap + kPitchAcceleration * p_.blades + k) = -coupling_;
  }
  return true;
}

void Swashplate::evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept {
  const auto& saturated = saturation(x);
  for (int i = 0; i < 3; ++i) {
    xdot[i] = p_.rate_limit * saturated[static_cast<std::size_t>(i)];
    xdot[3 + i] = p_.frequency * p_.frequency * (limitedCommand(u, i) - x[i]) - 2.0 * p_.damping_ratio * p_.frequency * x[3 + i];
  }
}

namespace {

/// The key `blades`, or those of the fe_rotor the plate belongs to, or the lag rotor's four.
int bladesOfPlate(Section& section, const BuildContext& context) {
  const bool has_elastic_rotor = section.has("rotor") || !context.onlySubsystemOfType("fe_rotor").empty();
  const int found = has_elastic_rotor ? sectionsOfRotor(section, context).blades : kLagBlades;
  return static_cast<int>(section.integer("blades", found, 2, BladeAzimuths::kMaxBlades));
}

}  // namespace

Made makeSwashplate(Section& section, const BuildContext& context) {
  constexpr double kDegree = 3.14159265358979323846 / 180.0;
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
  p.blades = bladesOfPlate(section, context);
  p.phase = kDegree * section.number("phase_deg", 0.0, "deg", {-180.0, 180.0, false});
  p.delta3 = kDegree * section.number("delta3_deg", 0.0, "deg", {-75.0, 75.0, false});
  section.finish();
  return std::make_unique<Swashplate>(p);
}

}  // namespace heerk_rotor
