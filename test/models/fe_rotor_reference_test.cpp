// The elastic rotor against plain dense matrices, blade by blade: the equations of BladeDynamics written out with the matrices of the beam
// room, without lanes, blocks or memory. Gradients of quadratic forms by central differences, which are exact for them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "heerk_rotor/beam/blade_modes.hpp"
#include "models/fe_rotor_fixture.hpp"

namespace heerk_rotor {
namespace {

using namespace test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kOmega = 44.4;

/// One blade at displacements d and rates v of the free degrees of freedom.
class DenseBlade {
 public:
  DenseBlade(const FeRotorParameters& p, std::size_t k) : b_(assembleBlade(p.blades[k])) {
    const BladeModes modes = bladeModes(b_, b_.stiffness(kOmega, 0, p.precone), p.modes);
    V = modes.V.cast<double>();
    damping = modes.damping;
    K0 = b_.K0.cast<double>();
    C_hinge = b_.C_hinge.cast<double>();
    G = b_.G.cast<double>();
  }

  Matrix sectionRows(double r) const { return b_.shapeRows(r).cast<double>(); }
  double mass() const { return b_.mass; }
  Vector3d firstMoment(const Vector& d) const { return b_.first_moment + linear(d) - 0.5 * quadratic(d, d); }
  Vector3d firstMomentRate(const Vector& d, const Vector& v) const { return linear(v) - quadratic(d, v); }
  Vector3d firstMomentAcceleration(const Vector& d, const Vector& v, const Vector& a) const { return linear(a) - quadratic(v, v) - quadratic(d, a); }

  Matrix3d inertia(const Vector& d) const {
    const auto form = [&](const BeamMatrix& A) { return d.dot(A.cast<double>() * d); };
    const auto line = [&](const BeamVector& f) { return f.cast<double>().dot(d); };
    Matrix3d J = b_.inertia;
    const double mean = 2 * line(b_.steady.constant) - form(b_.K1.constant), cosine = 2 * line(b_.steady.cos2) - form(b_.K1.cos2);
    const double yz = 2 * line(b_.steady.sin2) - form(b_.K1.sin2);
    J(0, 0) += 2 * line(b_.steady_x) + form(b_.P);
    J(1, 1) += mean - cosine;
    J(2, 2) += mean + cosine;
    J(0, 1) -= line(b_.inertia_rv);
    J(0, 2) -= line(b_.inertia_rw);
    J(1, 2) += yz;
    J(1, 0) = J(0, 1), J(2, 0) = J(0, 2), J(2, 1) = J(1, 2);
    return J;
  }
  /// dJ/dt: J is quadratic in d, so that a central difference over unit time is exact.
  Matrix3d inertiaRate(const Vector& d, const Vector& v) const { return 0.5 * (inertia(d + v) - inertia(d - v)); }

  Vector3d momentum(const Vector& d, const Vector& v) const {
    const auto line = [&](const BeamVector& f) { return f.cast<double>().dot(v); };
    return {line(b_.inertia_twist) - d.dot(G * v), -line(b_.inertia_rw), line(b_.inertia_rv)};
  }

  /// Generalised loads of unit accelerations of the hub, (n x 6).
  Matrix hubRows(const Vector& d) const {
    Matrix rows(d.size(), 6);
    for (Index i = 0; i < d.size(); ++i) {
      const Vector e = Vector::Unit(d.size(), i);
      rows.row(i) << firstMomentRate(d, e).transpose(), momentum(d, e).transpose();
    }
    return rows;
  }

  /// Gradient of w.J w / 2.
  Vector centrifugal(const Vector& d, const Vector3d& w) const {
    Vector load(d.size());
    for (Index i = 0; i < d.size(); ++i) load[i] = 0.5 * w.dot(inertiaRate(d, Vector::Unit(d.size(), i)) * w);
    return load;
  }

  Matrix V, K0, C_hinge, G;
  Vector damping;

 private:
  Vector3d linear(const Vector& v) const {
    return {b_.inertia_u.cast<double>().dot(v), b_.inertia_v.cast<double>().dot(v), b_.inertia_w.cast<double>().dot(v)};
  }
  Vector3d quadratic(const Vector& a, const Vector& b) const {
    return {a.dot(b_.T0.cast<double>() * b), a.dot(b_.E_v.cast<double>() * b), a.dot(b_.E_w.cast<double>() * b)};
  }

  BladeMatrices b_;
};

struct Case {
  const char* name;
  int blades;
  std::string more;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> list{{"shipped blade", 4, ", modes: 12"},
                                      {"two blades", 2, ", blades: 2, modes: 12"},
                                      {"three blades", 3, ", blades: 3, modes: 9"},
                                      {"eight blades", 8, ", blades: 8, modes: 12"},
                                      {"mass centre, tension axis and root lead", 4, ", e: 0.01, eA: 0.006, root_lead: 0.03, tip_mass: 1.5, modes: 12"},
                                      {"five unequal blades with mass centre", 5, ", blades: 5, e: 0.01, mass_factor: [1.0, 1.1, 0.95, 1.02, 1.3], modes: 12"},
                                      {"unequal blades", 4, ", mass_factor: [1.0, 1.1, 0.95, 1.02], stiffness_factor: [1.0, 0.9, 1.1, 1.05], modes: 12"},
                                      {"hinges with dampers", 4, ", flap_hinge: true, lag_hinge: true, lag_damper: 900.0, flap_damper: 50.0, modes: 12"}};
  return list;
}

TEST(FeRotorReference, accelerationsAndRootLoadsAreThoseOfDenseMatrices) {
  for (const Case& c : cases()) {
    const FeRotorParameters p = rotorParameters(bo105Rotor(c.more), kOmega);
    LoneModel rotor("fe_rotor", bo105Rotor(c.more), kOmega);
    const ModalStiff modal = std::get<ModalStiff>(rotor.model().stiffPart());
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const Index n = modal.omega.size(), modes = n / c.blades;
    Vector x(2 * n), u = rotor.defaultInput();
    for (Index i = 0; i < n; ++i) {
      const double ratio = 33.0 / std::max(33.0, modal.omega[i]);
      x[i] = 0.6 * ratio * ratio * unit(random);
      x[n + i] = 15.0 * ratio * ratio * unit(random);
    }
    const auto fill = [&](const char* port, Index size, double mean, double range) {
      for (Index i = 0; i < size; ++i) u[rotor.inputBegin(port) + i] = mean + range * unit(random);
      return Vector(u.segment(rotor.inputBegin(port), size));
    };
    const Vector hub_motion = fill("hub_motion", 2, 40.0, 3.0), mount_velocity = fill("mount_velocity", 6, 0.0, 1.0), mount = fill("mount_acceleration", 6, 3.0, 10.0);
    const Vector pitch = fill("pitch", c.blades, 0.1, 0.1), pitch_rate = fill("pitch_rate", c.blades, 0.0, 3.0), pitch_acceleration = fill("pitch_acceleration", c.blades, 0.0, 100.0);
    const double hub_acceleration = fill("hub_acceleration", 1, 0.0, 20.0)[0];
    const Index sections = static_cast<Index>(p.sections.count());
    const Vector loads = fill("section_loads", 4 * sections * c.blades, 0.0, 500.0);
    const Vector xdot = rotor.derivatives(x, u), root_load = rotor.output("root_load", x, u);

    double of_acceleration = 0.0, of_load = 0.0;
    for (int k = 0; k < c.blades; ++k) {
      const DenseBlade blade(p, static_cast<std::size_t>(k));
      Vector q(modes), rate(modes);
      for (Index i = 0; i < modes; ++i) q[i] = x[i * c.blades + k], rate[i] = x[n + i * c.blades + k];
      const Vector d = blade.V * q, v = blade.V * rate;

      // Axes: R as the azimuth stands, B from it by precone and pitch.
      const double psi = hub_motion[0] + 2 * M_PI * k / c.blades;
      Matrix3d R_RH, R_BR;
      R_RH << -std::cos(psi), -std::sin(psi), 0, std::sin(psi), -std::cos(psi), 0, 0, 0, 1;
      R_BR = Eigen::AngleAxisd(-pitch[k], Vector3d::UnitX()).toRotationMatrix() * Eigen::AngleAxisd(p.precone, Vector3d::UnitY()).toRotationMatrix();
      const Vector3d spin = hub_motion[1] * Vector3d::UnitZ(), w_R = R_RH * mount_velocity.tail<3>() + spin;
      const Vector3d alpha_R = R_RH * mount.tail<3>() + hub_acceleration * Vector3d::UnitZ() + (R_RH * mount_velocity.tail<3>()).cross(spin);
      const Vector3d lead = p.blades[0].root_lead * Vector3d::UnitY(), feathering = pitch_rate[k] * Vector3d::UnitX();
      const Vector3d w = R_BR * w_R + feathering;
      const Vector3d alpha = R_BR * alpha_R + pitch_acceleration[k] * Vector3d::UnitX() + (R_BR * w_R).cross(feathering);
      const Vector3d a = R_BR * (R_RH * mount.head<3>() + alpha_R.cross(lead) + w_R.cross(w_R.cross(lead)));

      // Airloads.
      Vector air = Vector::Zero(d.size());
      Vector3d air_force = Vector3d::Zero(), air_moment = Vector3d::Zero();
      for (Index j = 0; j < sections; ++j) {
        const double* f = loads.data() + 4 * j * c.blades + k;
        const Vector3d force = R_BR * Vector3d(f[0], f[c.blades], f[2 * c.blades]);
        const Matrix rows = blade.sectionRows(p.sections.r[static_cast<std::size_t>(j)]);
        air += rows.row(kRowV).transpose() * force.y() + rows.row(kRowW).transpose() * force.z() + rows.row(kRowTwist).transpose() * f[3 * c.blades];
        air_force += force;
        air_moment += Vector3d(p.sections.r[static_cast<std::size_t>(j)], rows.row(kRowV).dot(d), rows.row(kRowW).dot(d)).cross(force) + f[3 * c.blades] * Vector3d::UnitX();
      }

      // q'' of the modes.
      Vector hub(6);
      hub << a, alpha;
      const Vector load = air + blade.centrifugal(d, w) - 2 * w.x() * (blade.G * v) - blade.K0 * d - blade.C_hinge * v - blade.hubRows(d) * hub;
      const Vector q_acceleration = blade.V.transpose() * load - blade.damping.cwiseProduct(rate);
      Vector computed(modes);
      for (Index i = 0; i < modes; ++i) computed[i] = xdot[n + i * c.blades + k];
      of_acceleration = std::max(of_acceleration, (computed - q_acceleration).norm() / q_acceleration.norm());

      // Force and moment on the hub.
      const Vector d_acceleration = blade.V * q_acceleration;
      const Vector3d S = blade.firstMoment(d), h = blade.momentum(d, v), Jw = blade.inertia(d) * w;
      const Vector3d force = blade.mass() * a + alpha.cross(S) + 2 * w.cross(blade.firstMomentRate(d, v)) + w.cross(w.cross(S)) + blade.firstMomentAcceleration(d, v, d_acceleration);
      const Vector3d moment = blade.inertia(d) * alpha + S.cross(a) + blade.inertiaRate(d, v) * w + w.cross(Jw + h) + blade.momentum(d, d_acceleration);
      const Vector3d on_hub = R_BR.transpose() * (air_force - force), moment_on_hub = R_BR.transpose() * (air_moment - moment) + lead.cross(on_hub);
      of_load = std::max({of_load, (root_load.segment<3>(6 * k) - on_hub).norm() / on_hub.norm(), (root_load.segment<3>(6 * k + 3) - moment_on_hub).norm() / moment_on_hub.norm()});
    }
    report(std::string("modal accelerations, ") + c.name, of_acceleration);
    report(std::string("root loads, ") + c.name, of_load);
    EXPECT_LE(of_acceleration, 1e-10) << c.name;  // round-off of K0 d, whose entries exceed the sum by far
    EXPECT_LE(of_load, 1e-10) << c.name;
  }
}

}  // namespace
}  // namespace heerk_rotor
