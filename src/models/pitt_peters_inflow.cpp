#include "heerk_rotor/models/pitt_peters_inflow.hpp"

#include <cmath>

#include "heerk_rotor/models/inflow_ports.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLeastFlow = 1e-4;  // floor of VT, over Omega R: without it a still disc divides by zero

}  // namespace

std::vector<State> PittPetersInflow::states() const {
  return {{"mean", "-", "mean induced flow over Omega R, downwards positive"},
          {"sine", "-", "sine part, more flow on the right side positive"},
          {"cosine", "-", "cosine part, more flow at the tail positive"}};
}

std::vector<InputPort> PittPetersInflow::inputs() const { return inflowInputs(); }
std::vector<OutputPort> PittPetersInflow::outputs() const { return inflowOutputs({}); }

void PittPetersInflow::evalOutput(Index, double, const In& x, const In&, Out y) noexcept { y = x; }

void PittPetersInflow::evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept {
  const WindAxes wind(u[kMuForward], u[kMuLeft]);
  const double mu_z = u[kMuUp], mu = wind.mu;
  // kappa scales the induced flow that given loads hold in balance: the equations are those of nu / kappa.
  const double mean = x[0] / p_.induced_power_factor;
  double sine, cosine, sine_load, cosine_load;
  wind.toWind(x[1] / p_.induced_power_factor, x[2] / p_.induced_power_factor, sine, cosine);
  wind.toWind(u[kSineCoefficient], u[kCosineCoefficient], sine_load, cosine_load);

  const double through = mu_z + mean;
  const double total = std::sqrt(mu * mu + through * through + kLeastFlow * kLeastFlow);
  const double mass_flow = (mu * mu + through * (mu_z + 2.0 * mean)) / total;
  const double skew = halfSkewTangent(mu, through), coupling = 15.0 * kPi / 64.0 * skew;

  // L^-1 nu: the sine part stands alone, mean and cosine part form a 2x2 block with determinant (1 - X^2) + coupling^2.
  const double diagonal = 2.0 * (1.0 - skew * skew), determinant = 0.5 * diagonal + coupling * coupling;
  const double mean_load = (diagonal * mean + coupling * cosine) / determinant;
  const double cosine_balance = (-coupling * mean + 0.5 * cosine) / determinant;
  const double sine_balance = sine / (2.0 * (1.0 + skew * skew));

  const double mean_mass = p_.corrected_mass ? 128.0 / (75.0 * kPi) : 8.0 / (3.0 * kPi), harmonic_mass = 16.0 / (45.0 * kPi);
  const double rate = p_.rotor_speed * p_.induced_power_factor;
  xdot[0] = rate * (u[kThrustCoefficient] - total * mean_load) / mean_mass;
  const double sine_rate = rate * (sine_load - mass_flow * sine_balance) / harmonic_mass;
  const double cosine_rate = rate * (cosine_load - mass_flow * cosine_balance) / harmonic_mass;
  wind.toHub(sine_rate, cosine_rate, xdot[1], xdot[2]);
}

Made makePittPetersInflow(Section& section, const BuildContext& context) {
  PittPetersInflow::Parameters p;
  p.rotor_speed = context.simulation.rotor_speed;
  p.induced_power_factor = readInducedPowerFactor(section);
  p.corrected_mass = section.flag("corrected_mass", p.corrected_mass);
  acceptKeysOfAllInflowModels(section);
  section.finish();
  return std::make_unique<PittPetersInflow>(p);
}

}  // namespace heerk_rotor
