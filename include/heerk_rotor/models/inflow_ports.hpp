#pragma once
#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

/// What all inflow models share, so that one line of the configuration swaps them.
///
/// The flow through the disc at r = radius / R is, downwards positive and over Omega R,
///   lambda = mu_z + l0 + r (l1s sin psi + l1c cos psi).
/// Inputs: rotor_loads (CT, Cs, Cc: aerodynamic thrust and its first harmonics, Cs = sum int r sin psi dFz / (rho A R (Omega R)^2)),
/// hub_flow (velocity of the hub through the air in hub_link over Omega R: forward, left, up).
/// Output: inflow (l0, l1s, l1c).
std::vector<InputPort> inflowInputs();
std::vector<OutputPort> inflowOutputs(std::vector<std::string> feedthrough);

/// The key induced_power_factor, kappa: multiplies the induced flow that given loads hold in balance.
double readInducedPowerFactor(Section& section);

/// One line, `type`, swaps the inflow models: keys that only others of them have are accepted without effect.
void acceptKeysOfAllInflowModels(Section& section);

enum InflowInput { kThrustCoefficient, kSineCoefficient, kCosineCoefficient, kMuForward, kMuLeft, kMuUp };

/// In-plane flow seen along the direction of flight: wind axes are hub axes turned by the angle delta of the hub's in-plane
/// velocity about +z, so that psi_wind = psi - delta.
struct WindAxes {
  /// Without in-plane flow the angle is taken as 0: inflow models are isotropic there, and what depends on the angle vanishes
  /// with mu, so that the inflow stays smooth although the angle jumps.
  WindAxes(double forward, double left) noexcept;

  double mu;            // in-plane speed over Omega R
  double cosine, sine;  // of delta

  /// (sine part, cosine part) of a first harmonic from hub to wind axes and back.
  void toWind(double sine_part, double cosine_part, double& sine_wind, double& cosine_wind) const noexcept;
  void toHub(double sine_wind, double cosine_wind, double& sine_part, double& cosine_part) const noexcept;
};

/// tan(chi / 2) of the wake skew angle chi = atan2(mu, flow through the disc), limited to 1 (wake in the disc plane).
double halfSkewTangent(double mu, double through_flow) noexcept;

/// The root of 2 l0 sqrt(mu^2 + (mu_z + l0)^2 + eps^2) = CT (Glauert; momentum theory for climb, hover and forward flight),
/// unique outside the vortex-ring range. eps = 1e-4 keeps the slope finite at zero thrust in hover.
double glauertInflow(double thrust_coefficient, double mu, double mu_z) noexcept;

}  // namespace heerk_rotor
