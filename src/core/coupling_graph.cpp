#include "heerk_rotor/core/coupling_graph.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "heerk_rotor/core/nearest_name.hpp"

namespace heerk_rotor {
namespace {

bool isIdentifier(const std::string& name) {
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

/// "mast.torque (1, N m)"
template <class Port>
std::string describe(const std::string& subsystem, const Port& port) {
  return subsystem + "." + port.name + " (" + std::to_string(port.size) + ", " + port.unit + ")";
}

template <class Port>
std::vector<std::string> names(const std::vector<Port>& ports) {
  std::vector<std::string> result;
  for (const Port& port : ports) result.push_back(port.name);
  return result;
}

std::string list(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text.empty() ? "none" : text;
}

/// Port names unique, sizes positive, entry lists of the right length, feedthrough naming existing inputs.
void checkPorts(const std::string& name, const std::vector<State>& states, const std::vector<InputPort>& inputs,
                const std::vector<OutputPort>& outputs, const StiffPart& stiff) {
  const auto fail = [&](const std::string& what) { throw CouplingError("subsystem " + name + ": " + what); };
  std::set<std::string> seen;
  for (const State& state : states)
    if (!seen.insert(state.name).second) fail("state " + state.name + " is declared twice");
  seen.clear();
  for (const InputPort& port : inputs) {
    if (!seen.insert(port.name).second) fail("input " + port.name + " is declared twice");
    if (port.size <= 0) fail("input " + port.name + " has size " + std::to_string(port.size) + ", expected at least 1");
    const auto size = static_cast<std::size_t>(port.size);
    if (!port.default_value.empty() && port.default_value.size() != size) fail("input " + port.name + ": default_value has the wrong length");
    if (!port.entries.empty() && port.entries.size() != size) fail("input " + port.name + ": entries has the wrong length");
    if ((!port.low.empty() && port.low.size() != size) || (!port.high.empty() && port.high.size() != size)) fail("input " + port.name + ": low or high has the wrong length");
  }
  const std::set<std::string> known = seen;
  seen.clear();
  for (const OutputPort& port : outputs) {
    if (!seen.insert(port.name).second) fail("output " + port.name + " is declared twice");
    if (port.size <= 0) fail("output " + port.name + " has size " + std::to_string(port.size) + ", expected at least 1");
    if (!port.entries.empty() && port.entries.size() != static_cast<std::size_t>(port.size)) fail("output " + port.name + ": entries has the wrong length");
    if (!port.entry_units.empty() && port.entry_units.size() != static_cast<std::size_t>(port.size)) fail("output " + port.name + ": entry_units has the wrong length");
    if (!(port.nominal > 0.0)) fail("output " + port.name + ": nominal magnitude must be positive");
    for (const std::string& input : port.feedthrough)
      if (!known.count(input)) fail("output " + port.name + " declares feedthrough of unknown input " + input);
  }
  if (stiffSize(stiff) != static_cast<Index>(states.size()))
    fail("stiff part covers " + std::to_string(stiffSize(stiff)) + " states, expected " + std::to_string(states.size()));
}

/// Names of a port's entries without the subsystem: given, or the port's own name, numbered from 1 when there are several.
template <class Port>
std::vector<std::string> entryNames(const Port& port) {
  if (!port.entries.empty()) return port.entries;
  if (port.size == 1) return {port.name};
  std::vector<std::string> result;
  for (Index i = 1; i <= port.size; ++i) result.push_back(port.name + "_" + std::to_string(i));
  return result;
}

}  // namespace

void CouplingGraph::add(const std::string& name, std::unique_ptr<SubsystemModel> model,
                        const std::map<std::string, double>& initial) {
  if (!isIdentifier(name)) throw CouplingError("subsystem name '" + name + "': expected a letter, then letters, digits or _");
  for (const Entry& entry : entries_)
    if (entry.name == name) throw CouplingError("subsystem " + name + " exists already");

  Entry entry{name, std::move(model), {}, {}, {}};
  entry.states = entry.model->states();
  entry.inputs = entry.model->inputs();
  entry.outputs = entry.model->outputs();
  checkPorts(name, entry.states, entry.inputs, entry.outputs, entry.model->stiffPart());

  std::vector<std::string> keys;
  for (const State& state : entry.states) keys.push_back(state.initialKey());
  for (const auto& [key, value] : initial) {
    const auto found = std::find(keys.begin(), keys.end(), key);
    if (found == keys.end()) throw CouplingError("subsystem " + name + ": no initial value is called " + key + didYouMean(key, keys));
    entry.states[static_cast<std::size_t>(found - keys.begin())].initial = value;
  }
  entries_.push_back(std::move(entry));
}

CouplingGraph::PortPlace CouplingGraph::find(const std::string& path, bool output) const {
  const std::string kind = output ? "output" : "input";
  const auto dot = path.find('.');
  if (dot == std::string::npos) throw CouplingError(path + ": expected subsystem." + kind);
  const std::string subsystem = path.substr(0, dot), port = path.substr(dot + 1);
  std::vector<std::string> subsystem_names;
  for (std::size_t m = 0; m < entries_.size(); ++m) {
    const Entry& entry = entries_[m];
    subsystem_names.push_back(entry.name);
    if (entry.name != subsystem) continue;
    const std::vector<std::string> mine = output ? names(entry.outputs) : names(entry.inputs);
    const auto found = std::find(mine.begin(), mine.end(), port);
    if (found != mine.end()) return {static_cast<Index>(m), found - mine.begin()};
    const std::vector<std::string> other = output ? names(entry.inputs) : names(entry.outputs);
    if (std::find(other.begin(), other.end(), port) != other.end())
      throw CouplingError(path + " is an " + (output ? "input" : "output") + ", expected an " + kind + " (the order is [output, input])");
    throw CouplingError(path + ": subsystem " + subsystem + " has no " + kind + " " + port + didYouMean(port, mine) + "; it has " + list(mine));
  }
  throw CouplingError(path + ": there is no subsystem " + subsystem + didYouMean(subsystem, subsystem_names) + "; there are " + list(subsystem_names));
}

void CouplingGraph::connect(const std::string& output, const std::string& input) {
  const PortPlace from = find(output, true), to = find(input, false);
  const OutputPort& source = entries_[from.model].outputs[from.port];
  const InputPort& target = entries_[to.model].inputs[to.port];
  const std::string both = "connect " + describe(entries_[from.model].name, source) + " -> " + describe(entries_[to.model].name, target);

  // A port of the same subsystem that would fit is the best hint for a slip.
  const auto fitting = [&] {
    for (const OutputPort& port : entries_[from.model].outputs)
      if (port.size == target.size && port.unit == target.unit) return "; " + entries_[from.model].name + "." + port.name + " would fit";
    return std::string();
  };
  if (source.size != target.size) throw CouplingError(both + ": sizes differ" + fitting());
  if (source.unit != target.unit) throw CouplingError(both + ": units differ" + fitting());
  for (const Connection& c : connections_)
    if (c.output_model == from.model && c.output_port == from.port && c.input_model == to.model && c.input_port == to.port)
      throw CouplingError(both + ": connected already");
  connections_.push_back({from.model, from.port, to.model, to.port});
}

bool CouplingGraph::driven(Index model, Index port) const {
  return std::any_of(connections_.begin(), connections_.end(),
                     [&](const Connection& c) { return c.input_model == model && c.input_port == port; });
}

std::vector<std::string> CouplingGraph::unconnectedInputs() const {
  std::vector<std::string> result;
  for (std::size_t m = 0; m < entries_.size(); ++m)
    for (std::size_t p = 0; p < entries_[m].inputs.size(); ++p)
      if (entries_[m].inputs[p].unconnected == Unconnected::kError && !driven(m, p))
        result.push_back(entries_[m].name + "." + entries_[m].inputs[p].name);
  return result;
}

CoupledSystem CouplingGraph::build() && {
  if (const auto missing = unconnectedInputs(); !missing.empty())
    throw CouplingError("nothing drives " + list(missing));

  CoupledSystem system;
  std::vector<Index> first_input, first_output;  // global port numbers of each model
  std::vector<double> initial, command, low, high;

  // Subsystems, ports and signals one after the other; offsets follow the order of add().
  for (Entry& entry : entries_) {
    const Index number = static_cast<Index>(system.subsystems_.size());
    first_input.push_back(static_cast<Index>(system.inputs_.size()));
    first_output.push_back(static_cast<Index>(system.outputs_.size()));
    CoupledSystem::Subsystem subsystem{entry.name, nullptr, entry.model->stiffPart(), entry.model->providesRemainder(),
                                       system.x_size_, static_cast<Index>(entry.states.size()), system.u_size_, 0, system.y_size_, 0, nullptr, 0, 0, 0, 0};
    for (const State& state : entry.states) initial.push_back(state.initial);

    for (std::size_t p = 0; p < entry.inputs.size(); ++p) {
      const InputPort& port = entry.inputs[p];
      CoupledSystem::Input input{entry.name + "." + port.name, number, system.u_size_ + subsystem.u_size, port.size, {}, {}, -1, Vector::Zero(port.size), port.only_for_outputs};
      if (!port.default_value.empty()) input.default_value = Eigen::Map<const Vector>(port.default_value.data(), port.size);
      if (port.unconnected == Unconnected::kCommand && !driven(number, static_cast<Index>(p))) {
        input.command = static_cast<Index>(command.size());
        for (const std::string& name : entryNames(port)) system.command_names_.push_back(entry.name + "." + name);
        command.insert(command.end(), input.default_value.begin(), input.default_value.end());
        for (Index i = 0; i < port.size; ++i) {
          low.push_back(port.low.empty() ? -HUGE_VAL : port.low[static_cast<std::size_t>(i)]);
          high.push_back(port.high.empty() ? HUGE_VAL : port.high[static_cast<std::size_t>(i)]);
        }
      }
      subsystem.u_size += port.size;
      system.inputs_.push_back(std::move(input));
    }

    std::set<std::string> output_entries;
    for (std::size_t p = 0; p < entry.outputs.size(); ++p) {
      const OutputPort& port = entry.outputs[p];
      CoupledSystem::Output output{entry.name + "." + port.name, number, static_cast<Index>(p), system.y_size_ + subsystem.y_size, port.size, port.nominal, {}};
      for (const std::string& input : port.feedthrough)
        for (std::size_t q = 0; q < entry.inputs.size(); ++q)
          if (entry.inputs[q].name == input) output.feedthrough.push_back(first_input.back() + static_cast<Index>(q));
      Index k = output.begin;
      for (const std::string& name : entryNames(port)) {
        output_entries.insert(name);
        const std::string& unit = port.entry_units.empty() ? port.unit : port.entry_units[static_cast<std::size_t>(k - output.begin)];
        system.signals_.push_back({entry.name + "." + name, unit, port.meaning, Signal::Kind::kOutput, k++, port.published});
      }
      subsystem.y_size += port.size;
      system.outputs_.push_back(std::move(output));
    }
    for (std::size_t i = 0; i < entry.states.size(); ++i)
      if (const State& state = entry.states[i]; !output_entries.count(state.name))
        system.signals_.push_back({entry.name + "." + state.name, state.unit, state.meaning, Signal::Kind::kState, system.x_size_ + static_cast<Index>(i), false});

    subsystem.model = std::move(entry.model);
    system.x_size_ += subsystem.x_size;
    system.u_size_ += subsystem.u_size;
    system.y_size_ += subsystem.y_size;
    system.subsystems_.push_back(std::move(subsystem));
  }
  for (const Connection& c : connections_) {
    CoupledSystem::Input& input = system.inputs_[first_input[c.input_model] + c.input_port];
    input.sources.push_back(first_output[c.output_model] + c.output_port);
    input.source_begin.push_back(system.outputs_[input.sources.back()].begin);
  }

  system.declared_initial_ = Eigen::Map<const Vector>(initial.data(), static_cast<Index>(initial.size()));
  system.default_command_ = Eigen::Map<const Vector>(command.data(), static_cast<Index>(command.size()));
  system.command_low_ = Eigen::Map<const Vector>(low.data(), static_cast<Index>(low.size()));
  system.command_high_ = Eigen::Map<const Vector>(high.data(), static_cast<Index>(high.size()));
  system.layOutStages();
  return system;
}

}  // namespace heerk_rotor
