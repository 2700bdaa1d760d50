// Airloads and induced flow as they meet in the algebraic loop: momentum theory holds at every instant, and the rotor with ideal twist has the
// inflow and the thrust of blade-element momentum theory (Gessow & Myers, 4; Leishman, 3.3).
#include <gtest/gtest.h>

#include "models/flapping_rotor.hpp"
#include "models/section_sums.hpp"

namespace heerk_rotor {
namespace {

using namespace test;
using namespace flapping_rotor;

TEST(RotorInflowLoop, uniformInflowIsGlauertsAtEveryInstant) {
  for (const char* wind : {"[0, 0, 0]", "[-10.0, 3.0, 0]", "[-45.0, 5.0, -2.0]"}) {
    const double kappa = 1.1;
    auto simulation = buildSimulation(shipped("bo105.yaml", {"subsystems.inflow.type=uniform_inflow", set("subsystems.inflow.induced_power_factor",
        kappa), "simulation.newton_tolerance=1e-13",
                                                             std::string("subsystems.fuselage.wind=") + wind,
                                                                 "subsystems.swashplate.trim_longitudinal_cyclic=-0.03"}));
    PortRecorder ports(*simulation, {"airloads.rotor_loads", "airloads.hub_flow", "inflow.inflow"});
    ASSERT_TRUE(advance(*simulation, 360)) << simulation->failure().cause;
    double worst = 0.0, least = 1.0, most = 0.0;
    for (const std::vector<Vector>& row : ports.rows) {
      const double thrust = row[0][0], l0 = row[2][0], mu = std::hypot(row[1][0], row[1][1]), through = row[1][2] + l0,
          floor = 1e-4;  // of the model, see inflow_ports.hpp
      worst = std::max(worst, std::abs(2 * l0 * std::sqrt(mu * mu + through * through + floor * floor) - kappa * thrust));
      least = std::min(least, thrust);
      most = std::max(most, thrust);
    }
    report(std::string("momentum theory, residual over largest CT, wind ") + wind, worst / most);
    EXPECT_GT(most - least, 3e-4) << "a motion that tests the loop";
    // Newton tolerance 1e-13 of the outputs' nominal size, which is that of CT and l0; required 1e-10.
    EXPECT_LE(worst, 1e-11 * most);
  }
}

TEST(RotorInflowLoop, idealTwistHasTheInflowOfBladeElementMomentumTheory) {
  const double tip_pitch = 0.08;
  // Pitch theta_tip R / r at the Gauss points of the sections, where the twist table has its stations.
  const double node = 0.5 * std::sqrt(0.6), points[] = {0.5 - node, 0.5, 0.5 + node};
  std::string stations = "[0.0", twist = "[0.0";
  for (const double r : points) {
    stations += ", " + digits(r * kR);
    twist += ", " + digits(tip_pitch / r * 180 / M_PI);
  }
  Overrides overrides = flapping(0.0, Controls{});
  // The same blade with a table of twist.
  overrides.erase(std::remove_if(overrides.begin(), overrides.end(),
      [](const std::string& o) { return o.find("subsystems.rotor.") == 0 || o.find("subsystems.inflow.") == 0; }), overrides.end());
  overrides.push_back("subsystems.rotor={type: fe_rotor, blades: 2, kinematics: small_angle, nodes: [0.0, 2.0, 4.91], stations: " + stations +
      ", 4.91], twist_deg: " + twist +
                      ", 0.0], mass: " + digits(kMass) +
                          ", EI_flap: 1.0e+13, EI_lag: 1.0e+13, GJ: 1.0e+13, km1: 0.0, flap_hinge: true, modes: 1, sections: 3, section_rule: gauss}");
  overrides.push_back("subsystems.inflow={type: uniform_inflow}");
  auto simulation = buildSimulation(shipped("bo105.yaml", overrides));
  // Coning decays with less than gamma/16 per rad, because the inflow gives way to it: 20 revolutions are enough for the last digit.
  ASSERT_TRUE(advance(*simulation, 7200)) << simulation->failure().cause;
  PortRecorder ports(*simulation, {"airloads.rotor_loads", "inflow.inflow", "airloads.angle_of_attack"});
  ASSERT_TRUE(advance(*simulation, 1));
  const Vector &loads = ports.rows[0][0], &inflow = ports.rows[0][1], &alpha = ports.rows[0][2];

  const double chord = kLock * kInertia / (kRho * kSlope * std::pow(kR, 4)), solidity = 2 * chord / (M_PI * kR), sa = solidity * kSlope;
  const double lambda = sa / 16 * (std::sqrt(1 + 32 * tip_pitch / sa) - 1), thrust = sa / 4 * (tip_pitch - lambda);
  report("inflow of ideal twist, relative error", inflow[0] / lambda - 1);
  report("thrust of ideal twist, relative error", loads[0] / thrust - 1);
  // The floor 1e-4 of the flow adds half its square over l0^2: 1e-6. With it removed from the comparison, the loop is exact.
  const double floor = 0.5 * (1e-4 / lambda) * (1e-4 / lambda);
  EXPECT_NEAR(inflow[0], lambda, floor * lambda);
  EXPECT_NEAR(loads[0], thrust, floor * thrust);
  EXPECT_NEAR(2 * inflow[0] * std::hypot(inflow[0], 1e-4), sa / 4 * (tip_pitch - inflow[0]), 1e-11 * thrust);
  for (int j = 0; j < 3; ++j)  // alpha r is the same everywhere: the circulation of ideal twist is uniform
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(alpha[2 * j + k] * points[j], tip_pitch - inflow[0], 1e-12) << "section " << j + 1;
}

}  // namespace
}  // namespace heerk_rotor
