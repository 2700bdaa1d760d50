// Momentum, angular momentum and energy of rotor, hub and fuselage together, along the motion after steps of the controls, the wind
// and the speed command. Rates are differenced from the momentum and energy outputs of all subsystems; what they must equal is
// computed here from the airloads of all sections, weights, landing gear, external loads and the engine. All forces between the
// subsystems (hub forces, mast torque, gyroscopic moments, pitch links) are internal: each would show if it did not cancel.
#include <gtest/gtest.h>

#include "models/coupled_instant.hpp"
#include "models/section_sums.hpp"

namespace heerk_rotor {
namespace {

using namespace test;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::operator+;  // not hidden by that of Content

constexpr double kOmega = 44.4, kGravity = 9.80665, kHubInertia = 50.0, kMastStiffness = 3e6, kMastDamping = 500.0, kFuselageMass = 1972.4;
constexpr double kPrecone = 2.5 * M_PI / 180, kEngineInertia = 300.0;
const std::string kGovernor = "subsystems.drive={type: governed_drive, inertia: 300.0, engine_torque: 3000.0, max_torque: 16000.0}";

/// Momentum and angular momentum about the origin of odom, both in odom axes, and energy.
struct Content {
  Vector3d momentum = Vector3d::Zero(), angular = Vector3d::Zero();
  double energy = 0.0;
};
Content operator+(const Content& a, const Content& b) { return {a.momentum + b.momentum, a.angular + b.angular, a.energy + b.energy}; }
Content operator*(double s, const Content& a) { return {s * a.momentum, s * a.angular, s * a.energy}; }

class Aircraft {
 public:
  explicit Aircraft(const Overrides& overrides)
      : clockwise_(std::count(overrides.begin(), overrides.end(), "subsystems.fuselage.rotation=cw") > 0),
        elastic_(std::count(overrides.begin(), overrides.end(), "subsystems.mast.type=rigid_mast") == 0),
        sprung_(std::count(overrides.begin(), overrides.end(), "subsystems.fuselage.mode=free") == 0),
        governed_(std::count(overrides.begin(), overrides.end(), kGovernor) == 1),
        now(configuration(overrides)), undamped_(configuration(overrides + Overrides{"subsystems.fuselage.gear_damping=[0, 0, 0, 0, 0, 0]"})) {
    for (const CoupledSystem::Output& output : now.system.outputs())
      if (output.name == "rotor.flap") blades_ = static_cast<int>(output.size);
  }

  /// Smooth airloads: the balances do not depend on the polar, but kinks of a table would spoil the differences.
  static Configuration configuration(const Overrides& overrides) {
    // Without the options that use them, these ports are absent.
    const bool virtual_mass = std::count(overrides.begin(), overrides.end(), "subsystems.airloads.virtual_mass=true") > 0;
    const bool governed = std::count(overrides.begin(), overrides.end(), kGovernor) > 0;
    Overrides more;
    if (virtual_mass) more = {"[rotor.section_acceleration, airloads.section_acceleration]", "[rotor.section_pitch_rate, airloads.section_pitch_rate]"};
    // With an engine of its own inertia the fuselage carries the engine's reaction in place of the mast's (mast.torque meets its engine instead).
    if (governed) more = {"[mast.torque, drive.mast_torque]", "[drive.gyroscopic_moment, fuselage.tilting_moment]", "[fuselage.mount_velocity, drive.mount_velocity]",
                          "[fuselage.mount_acceleration, drive.mount_acceleration]"};
    const std::string engine = "connections." + std::to_string(7 + more.size()) + "=[drive.torque, fuselage.mast_torque]";
    return shippedWith(more, "bo105.yaml", (governed ? Overrides{engine} : Overrides{}) + Overrides{"subsystems.airloads.polar=linear", "simulation.newton_tolerance=1e-13"} + overrides);
  }

  /// Blades' mass and first moment about the hub centre (hub axes), from how their momenta answer to a velocity of the hub.
  void bladeMass(double& mass, Vector3d& first_moment) {
    const double v = 1000.0;
    const auto answer = [&](const char* port, Index i) {
      return Vector3d((now.portWith(port, "rotor.mount_velocity", i, v) - now.port(port)).head<3>() / v);
    };
    mass = answer("rotor.blade_momentum", 0)[0];
    const Vector3d across_x = answer("rotor.angular_momentum", 0), across_y = answer("rotor.angular_momentum", 1);  // S x e_x, S x e_y
    first_moment = polar(Vector3d(across_y[2], -across_x[2], across_x[1]));
  }

  Content content() {
    const Matrix3d R = hubOrientation();
    const Vector3d hub = now.port3("fuselage.hub_position"), momentum = R * polar(now.port3("rotor.blade_momentum"));
    const double spin = now.port("mast.hub_angular_momentum")[0];
    double mass;
    Vector3d first_moment;
    bladeMass(mass, first_moment);
    Content c;
    c.momentum = now.port3("fuselage.fuselage_momentum") + momentum;
    const double engine_spin = governed_ ? now.port("drive.drive_angular_momentum")[0] : 0.0;
    c.angular = now.port3("fuselage.fuselage_angular_momentum") + hub.cross(momentum) +
                R * axial(now.port3("rotor.angular_momentum") + (spin + engine_spin) * Vector3d::UnitZ());
    const double twist = now.port("mast.twist")[0];
    c.energy = now.port("fuselage.fuselage_energy")[0] + now.port("rotor.blade_energy")[0] + 0.5 * spin * spin / kHubInertia + 0.5 * engine_spin * engine_spin / kEngineInertia +
               (elastic_ ? 0.5 * kMastStiffness * twist * twist : 0.0) + kGravity * (mass * hub[2] + (R * first_moment)[2]);
    return c;
  }

  /// What changes the content from outside; `size` sums the magnitudes of the parts.
  Content loads(double t, const Vector& x, Content& size) {
    Content sum;
    const auto add = [&](const Vector3d& force, const Vector3d& moment, double power) {
      sum = sum + Content{force, moment, power};
      size = size + Content{force.cwiseAbs(), moment.cwiseAbs(), std::abs(power)};
    };
    const Matrix3d R = hubOrientation();
    const Vector q = now.port("fuselage.fuselage_orientation");
    const Matrix3d R_OB = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    const Vector3d hub = now.port3("fuselage.hub_position"), cg = now.port3("fuselage.fuselage_position"), velocity = now.port3("fuselage.fuselage_velocity"),
                   rates = now.port3("fuselage.fuselage_rates");
    Vector3d air_force, air_moment;
    double air_power, link_power;
    airloads(air_force, air_moment, air_power, link_power);
    add(R * air_force, hub.cross(R * air_force) + R * air_moment, air_power);
    add(Vector3d::Zero(), Vector3d::Zero(), link_power);

    double mass;
    Vector3d first_moment;
    bladeMass(mass, first_moment);
    const Vector3d down(0.0, 0.0, -kGravity);
    add(kFuselageMass * down, cg.cross(kFuselageMass * down), 0.0);  // the power of weight is in the energy
    add(mass * down, (mass * hub + R * first_moment).cross(down), 0.0);

    const Vector3d force = now.w.segment<3>(commandBegin("fuselage.external_force_x")), moment = now.w.segment<3>(commandBegin("fuselage.external_moment_x"));
    add(R_OB * force, cg.cross(R_OB * force) + R_OB * moment, force.dot(velocity) + moment.dot(rates));

    if (sprung_) {
      const Vector gear = now.port("fuselage.spring_wrench");
      EXPECT_TRUE(undamped_.solve(t, x));
      const Vector dampers = gear - undamped_.port("fuselage.spring_wrench");
      const Vector3d damping_force = dampers.head<3>(), damping_moment = dampers.tail<3>();
      add(gear.head<3>(), gear.tail<3>(), damping_force.dot(R_OB * velocity) + (damping_moment - cg.cross(damping_force)).dot(R_OB * rates));
    }

    // The engine turns the drive against the fuselage, which receives the torque that the drive gives to the mast.
    const Vector motion = now.port("mast.hub_motion");
    // An engine with inertia keeps part of its torque to itself.
    const double torque = governed_ ? -now.port("drive.engine_torque")[0] : now.port("mast.torque")[0], drive_speed = motion[1] - motion[3];
    add(Vector3d::Zero(), Vector3d::Zero(), -torque * drive_speed - (elastic_ ? kMastDamping * motion[3] * motion[3] : 0.0));
    add(Vector3d::Zero(), Vector3d::Zero(), -now.port("rotor.structural_dissipation")[0]);
    return sum;
  }

  Index commandBegin(const std::string& name) const {
    const auto& names = now.system.commandNames();
    return static_cast<Index>(std::find(names.begin(), names.end(), name) - names.begin());
  }

 private:
  Vector3d polar(const Vector3d& v) const { return clockwise_ ? Vector3d(v[0], -v[1], v[2]) : v; }
  Vector3d axial(const Vector3d& v) const { return clockwise_ ? Vector3d(-v[0], v[1], -v[2]) : v; }
  Matrix3d hubOrientation() {
    const Vector q = now.port("fuselage.hub_orientation");
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
  }

  /// Of all sections, about the hub centre in hub_link, and their power; and the power of the pitch links.
  void airloads(Vector3d& force, Vector3d& moment, double& power, double& link_power) {
    const Vector motion = now.port("mast.hub_motion"), loads = now.port("airloads.section_loads"), position = now.port("rotor.section_position"),
                 velocity = now.port("rotor.section_velocity"), pitch_rate = now.port("rotor.section_pitch_rate"), root = now.port("rotor.root_load"),
                 link_rate = now.port("swashplate.pitch_rate");
    const Vector3d rates = now.port("fuselage.mount_velocity").tail<3>();
    const HubLoad sum = sumOfAirloads(motion[0], loads, position, blades_, kPrecone);
    force = polar(sum.force);
    moment = axial(sum.moment);
    const Vector3d along(std::cos(kPrecone), 0.0, std::sin(kPrecone));
    power = link_power = 0.0;
    for (int k = 0; k < blades_; ++k) {
      const Vector3d omega = fromBladeAxes(motion[0] + 2 * M_PI * k / blades_).transpose() * rates + motion[1] * Vector3d::UnitZ();
      for (Index j = 0; j < pitch_rate.size() / blades_; ++j) {
        const double *f = loads.data() + 4 * j * blades_ + k, *v = velocity.data() + 3 * j * blades_ + k;
        power += f[0] * v[0] + f[blades_] * v[blades_] + f[2 * blades_] * v[2 * blades_];
        power += f[3 * blades_] * (omega.dot(along) + pitch_rate[j * blades_ + k]);
      }
      link_power -= root.segment<3>(6 * k + 3).dot(along) * link_rate[k];
    }
  }

  bool clockwise_, elastic_, sprung_, governed_;
  int blades_ = 0;

 public:
  CoupledInstant now;

 private:
  CoupledInstant undamped_;
};

struct Case {
  const char* name;
  Overrides overrides;
};

const std::vector<Case>& cases() {
  const Overrides flying{"subsystems.fuselage.mode=free",
                         "subsystems.fuselage.initial={position_x: 3.0, position_y: -2.0, position_z: 5.0, orientation_w: 0.9, orientation_x: 0.2, orientation_y: -0.3, "
                         "orientation_z: 0.1, velocity_x: 15.0, velocity_y: -4.0, velocity_z: 2.0, rate_x: 0.3, rate_y: -0.2, rate_z: 0.4}"};
  const Overrides standing{"subsystems.fuselage.mode=spring6", "subsystems.fuselage.initial={position_z: 0.03, rate_x: 0.2, rate_z: -0.3, velocity_y: 0.4}"};
  const std::string rigid = "subsystems.mast.type=rigid_mast";
  static const std::vector<Case> list{
      {"free, elastic mast", flying},
      {"free, rigid mast, clockwise", flying + Overrides{rigid, "subsystems.fuselage.rotation=cw"}},
      {"free, five unequal blades off their axis, skew inertia",
       flying + Overrides{"subsystems.rotor.blades=5", "subsystems.rotor.mass_factor=[1.0, 1.1, 0.95, 1.02, 0.9]", "subsystems.rotor.e=0.01", "subsystems.rotor.eA=0.006",
                          "subsystems.fuselage.products_of_inertia=[50.0, 300.0, -80.0]", "subsystems.fuselage.hub_offset=[0.2, -0.1, 1.5]"}},
      {"free, engine with governor", flying + Overrides{kGovernor}},
      {"springs, elastic mast", standing},
      {"springs, rigid mast", standing + Overrides{rigid}},
      {"springs, virtual mass and lagging lift",
       standing + Overrides{"subsystems.airloads.virtual_mass=true", "subsystems.airloads.unsteady=wagner", "subsystems.airloads.angle_of_attack_point=three_quarter_chord"}}};
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
      const double errors[] = {difference.momentum.norm() / size.momentum.norm(), difference.angular.norm() / size.angular.norm(), std::abs(difference.energy) / size.energy};
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
        if (n < steps) ASSERT_TRUE(advance(*simulation, 1, aircraft.now.w));
      }
      const Content error = change + -1.0 * integral;
      const double errors[] = {error.momentum.norm() / size.momentum.norm(), error.angular.norm() / size.angular.norm(), std::abs(error.energy) / size.energy};
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
