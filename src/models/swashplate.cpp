#include "heerk_rotor/models/swashplate.hpp"

#include <algorithm>
#include <cmath>

namespace heerk_rotor {
namespace {

enum Input_ { kCommand, kAzimuth = 3, kSpeed };
enum Output_ { kPitch, kPitchRate, kPosition };
const char* const kNames[] = {"collective", "lateral_cyclic", "longitudinal_cyclic"};

}  // namespace

std::vector<State> Swashplate::states() const {
  std::vector<State> list;
  for (int i = 0; i < 3; ++i) list.push_back({kNames[i], "rad", std::string("actual ") + kNames[i], p_.trim[i]});
  for (int i = 0; i < 3; ++i) list.push_back({std::string(kNames[i]) + "_demand", "rad/s", "actuator rate asked for, before the limit"});
  return list;
}

std::vector<InputPort> Swashplate::inputs() const {
  return {{"command", 3, "rad", "collective at 0.75 R, lateral cyclic theta_1c, longitudinal cyclic theta_1s", Unconnected::kCommand,
           {p_.trim[0], p_.trim[1], p_.trim[2]}, {kNames[0], kNames[1], kNames[2]},
           {p_.collective_min, -p_.cyclic_limit, -p_.cyclic_limit}, {p_.collective_max, p_.cyclic_limit, p_.cyclic_limit}},
          hubMotionInput()};
}

std::vector<OutputPort> Swashplate::outputs() const {
  return {{"pitch", kBlades, "rad", "pitch of each blade at 0.75 R, nose up positive", {"hub_motion"}, 0.1, {}, true},
          {"pitch_rate", kBlades, "rad/s", "time derivative of the pitch", {"hub_motion"}, 1.0, {}, false},
          {"position", 3, "rad", "actual collective, lateral and longitudinal cyclic", {}, 0.1, {kNames[0], kNames[1], kNames[2]}, true}};
}

void Swashplate::evalOutput(Index port, double, const In& x, const In& u, Out y) noexcept {
  if (port == kPosition) {
    y = x.head(3);
    return;
  }
  const double s = std::sin(u[kAzimuth]), c = std::cos(u[kAzimuth]);
  const double cosine[kBlades] = {c, -s, -c, s}, sine[kBlades] = {s, c, -s, -c};
  double rate[3];
  for (int i = 0; i < 3; ++i) rate[i] = p_.rate_limit * std::tanh(x[3 + i] / p_.rate_limit);
  for (int k = 0; k < kBlades; ++k) {
    if (port == kPitch) y[k] = x[0] + x[1] * cosine[k] + x[2] * sine[k];
    else y[k] = rate[0] + (rate[1] + u[kSpeed] * x[2]) * cosine[k] + (rate[2] - u[kSpeed] * x[1]) * sine[k];
  }
}

void Swashplate::evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept {
  const double low[3] = {p_.collective_min, -p_.cyclic_limit, -p_.cyclic_limit}, high[3] = {p_.collective_max, p_.cyclic_limit, p_.cyclic_limit};
  for (int i = 0; i < 3; ++i) {
    const double command = std::clamp(u[kCommand + i], low[i], high[i]);
    xdot[i] = p_.rate_limit * std::tanh(x[3 + i] / p_.rate_limit);
    xdot[3 + i] = p_.frequency * p_.frequency * (command - x[i]) - 2.0 * p_.damping_ratio * p_.frequency * x[3 + i];
  }
}

}  // namespace heerk_rotor
