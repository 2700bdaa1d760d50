#include "heerk_rotor/core/coupled_system.hpp"

#include <algorithm>
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
  for (const auto& [entry, value] : start_) x[entry] = value;  // also what a model derives its initial state from
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

std::unique_ptr<SubsystemModel> CoupledSystem::exchangeModel(Index subsystem, std::unique_ptr<SubsystemModel> model) {
  Subsystem& s = subsystems_[static_cast<std::size_t>(subsystem)];
  std::swap(s.model, model);
  s.narrow = nullptr;  // belongs to the old one
  layOutStages();
  return model;
}

const double* CoupledSystem::firstSource(const Input& input, const Vector& y, const Vector& w) const noexcept {
  return !input.source_begin.empty() ? y.data() + input.source_begin[0] : input.command >= 0 ? w.data() + input.command : input.default_value.data();
}

void CoupledSystem::fetch(Index number, const Vector& y, const Vector& w, Vector& u) const noexcept {
  const Input& input = inputs_[number];
  const double* first = firstSource(input, y, w);
  double* target = u.data() + input.begin;
  std::copy_n(first, input.size, target);
  for (std::size_t k = 1; k < input.source_begin.size(); ++k)
    for (Index i = 0; i < input.size; ++i) target[i] += y[input.source_begin[k] + i];
}

bool CoupledSystem::gather(Index number, const Vector& y, const Vector& w, Vector& u) const noexcept {
  const Input& input = inputs_[number];
  double* target = u.data() + input.begin;
  const std::size_t sources = input.source_begin.size();
  const double* first = firstSource(input, y, w);
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

void CoupledSystem::evalTogether(const Index* outputs, Index count, bool in_stage, double t, const Vector& x, const Vector& u, double* const* results) noexcept {
  const std::vector<OutputCall>& calls = in_stage ? stage_calls_ : calls_;
  const OutputCall& first = calls[static_cast<std::size_t>(outputs[0])];
  if (first.narrow) {
    for (Index k = 0; k < count; ++k) calls[static_cast<std::size_t>(outputs[k])](t, x.data(), u.data(), results[k]);
    return;
  }
  PortValue values[kTogether];
  for (Index k = 0; k < count; ++k) {
    const OutputCall& call = calls[static_cast<std::size_t>(outputs[k])];
    values[k] = {call.port, results[k], call.size};
  }
  first.model->evalOutputs(values, count, t, In(x.data() + first.x_begin, first.x_size), In(u.data() + first.u_begin, first.u_size));
}

/// Not inlined: its views would lie on the stack of every call of a model.
[[gnu::noinline]] void CoupledSystem::RatesCall::takeOffStiff(const double* x, double* remainder) const noexcept {
  subtractStiff(*stiff, In(x, x_size), In(remainder, x_size), Out(remainder, x_size));
}

void CoupledSystem::evalRemainder(double t, const Vector& x, const Vector& u, bool complete, double* remainder) noexcept {
  for (const RatesCall& call : rates_calls_) call(t, x.data() + call.x_begin, u.data(), complete, remainder + call.x_begin);
}

void CoupledSystem::layOutStages() {
  z_size_ = r_size_ = 0;
  has_narrow_forms_ = false;
  for (Subsystem& s : subsystems_) {
    s.z_begin = z_size_;
    s.r_begin = r_size_;
    z_size_ += s.z_size = s.narrow ? s.narrow->C.rows() : s.x_size;
    r_size_ += s.r_size = s.narrow ? s.narrow->B.cols() : s.x_size;
    has_narrow_forms_ = has_narrow_forms_ || s.narrow;
  }
  calls_.clear();
  stage_calls_.clear();
  for (const Output& o : outputs_) {
    const Subsystem& s = subsystems_[o.subsystem];
    calls_.push_back({s.model.get(), o.port, false, s.x_begin, s.x_size, s.u_begin, s.u_size, o.size});
    stage_calls_.push_back({s.model.get(), o.port, s.narrow != nullptr, s.z_begin, s.z_size, s.u_begin, s.u_size, o.size});
  }
  rates_calls_.clear();
  for (const Subsystem& s : subsystems_)
    if (s.x_size > 0)
      rates_calls_.push_back({s.model.get(), s.narrow != nullptr, s.provides_remainder, std::holds_alternative<ZeroStiff>(s.stiff) ? nullptr : &s.stiff, s.x_begin, s.x_size, s.z_begin, s.z_size,
                              s.r_begin, s.r_size, s.u_begin, s.u_size});
}

void CoupledSystem::chooseNarrowForms(const std::vector<char>& needed) {
  for (std::size_t i = 0; i < subsystems_.size(); ++i) {
    Subsystem& s = subsystems_[i];
    s.narrow = s.model->narrowForm();
    for (std::size_t o = 0; o < outputs_.size(); ++o)
      if (needed[o] && outputs_[o].subsystem == static_cast<Index>(i) && !s.model->narrowOutput(outputs_[o].port)) s.narrow = nullptr;
  }
  layOutStages();
}

bool CoupledSystem::evalStageRemainder(double t, const Vector& z, const Vector& u, double* r) noexcept {
  for (const RatesCall& call : rates_calls_) {
    if (!call.narrow) call(t, z.data() + call.z_begin, u.data(), false, r + call.r_begin);
    else if (!call.model->evalNarrowRemainder(t, In(z.data() + call.z_begin, call.z_size), In(u.data() + call.u_begin, call.u_size), Out(r + call.r_begin, call.r_size))) return false;
  }
  return true;
}

}  // namespace heerk_rotor
