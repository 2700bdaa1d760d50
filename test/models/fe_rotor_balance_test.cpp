// Momentum, angular momentum and energy of the elastic blades on a hub that moves in every way at once. The rates are differenced
// from the model's momentum and energy outputs along the trajectory; loads and powers come from its load outputs.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "models/fe_rotor_fixture.hpp"

namespace heerk_rotor {
namespace {

using namespace test;
using Eigen::Vector3d;

constexpr double kOmega = 44.4;

/// A hub, mount and pitch motion with all components, smooth in time, without gravity.
struct Motion {
  int blades;
  double azimuth(double t) const { return 0.3 + 41.0 * t + 2.0 * t * t; }
  double speed(double t) const { return 41.0 + 4.0 * t; }
  Vector3d velocity(double t) const { return {12 + 3 * std::sin(7 * t), -4 + 2 * std::cos(5 * t), 3 + std::sin(9 * t)}; }
  Vector3d velocityRate(double t) const { return {21 * std::cos(7 * t), -10 * std::sin(5 * t), 9 * std::cos(9 * t)}; }
  Vector3d rates(double t) const { return {0.8 * std::sin(6 * t + 1), 0.5 * std::cos(4 * t), 0.6 * std::sin(3 * t + 0.4)}; }
  Vector3d ratesRate(double t) const { return {4.8 * std::cos(6 * t + 1), -2.0 * std::sin(4 * t), 1.8 * std::cos(3 * t + 0.4)}; }
  double pitch(int k, double t) const { return 0.12 + 0.08 * std::sin(44 * t + k); }
  double pitchRate(int k, double t) const { return 0.08 * 44 * std::cos(44 * t + k); }
  double pitchAcceleration(int k, double t) const { return -0.08 * 44 * 44 * std::sin(44 * t + k); }
};

class Balance {
 public:
  Balance(const std::string& yaml, int blades) : rotor_("fe_rotor", yaml, kOmega), motion_{blades}, random_(7) {
    // A deformed state: amplitudes fall with the mode's stiffness, so that all modes carry comparable elastic forces.
    const ModalStiff modal = std::get<ModalStiff>(rotor_.model().stiffPart());
    const Index n = modal.omega.size();
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    x_ = Vector::Zero(2 * n);
    for (Index i = 0; i < n; ++i) {
      const double ratio = 33.0 / std::max(33.0, modal.omega[i]);
      x_[i] = 0.6 * ratio * ratio * unit(random_);
      x_[n + i] = 15.0 * ratio * ratio * unit(random_);
    }
    loads_ = Vector::Zero(rotor_.defaultInput().size());
    const Index begin = rotor_.inputBegin("section_loads"), end = rotor_.inputBegin("hub_acceleration");
    for (Index i = begin; i < end; ++i) loads_[i] = 500.0 * unit(random_);
    sections_ = (end - begin) / (4 * blades);
  }

  Vector input(double t) const {
    Vector u = loads_;
    u[0] = motion_.azimuth(t);
    u[1] = motion_.speed(t);
    const Index mount = rotor_.inputBegin("mount_velocity"), acceleration = rotor_.inputBegin("mount_acceleration");
    u.segment(mount, 3) = motion_.velocity(t);
    u.segment(mount + 3, 3) = motion_.rates(t);
    u.segment(acceleration, 3) = motion_.velocityRate(t) + motion_.rates(t).cross(motion_.velocity(t));
    u.segment(acceleration + 3, 3) = motion_.ratesRate(t);
    u[rotor_.inputBegin("hub_acceleration")] = 4.0;
    for (int k = 0; k < motion_.blades; ++k) {
      u[rotor_.inputBegin("pitch") + k] = motion_.pitch(k, t);
      u[rotor_.inputBegin("pitch_rate") + k] = motion_.pitchRate(k, t);
      u[rotor_.inputBegin("pitch_acceleration") + k] = motion_.pitchAcceleration(k, t);
    }
    return u;
  }

  /// d/dt of an output along the trajectory through x_ at t = 0, from values at +-e and +-2e on a third-order path.
  Vector rate(const std::string& output) {
    const double e = 2e-6;
    const Vector f0 = rotor_.derivatives(x_, input(0.0));
    const auto along = [&](double s) { return Vector(x_ + s * rotor_.derivatives(x_ + 0.5 * s * f0, input(0.5 * s))); };
    const auto value = [&](double s) { return rotor_.output(output, along(s), input(s)); };
    return (8.0 * (value(e) - value(-e)) - (value(2 * e) - value(-2 * e))) / (12.0 * e);
  }

  LoneModel rotor_;
  Motion motion_;
  std::mt19937 random_;
  Vector x_, loads_;
  Index sections_;
};

struct Case {
  const char* name;
  int blades;
  std::string more;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> list{
      {"shipped blade", 4, ""},
      {"two blades", 2, ", blades: 2"},
      {"three blades", 3, ", blades: 3"},
      {"five blades", 5, ", blades: 5"},
      {"mass centre, tension axis and root lead", 4, ", e: 0.01, eA: 0.006, root_lead: 0.03, tip_mass: 1.5"},
      {"unequal blades", 4, ", mass_factor: [1.0, 1.1, 0.95, 1.02], stiffness_factor: [1.0, 0.9, 1.1, 1.05]"},
      // All modes of a damped hinge would decay within the time over which the test differences.
      {"hinges with dampers, eight blades", 8, ", blades: 8, flap_hinge: true, lag_hinge: true, lag_damper: 900.0, flap_damper: 50.0, modes: 9"},
      {"truncated", 4, ", modes: 7"}};
  return list;
}

TEST(FeRotorBalance, rotorForceIsAirloadsLessRateOfMomentum) {
  for (const Case& c : cases()) {
    Balance b(bo105Rotor(c.more), c.blades);
    const Vector u = b.input(0.0);
    Vector3d air = Vector3d::Zero();
    for (int k = 0; k < c.blades; ++k) {
      const double psi = u[0] + 2 * M_PI * k / c.blades;
      const Vector3d out(-std::cos(psi), -std::sin(psi), 0), lead(std::sin(psi), -std::cos(psi), 0);
      for (Index j = 0; j < b.sections_; ++j) {
        const double* f = u.data() + b.rotor_.inputBegin("section_loads") + 4 * j * c.blades + k;
        air += f[0] * out + f[c.blades] * lead + f[2 * c.blades] * Vector3d::UnitZ();
      }
    }
    const Vector3d momentum = b.rotor_.output("blade_momentum", b.x_, u);
    const Vector3d expected = air - (b.rate("blade_momentum") + b.motion_.rates(0.0).cross(momentum));
    const Vector3d force = b.rotor_.output("rotor_force", b.x_, u);
    report(std::string("linear momentum, ") + c.name, (force - expected).norm() / force.norm());
    EXPECT_LE((force - expected).norm(), 2e-8 * force.norm()) << c.name;  // round-off of the differences, 1e-16 / 1e-6 of the momentum
  }
}

TEST(FeRotorBalance, rotorMomentIsAirMomentLessRateOfAngularMomentum) {
  for (const Case& c : cases()) {
    Balance b(bo105Rotor(c.more), c.blades);
    const Vector u = b.input(0.0);
    const Vector position = b.rotor_.output("section_position", b.x_, u);
    const double precone = 2.5 * M_PI / 180;
    Vector3d air = Vector3d::Zero();
    for (int k = 0; k < c.blades; ++k) {
      const double psi = u[0] + 2 * M_PI * k / c.blades;
      Eigen::Matrix3d R;
      R << -std::cos(psi), std::sin(psi), 0, -std::sin(psi), -std::cos(psi), 0, 0, 0, 1;
      for (Index j = 0; j < b.sections_; ++j) {
        const double* f = u.data() + b.rotor_.inputBegin("section_loads") + 4 * j * c.blades + k;
        const double* r = position.data() + 3 * j * c.blades + k;
        const Vector3d arm(r[0], r[c.blades], r[2 * c.blades]), force(f[0], f[c.blades], f[2 * c.blades]);
        air += R * (arm.cross(force) + f[3 * c.blades] * Vector3d(std::cos(precone), 0, std::sin(precone)));
      }
    }
    const Vector3d momentum = b.rotor_.output("blade_momentum", b.x_, u), angular = b.rotor_.output("angular_momentum", b.x_, u);
    const Vector3d expected = air - (b.rate("angular_momentum") + b.motion_.rates(0.0).cross(angular) + b.motion_.velocity(0.0).cross(momentum));
    const Vector tilt = b.rotor_.output("tilting_moment", b.x_, u);
    const Vector3d moment(tilt[0], tilt[1], b.rotor_.output("blade_reaction", b.x_, u)[0]);
    report(std::string("angular momentum, ") + c.name, (moment - expected).norm() / moment.norm());
    EXPECT_LE((moment - expected).norm(), 2e-8 * moment.norm()) << c.name;
  }
}

TEST(FeRotorBalance, energyChangesByThePowerOfHubPitchLinksAndAir) {
  for (const Case& c : cases()) {
    Balance b(bo105Rotor(c.more), c.blades);
    const Vector u = b.input(0.0);
    const Vector velocity = b.rotor_.output("section_velocity", b.x_, u), pitch_rate = b.rotor_.output("section_pitch_rate", b.x_, u);
    const Vector root = b.rotor_.output("root_load", b.x_, u);
    const double precone = 2.5 * M_PI / 180;
    double power = -b.rotor_.output("structural_dissipation", b.x_, u)[0];
    for (int k = 0; k < c.blades; ++k) {
      const double psi = u[0] + 2 * M_PI * k / c.blades;
      Eigen::Matrix3d R;
      R << -std::cos(psi), std::sin(psi), 0, -std::sin(psi), -std::cos(psi), 0, 0, 0, 1;
      const Vector3d along(std::cos(precone), 0, std::sin(precone));
      const Vector3d omega = R.transpose() * b.motion_.rates(0.0) + Vector3d(0, 0, b.motion_.speed(0.0));
      for (Index j = 0; j < b.sections_; ++j) {
        const double* f = u.data() + b.rotor_.inputBegin("section_loads") + 4 * j * c.blades + k;
        const double* v = velocity.data() + 3 * j * c.blades + k;
        power += f[0] * v[0] + f[c.blades] * v[c.blades] + f[2 * c.blades] * v[2 * c.blades];
        power += f[3 * c.blades] * (omega.dot(along) + pitch_rate[j * c.blades + k]);
      }
      const Vector3d force = root.segment(6 * k, 3), moment = root.segment(6 * k + 3, 3);
      const Vector3d hub_velocity = R.transpose() * b.motion_.velocity(0.0);
      // What the hub and the pitch link do to the blade; the link turns it about its own axis, which passes through the root lead.
      const double lead = c.more.find("root_lead") != std::string::npos ? 0.03 : 0.0;
      const Vector3d about_axis = moment - Vector3d(0, lead, 0).cross(force);
      power -= force.dot(hub_velocity) + moment.dot(omega) + about_axis.dot(along) * b.motion_.pitchRate(k, 0.0);
    }
    const double rate = b.rate("blade_energy")[0];
    report(std::string("power, ") + c.name, (rate - power) / std::abs(power));
    EXPECT_NEAR(rate, power, 1e-7 * std::abs(power)) << c.name;
  }
}

}  // namespace
}  // namespace heerk_rotor
