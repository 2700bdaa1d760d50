// Momentum, angular momentum and energy of rotor, hub and fuselage together, along the motion after steps of the controls, the wind
// and the speed command. Rates are differenced from the momentum and energy outputs of all subsystems; what they must equal is
// computed here from the airloads of all sections, weights, landing gear, external loads and the engine. All forces between the
// subsystems (hub forces, mast torque, gyroscopic moments, pitch links) are internal: each would show if it did not cancel.
#include <gtest/gtest.h>

#include "models/aircraft_balance.hpp"

namespace heerk_rotor {
namespace {

using namespace test;
using namespace aircraft_balance;

struct Case {
  const char* name;
  Overrides overrides;
};

const std::vector<Case>& cases() {
  const Overrides flying{"subsystems.fuselage.mode=free",
                         "subsystems.fuselage.initial={position_x: 3.0, position_y: -2.0, position_z: 5.0, orientation_w: 0.9, orientation_x: 0.2, orientation_y: -0.3, "
                         "orientation_z: 0.1, velocity_x: 15.0, velocity_y: -4.0, velocity_z: 2.0, rate_x: 0.3, rate_y: -0.2, rate_z: 0.4}"};
  const Overrides standing{"subsystems.fuselage.mode=spring6",
      "subsystems.fuselage.initial={position_z: 0.03, rate_x: 0.2, rate_z: -0.3, velocity_y: 0.4}"};
  const std::string rigid = "subsystems.mast.type=rigid_mast";
  static const std::vector<Case> list{
      {"free, elastic mast", flying},
      {"free, rigid mast, clockwise", flying + Overrides{rigid, "subsystems.fuselage.rotation=cw"}},
      {"free, five unequal blades off their axis, skew inertia",
       flying + Overrides{"subsystems.rotor.blades=5", "subsystems.rotor.mass_factor=[1.0, 1.1, 0.95, 1.02, 0.9]", "subsystems.rotor.e=0.01",
           "subsystems.rotor.eA=0.006",
                          "subsystems.fuselage.products_of_inertia=[50.0, 300.0, -80.0]", "subsystems.fuselage.hub_offset=[0.2, -0.1, 1.5]"}},
      {"free, engine with governor", flying + Overrides{kGovernor}},
      {"springs, elastic mast", standing},
      {"springs, rigid mast", standing + Overrides{rigid}},
      {"springs, virtual mass and lagging lift",
       standing + Overrides{"subsystems.airloads.virtual_mass=true", "subsystems.airloads.unsteady=wagner",
           "subsystems.airloads.angle_of_attack_point=three_quarter_chord"}}};
  return list;
}

TEST(CoupledBalance, momentumAndEnergyOfTheAircraftChangeByOutsideLoadsOnly) {
  double worst[3] = {};
  for (const Case& c : cases()) {
    const Overrides& overrides = c.overrides;
    Aircraft aircraft(overrides);
    auto simulation = buildSimulation(Aircraft::configuration(overrides));
    for (int stage = 0; stage < 4; ++stage) {
      // Steps of everything that can be commanded; the instants lie within the transients that follow.
      if (stage == 1) {
        aircraft.now.command("swashplate.collective", 0.17);
        aircraft.now.command("fuselage.wind_x", -25.0);
        aircraft.now.command("fuselage.wind_y", 6.0);
        aircraft.now.command("fuselage.wind_z", 2.0);
      }
      if (stage == 2) {
        aircraft.now.command("swashplate.lateral_cyclic", 0.03);
        aircraft.now.command("swashplate.longitudinal_cyclic", -0.05);
        aircraft.now.command("drive.speed", 42.0);
      }
      if (stage == 3) {
        aircraft.now.command("fuselage.external_force_y", 3000.0);
        aircraft.now.command("fuselage.external_moment_z", -2000.0);
        aircraft.now.command("fuselage.external_moment_x", 1500.0);
      }
      ASSERT_TRUE(advance(*simulation, 37, aircraft.now.w)) << c.name << ": " << simulation->failure().cause;

      const double t = simulation->modelTime(), e = 2e-6;
      const Vector x = simulation->state();
      ASSERT_TRUE(aircraft.now.solve(t, x));
      const Vector f = aircraft.now.derivatives();
      // Content at t + s on a path through x whose error is s^3 f'' / 24 and odd in s, which the five-point formula removes.
      const auto contentAt = [&](double s) {
        EXPECT_TRUE(aircraft.now.solve(t + 0.5 * s, x + 0.5 * s * f));
        const Vector ahead = x + s * aircraft.now.derivatives();
        EXPECT_TRUE(aircraft.now.solve(t + s, ahead));
        return aircraft.content();
      };
      const Content near = contentAt(e) + -1.0 * contentAt(-e), far = contentAt(2 * e) + -1.0 * contentAt(-2 * e);
      const Content rate = 1.0 / (12.0 * e) * (8.0 * near + -1.0 * far);
      ASSERT_TRUE(aircraft.now.solve(t, x));
      Content size;
      const Content difference = rate + -1.0 * aircraft.loads(t, x, size);
      const double errors[] = {difference.momentum.norm() / size.momentum.norm(), difference.angular.norm() / size.angular.norm(),
          std::abs(difference.energy) / size.energy};
      for (int i = 0; i < 3; ++i) {
        worst[i] = std::max(worst[i], errors[i]);
        const char* const names[] = {"momentum", "angular momentum", "energy"};
        // Round-off of the differences: some 1e-16 of 1e5 N s, 1e6 N m s, 1e7 J over 2e-6 s, against 1e5 N, 1e5 N m, 1e5 W that act.
        const double bounds[] = {1e-9, 1e-9, 1e-8};
        EXPECT_LE(errors[i], bounds[i]) << names[i] << ", " << c.name << ", stage " << stage;
      }
    }
  }
  report("linear momentum, relative to the loads", worst[0]);
  report("angular momentum, relative to the moments", worst[1]);
  report("energy, relative to the powers", worst[2]);
}

/// The same for what the integrator makes of it: change of the content over a stretch of a simulated transient against the integral of the loads
/// (Boole's rule, order 6, at the steps).
TEST(CoupledBalance, simulatedMotionKeepsTheBalanceToTheOrderOfTheMethod) {
  for (const Case& c : {cases()[0], cases()[4]}) {
    double previous[3] = {};
    for (const double step : {0.2, 0.1}) {
      const Overrides overrides = c.overrides + Overrides{set("simulation.azimuth_step_deg", step)};
      Aircraft aircraft(overrides);
      auto simulation = buildSimulation(Aircraft::configuration(overrides));
      ASSERT_TRUE(advance(*simulation, std::lround(60 / step), aircraft.now.w));
      aircraft.now.command("swashplate.collective", 0.17);
      aircraft.now.command("swashplate.longitudinal_cyclic", -0.05);
      aircraft.now.command("fuselage.wind_x", -25.0);
      aircraft.now.command("drive.speed", 42.0);
      ASSERT_TRUE(advance(*simulation, std::lround(4 / step), aircraft.now.w));

      const long steps = std::lround(24 / step);
      const double boole[] = {14.0, 32.0, 12.0, 32.0};  // of 4 h / 90 2/4, ends of the stretch 7
      Content change, integral, size;
      for (long n = 0; n <= steps; ++n) {
        const double t = simulation->modelTime();
        ASSERT_TRUE(aircraft.now.solve(t, simulation->state()));
        if (n == 0) change = -1.0 * aircraft.content();
        if (n == steps) change = change + aircraft.content();
        const double weight = (n == 0 || n == steps ? 7.0 : boole[n % 4]) * 4.0 * simulation->stepSize() / 90.0;
        Content magnitude;
        integral = integral + weight * aircraft.loads(t, simulation->state(), magnitude);
        size = size + weight * magnitude;
        if (n == steps) break;
        ASSERT_TRUE(advance(*simulation, 1, aircraft.now.w));
      }
      const Content error = change + -1.0 * integral;
      const double errors[] = {error.momentum.norm() / size.momentum.norm(), error.angular.norm() / size.angular.norm(),
          std::abs(error.energy) / size.energy};
      const char* const names[] = {"momentum", "angular momentum", "energy"};
      for (int i = 0; i < 3; ++i) {
        report(std::string(names[i]) + ", " + c.name + ", step [deg] " + std::to_string(step), errors[i]);
        if (step < 0.2) {
          EXPECT_LE(errors[i], std::max(previous[i] / 10.0, 1e-9)) << names[i] << ", " << c.name;  // order 4: 16; or round-off of the contents
          EXPECT_LE(errors[i], 1e-7) << names[i] << ", " << c.name;
        }
        previous[i] = errors[i];
      }
    }
  }
}

}  // namespace
}  // namespace heerk_rotor
