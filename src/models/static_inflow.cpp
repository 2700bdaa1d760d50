#include "heerk_rotor/models/static_inflow.hpp"

#include <cmath>

#include "heerk_rotor/models/inflow_ports.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {

std::vector<InputPort> UniformInflow::inputs() const { return inflowInputs(); }
std::vector<OutputPort> UniformInflow::outputs() const { return inflowOutputs({"rotor_loads", "hub_flow"}); }

void UniformInflow::evalOutput(Index, double, const In&, const In& u, Out y) noexcept {
  y << glauertInflow(kappa_ * u[kThrustCoefficient], std::hypot(u[kMuForward], u[kMuLeft]), u[kMuUp]), 0.0, 0.0;
}

std::vector<InputPort> DreesInflow::inputs() const { return inflowInputs(); }
std::vector<OutputPort> DreesInflow::outputs() const { return inflowOutputs({"rotor_loads", "hub_flow"}); }

void DreesInflow::evalOutput(Index, double, const In&, const In& u, Out y) noexcept {
  const WindAxes wind(u[kMuForward], u[kMuLeft]);
  const double mean = glauertInflow(kappa_ * u[kThrustCoefficient], wind.mu, u[kMuUp]);
  const double through = u[kMuUp] + mean;
  // (1 - cos chi) / sin chi = tan(chi / 2) and mu / sin chi = V: no division by sin chi, which vanishes in hover.
  const double total = std::hypot(wind.mu, through);
  const double cosine_wind = mean * 4.0 / 3.0 * (halfSkewTangent(wind.mu, through) - 1.8 * wind.mu * total);
  y[0] = mean;
  wind.toHub(-2.0 * wind.mu * mean, cosine_wind, y[1], y[2]);
}

std::vector<InputPort> PrescribedInflow::inputs() const {
  std::vector<InputPort> list = inflowInputs();
  list[0].unconnected = Unconnected::kDefault;
  list.push_back({"command", 3, "-", "induced flow over Omega R, downwards positive: mean, sine and cosine part", Unconnected::kCommand, inflow_,
      {"mean", "sine", "cosine"}});
  return list;
}
std::vector<OutputPort> PrescribedInflow::outputs() const { return inflowOutputs({"command"}); }

void PrescribedInflow::evalOutput(Index, double, const In&, const In& u, Out y) noexcept { y = u.tail(3); }

Made makeUniformInflow(Section& section, const BuildContext&) {
  const double kappa = readInducedPowerFactor(section);
  acceptKeysOfAllInflowModels(section);
  section.finish();
  return std::make_unique<UniformInflow>(kappa);
}

Made makeDreesInflow(Section& section, const BuildContext&) {
  const double kappa = readInducedPowerFactor(section);
  acceptKeysOfAllInflowModels(section);
  section.finish();
  return std::make_unique<DreesInflow>(kappa);
}

Made makePrescribedInflow(Section& section, const BuildContext&) {
  std::vector<double> inflow;
  for (const char* part : {"mean", "sine", "cosine"}) inflow.push_back(section.number(part, 0.0, "-", {-1.0, 1.0, false}));
  readInducedPowerFactor(section);  // without effect
  acceptKeysOfAllInflowModels(section);
  section.finish();
  return std::make_unique<PrescribedInflow>(inflow);
}

}  // namespace heerk_rotor
