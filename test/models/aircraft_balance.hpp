#pragma once
#include "models/coupled_instant.hpp"
#include "models/section_sums.hpp"

/// Momentum, angular momentum and energy of the complete Bo105: rotor, hub, engine and fuselage together.
namespace heerk_rotor::test::aircraft_balance {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::operator+;  // not hidden by that of Content

constexpr double kGravity = 9.80665, kHubInertia = 50.0, kMastStiffness = 3e6, kMastDamping = 500.0, kFuselageMass = 1972.4;
constexpr double kPrecone = 2.5 * M_PI / 180, kEngineInertia = 300.0;
inline const std::string kGovernor = "subsystems.drive={type: governed_drive, inertia: 300.0, engine_torque: 3000.0, max_torque: 16000.0}";

/// Momentum and angular momentum about the origin of odom, both in odom axes, and energy.
struct Content {
  Vector3d momentum = Vector3d::Zero(), angular = Vector3d::Zero();
  double energy = 0.0;
};
inline Content operator+(const Content& a, const Content& b) { return {a.momentum + b.momentum, a.angular + b.angular, a.energy + b.energy}; }
inline Content operator*(double s, const Content& a) { return {s * a.momentum, s * a.angular, s * a.energy}; }

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
    if (virtual_mass) more = {"[rotor.section_acceleration, airloads.section_acceleration]",
        "[rotor.section_pitch_rate, airloads.section_pitch_rate]"};
    // With an engine of its own inertia the fuselage carries the engine's reaction in place of the mast's (mast.torque meets its engine instead).
    if (governed) more = {"[mast.torque, drive.mast_torque]", "[drive.gyroscopic_moment, fuselage.tilting_moment]",
        "[fuselage.mount_velocity, drive.mount_velocity]",
                          "[fuselage.mount_acceleration, drive.mount_acceleration]"};
    const std::string engine = "connections." + std::to_string(7 + more.size()) + "=[drive.torque, fuselage.mast_torque]";
    return shippedWith(more, "bo105.yaml", (governed ? Overrides{engine} : Overrides{}) + Overrides{"subsystems.airloads.polar=linear",
        "simulation.newton_tolerance=1e-13"} + overrides);
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
    c.energy = now.port("fuselage.fuselage_energy")[0] + now.port("rotor.blade_energy")[0] + 0.5 * spin * spin / kHubInertia +
        0.5 * engine_spin * engine_spin / kEngineInertia +
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
    const Vector3d hub = now.port3("fuselage.hub_position"), cg = now.port3("fuselage.fuselage_position"),
        velocity = now.port3("fuselage.fuselage_velocity"),
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

    const Vector3d force = now.w.segment<3>(commandBegin("fuselage.external_force_x")),
        moment = now.w.segment<3>(commandBegin("fuselage.external_moment_x"));
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

}  // namespace heerk_rotor::test::aircraft_balance
