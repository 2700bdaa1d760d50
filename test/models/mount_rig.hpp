#pragma once
#include <Eigen/Geometry>

#include "models/rotor_runs.hpp"

/// A mount alone, as simulation or as bare model: what the tests of the mount share.
namespace heerk_rotor::test {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// A configuration of nothing but `fuselage`, of type mount, with these parameters ("mode: free, mass: 10").
inline Configuration loneMount(const std::string& parameters, double step = 1e-3, const Overrides& overrides = {}) {
  return Configuration::parse("simulation: {rotor_speed: 44.4, integrator: HEERK4, step: " + std::to_string(step) + "}\nsubsystems:\n  fuselage: {type: mount, " + parameters + "}\n",
                              "lone_mount.yaml", overrides);
}

/// A mount whose inputs are given by hand: u = rotor_force, tilting_moment, mast_torque, external force and moment, wind.
struct BareMount {
  explicit BareMount(const std::string& parameters) : system(buildSystem(loneMount(parameters))), x(system.initialState()), u(Vector::Zero(system.inputSize())) {}

  Vector output(const std::string& port) {
    for (std::size_t i = 0; i < system.outputs().size(); ++i) {
      if (system.outputs()[i].name != "fuselage." + port) continue;
      Vector y = Vector::Zero(system.outputs()[i].size);
      system.evalOutput(static_cast<Index>(i), 0.0, x, u, y.data());
      return y;
    }
    throw std::out_of_range("no port " + port);
  }
  Vector derivatives() {
    Vector xdot(x.size());
    system.evalRemainder(0.0, x, u, true, xdot.data());
    return xdot;
  }

  CoupledSystem system;
  Vector x, u;
};

/// Entries of the body modes' state.
enum BodyState { kPosition, kOrientation = 3, kVelocity = 7, kRates = 10, kBodyStates = 13 };

inline std::vector<std::string> signals(const std::string& prefix, const std::vector<std::string>& entries) {
  std::vector<std::string> names;
  for (const std::string& entry : entries) names.push_back("fuselage." + prefix + "_" + entry);
  return names;
}
inline std::vector<std::string> xyz(const std::string& prefix) { return signals(prefix, {"x", "y", "z"}); }
inline std::vector<std::string> wxyz(const std::string& prefix) { return signals(prefix, {"w", "x", "y", "z"}); }

inline Quaterniond quaternionOf(const Vector& wxyz) { return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]}; }

inline Quaterniond turn(double angle, const Vector3d& axis) { return Quaterniond(Eigen::AngleAxisd(angle, axis)); }

/// Angle between two orientations.
inline double angleBetween(const Quaterniond& a, const Quaterniond& b) { return 2.0 * (a.conjugate() * b).vec().norm(); }

}  // namespace heerk_rotor::test
