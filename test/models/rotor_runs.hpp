#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/models/lag_rotor_parameters.hpp"

/// Running shipped configurations and reading their signals: what the tests of the models share.
namespace heerk_rotor::test {

using Overrides = std::vector<std::string>;

/// config/<name> with overrides "key=value", from its initial values: the trimmed start belongs to the unchanged configuration.
inline Configuration shipped(const std::string& name, Overrides overrides = {}) {
  overrides.insert(overrides.begin(), "simulation.start=none");
  return Configuration::load(std::string(HEERK_SOURCE_DIR) + "/config/" + name, overrides);
}

/// The same with further connections "[from, to]".
inline Configuration shippedWith(const std::vector<std::string>& connections, const std::string& name, Overrides overrides) {
  overrides.insert(overrides.begin(), "simulation.start=none");
  const std::string path = std::string(HEERK_SOURCE_DIR) + "/config/" + name, head = "\nconnections:\n";
  std::ifstream file(path);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t at = text.find(head);
  if (at == std::string::npos) throw std::runtime_error(path + " has no connections");
  for (const std::string& connection : connections) text.insert(at + head.size(), "  - " + connection + "\n");
  return Configuration::parse(text, path, overrides);
}

inline Overrides operator+(Overrides a, const Overrides& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// "key=value" with all digits.
inline std::string set(const std::string& key, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.17g", value);
  return key + "=" + text;
}

/// A measured number, into the log and into the XML report.
inline void report(const std::string& name, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.6g", value);
  std::printf("[ MEASURED ] %s = %s\n", name.c_str(), text);
  std::string key = name;
  for (char& c : key)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  testing::Test::RecordProperty(key, text);
}

/// A writable vector as a read-only view (view() alone would make it writable).
inline In in(const Vector& v) { return view(v); }

/// Picks named signals out of (x, y).
class SignalReader {
 public:
  SignalReader(const CoupledSystem& system, const std::vector<std::string>& names) {
    for (const std::string& name : names) signals_.push_back(system.signal(name));
  }
  std::size_t size() const { return signals_.size(); }
  double operator()(std::size_t i, const Vector& x, const Vector& y) const noexcept {
    return signals_[i].kind == Signal::Kind::kState ? x[signals_[i].index] : y[signals_[i].index];
  }

 private:
  std::vector<Signal> signals_;
};

/// Keeps named signals of every instant (or of every n-th step), row by row.
class Recorder : public Observer {
 public:
  Recorder(Simulation& simulation, const std::vector<std::string>& names, std::uint64_t every = 1)
      : reader_(simulation.system(), names), every_(every) {
    simulation.addObserver(*this);
  }
  bool wants(std::uint64_t step) const noexcept override { return step % every_ == 0; }
  void observe(const Sample& sample) noexcept override {
    if (!t.empty() && t.back() == sample.t) return;  // an instant is shown again when it is only looked at
    t.push_back(sample.t);
    Vector row(static_cast<Index>(reader_.size()));
    for (std::size_t i = 0; i < reader_.size(); ++i) row[static_cast<Index>(i)] = reader_(i, sample.x, sample.y);
    rows.push_back(row);
  }

  std::vector<double> t;
  std::vector<Vector> rows;

 private:
  SignalReader reader_;
  std::uint64_t every_;
};

/// n steps with the command w; false when one failed.
inline bool advance(Simulation& simulation, long n, const Vector& w) {
  for (long i = 0; i < n; ++i)
    if (simulation.step(w) != StepStatus::kOk) return false;
  return true;
}
inline bool advance(Simulation& simulation, long n) { return advance(simulation, n, simulation.system().defaultCommand()); }

/// Named signals at the present instant.
inline Vector look(Simulation& simulation, const std::vector<std::string>& names, const Vector& w) {
  struct Once : Observer {
    void observe(const Sample& sample) noexcept override {
      if (!active) return;
      for (std::size_t i = 0; i < reader->size(); ++i) values[static_cast<Index>(i)] = (*reader)(i, sample.x, sample.y);
    }
    const SignalReader* reader = nullptr;
    Vector values;
    bool active = true;
  };
  // The simulation keeps a pointer to every observer for good, so this one must outlive it.
  static std::vector<std::unique_ptr<Once>> keep;
  keep.push_back(std::make_unique<Once>());
  Once& once = *keep.back();
  const SignalReader reader(simulation.system(), names);
  once.reader = &reader;
  once.values = Vector::Zero(static_cast<Index>(names.size()));
  simulation.addObserver(once);
  EXPECT_EQ(simulation.observe(w), StepStatus::kOk);
  once.active = false;
  return once.values;
}
inline Vector look(Simulation& simulation, const std::vector<std::string>& names) {
  return look(simulation, names, simulation.system().defaultCommand());
}

/// The 14 states of the ODE form (lag_rotor.md): x, y, phi_1..4, twist, then their rates.
inline const std::vector<std::string>& paperState() {
  static const std::vector<std::string> names{
      "rotor.fuselage_x", "rotor.fuselage_y", "rotor.lag_1", "rotor.lag_2", "rotor.lag_3", "rotor.lag_4", "mast.twist",
      "rotor.fuselage_x_rate", "rotor.fuselage_y_rate", "rotor.lag_rate_1", "rotor.lag_rate_2", "rotor.lag_rate_3", "rotor.lag_rate_4", "mast.twist_rate"};
  return names;
}

inline const CoupledSystem::Subsystem& subsystem(const CoupledSystem& system, const std::string& name) {
  for (const CoupledSystem::Subsystem& s : system.subsystems())
    if (s.name == name) return s;
  throw std::out_of_range("no subsystem " + name);
}

/// Writes the 14 states of the ODE form into a state vector with subsystems `rotor` and `mast`; g = 0 for `printed`,
/// LagRotorConstants::g for `absolute_lag` (its blade states are phi + g twist).
inline void putPaperState(const CoupledSystem& system, const Vector& paper, double g, Vector& x) {
  const Index rotor = subsystem(system, "rotor").x_begin, mast = subsystem(system, "mast").x_begin;
  for (Index half = 0; half < 2; ++half) {
    const Index from = 7 * half, to = rotor + 6 * half;
    x.segment(to, 2) = paper.segment(from, 2);
    x.segment(to + 2, 4) = paper.segment(from + 2, 4).array() + g * paper[from + 6];
    x[mast + half] = paper[from + 6];
  }
}

/// x' = F(t, x): the coupled system with its algebraic part solved.
class ReducedOde {
 public:
  explicit ReducedOde(const Configuration& configuration, double tolerance = 1e-13)
      : system(buildSystem(configuration)), w(system.defaultCommand()),
        solver_(system, SolverOptions{tolerance, 30, true}, 0.0, system.initialState(), w) {}

  Vector operator()(double t, const Vector& x) {
    EXPECT_EQ(solver_.solve(t, x, w).status, SolveStatus::kConverged);
    Vector xdot(x.size());
    system.evalRemainder(t, x, solver_.u(), true, xdot.data());
    return xdot;
  }

  /// Central differences; `step` per state.
  Matrix jacobian(double t, const Vector& x, double step) {
    Matrix result(x.size(), x.size());
    for (Index j = 0; j < x.size(); ++j) {
      Vector up = x, down = x;
      up[j] += step;
      down[j] -= step;
      result.col(j) = ((*this)(t, up) - (*this)(t, down)) / (2.0 * step);
    }
    return result;
  }

  CoupledSystem system;
  Vector w;

 private:
  AlgebraicSolver solver_;
};

}  // namespace heerk_rotor::test
