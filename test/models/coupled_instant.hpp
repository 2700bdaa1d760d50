#pragma once
#include <Eigen/Geometry>

#include "models/rotor_runs.hpp"

namespace heerk_rotor::test {

/// A coupled system with its algebraic part solved at chosen (t, x), to look at any port and at x'.
class CoupledInstant {
 public:
  explicit CoupledInstant(const Configuration& configuration, double tolerance = 1e-13)
      : system(buildSystem(configuration)), w(system.defaultCommand()), solver_(system, SolverOptions{tolerance, 30, true}, 0.0,
          system.initialState(), w) {}

  /// False when the algebraic part has no solution.
  bool solve(double t, const Vector& x) {
    t_ = t;
    x_ = x;
    return solver_.solve(t, x, w).status == SolveStatus::kConverged;
  }
  /// x' at what was solved last.
  Vector derivatives() {
    Vector xdot(x_.size());
    system.evalRemainder(t_, x_, solver_.u(), true, xdot.data());
    return xdot;
  }

  /// An output port ("rotor.rotor_force"), published or not.
  Vector port(const std::string& name) { return valueOf(output(name), solver_.u()); }

  /// The same when entry i of an input port of its subsystem were larger by `change`; nothing else reacts.
  Vector portWith(const std::string& name, const std::string& input, Index i, double change) {
    Vector u = solver_.u();
    for (const CoupledSystem::Input& candidate : system.inputs())
      if (candidate.name == input) u[candidate.begin + i] += change;
    return valueOf(output(name), u);
  }

  Eigen::Vector3d port3(const std::string& name) { return port(name).head<3>(); }
  void command(const std::string& name, double value) {
    for (std::size_t i = 0; i < system.commandNames().size(); ++i)
      if (system.commandNames()[i] == name) {
        w[static_cast<Index>(i)] = value;
        return;
      }
    throw std::out_of_range("no command " + name);
  }

  CoupledSystem system;
  Vector w;

 private:
  Index output(const std::string& name) const {
    for (std::size_t i = 0; i < system.outputs().size(); ++i)
      if (system.outputs()[i].name == name) return static_cast<Index>(i);
    throw std::out_of_range("no output " + name);
  }
  Vector valueOf(Index output, const Vector& u) {
    Vector value = Vector::Zero(system.outputs()[static_cast<std::size_t>(output)].size);
    system.evalOutput(output, t_, x_, u, value.data());
    return value;
  }

  double t_ = 0.0;
  Vector x_;
  AlgebraicSolver solver_;
};

}  // namespace heerk_rotor::test
