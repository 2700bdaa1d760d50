#include "heerk_rotor/core/coupled_system.hpp"

#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "heerk_rotor/core/nearest_name.hpp"

namespace heerk_rotor {

const Signal* CoupledSystem::findSignal(const std::string& name) const {
  for (const Signal& signal : signals_)
    if (signal.name == name) return &signal;
  return nullptr;
}

const Signal& CoupledSystem::signal(const std::string& name) const {
  if (const Signal* found = findSignal(name)) return *found;
  std::vector<std::string> known;
  for (const Signal& signal : signals_) known.push_back(signal.name);
  throw std::out_of_range("no signal " + name + didYouMean(name, known));
}

Vector CoupledSystem::initialState() const {
  Vector x = declared_initial_;
  Vector u = Vector::Zero(u_size_), y = Vector::Zero(y_size_);
  // Each model may use what the others' initial states determine: sweep until nothing changes. Values in algebraic loops
  // are not solved here and stay meaningless.
  for (const Subsystem& s : subsystems_) {
    for (std::size_t sweep = 0; sweep <= outputs_.size(); ++sweep) {
      const Vector before = y;
      for (Index i = 0; i < static_cast<Index>(inputs_.size()); ++i) gather(i, y, default_command_, u);
      for (const Output& output : outputs_) {
        const Subsystem& owner = subsystems_[output.subsystem];
        owner.model->evalOutput(output.port, 0.0, In(x.data() + owner.x_begin, owner.x_size), In(u.data() + owner.u_begin, owner.u_size),
                                Out(y.data() + output.begin, output.size));
      }
      if (y == before) break;
    }
    s.model->completeInitialState(In(u.data() + s.u_begin, s.u_size), Out(x.data() + s.x_begin, s.x_size));
  }
  for (const auto& [entry, value] : start_) x[entry] = value;
  return x;
}

std::vector<std::string> CoupledSystem::stateNames() const {
  std::vector<std::string> names;
  for (const Subsystem& s : subsystems_)
    for (const State& state : s.model->states()) names.push_back(s.name + "." + state.name);
  return names;
}

std::vector<std::string> CoupledSystem::stateUnits() const {
  std::vector<std::string> units;
  for (const Subsystem& s : subsystems_)
    for (const State& state : s.model->states()) units.push_back(state.unit);
  return units;
}

void CoupledSystem::setStart(std::vector<std::pair<Index, double>> states, const Vector& command) {
  if (command.size() != commandSize()) throw std::invalid_argument("CoupledSystem::setStart: " + std::to_string(command.size()) + " commands, expected " + std::to_string(commandSize()));
  start_ = std::move(states);
  default_command_ = command;
}

bool CoupledSystem::gather(Index number, const Vector& y, const Vector& w, Vector& u) const noexcept {
  const Input& input = inputs_[number];
  double* target = u.data() + input.begin;
  const std::size_t sources = input.source_begin.size();
  const double* first = sources > 0 ? y.data() + input.source_begin[0]
                                    : input.command >= 0 ? w.data() + input.command : input.default_value.data();
  if (sources <= 1) {
    std::uint64_t changed = 0;  // bits; inputs are short, library calls would cost more than they do
    for (Index i = 0; i < input.size; ++i) {
      std::uint64_t before, after;
      std::memcpy(&before, target + i, sizeof before);
      std::memcpy(&after, first + i, sizeof after);
      changed |= before ^ after;
      target[i] = first[i];
    }
    return changed != 0;
  }
  bool changed = false;
  for (Index i = 0; i < input.size; ++i) {
    double sum = first[i];
    for (std::size_t k = 1; k < sources; ++k) sum += y[input.source_begin[k] + i];
    changed |= target[i] != sum;
    target[i] = sum;
  }
  return changed;
}

void CoupledSystem::evalOutput(Index number, double t, const Vector& x, const Vector& u, double* result) noexcept {
  const Output& output = outputs_[number];
  const Subsystem& s = subsystems_[output.subsystem];
  s.model->evalOutput(output.port, t, In(x.data() + s.x_begin, s.x_size), In(u.data() + s.u_begin, s.u_size), Out(result, output.size));
}

void CoupledSystem::evalRemainder(double t, const Vector& x, const Vector& u, bool complete, double* remainder) noexcept {
  for (const Subsystem& s : subsystems_) {
    if (s.x_size == 0) continue;
    const In xs(x.data() + s.x_begin, s.x_size), us(u.data() + s.u_begin, s.u_size);
    const Out out(remainder + s.x_begin, s.x_size);
    if (!complete && s.provides_remainder) {
      s.model->evalRemainder(t, xs, us, out);
    } else {
      s.model->evalDerivatives(t, xs, us, out);
      if (!complete && !std::holds_alternative<ZeroStiff>(s.stiff)) subtractStiff(s.stiff, xs, In(out.data(), out.size()), out);
    }
  }
}

}  // namespace heerk_rotor
