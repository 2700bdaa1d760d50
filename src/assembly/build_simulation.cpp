#include "heerk_rotor/assembly/build_simulation.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "heerk_rotor/assembly/start_file.hpp"
#include "heerk_rotor/config/yaml_value.hpp"
#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/core/nearest_name.hpp"
#include "heerk_rotor/integrate/step_method.hpp"
#include "heerk_rotor/models/registry.hpp"

namespace heerk_rotor {
namespace {

bool isIdentifier(const std::string& name) {
  if (name.empty() || !std::isalpha(static_cast<unsigned char>(name[0]))) return false;
  for (const char c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return false;
  }
  return true;
}

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// The `simulation:` section with the one check that needs the list of methods.
SimulationSettings readSettings(const Configuration& configuration, Problems& problems) {
  const SimulationSettings settings = readSimulationSettings(configuration, problems);
  const std::vector<std::string> names = stepMethodNames();
  if (std::find(names.begin(), names.end(), settings.integrator) != names.end()) return settings;
  const std::string key = "simulation.integrator";
  const std::string found = asWritten(findValue(configuration.root(), key));
  // What is no word at all has been reported already, and the default is in `settings`.
  problems.add({configuration.where(key), key, found, "one of " + list(names) + didYouMean(settings.integrator, names)});
  return settings;
}

/// Builds the coupling graph of a configuration and collects everything that is wrong on the way. A subsystem that
/// cannot be built does not hide faults elsewhere, and causes no further complaints about connections with it.
class SystemBuilder {
 public:
  SystemBuilder(const Configuration& configuration, const SimulationSettings& settings, Problems& problems)
      : configuration_(configuration), settings_(settings), problems_(problems) {}

  CouplingGraph build() {
    addSubsystems();
    addConnections();
    reportUnconnected();
    return std::move(graph_);
  }

 private:
  void addSubsystems() {
    const YAML::Node subsystems = findValue(configuration_.root(), "subsystems");
    if (!subsystems.IsDefined() || !subsystems.IsMap() || subsystems.size() == 0) {
      report("subsystems", "a mapping of at least one subsystem, <name>: {type: <type>, ...}");
      return;
    }
    for (const auto& entry : subsystems) {
      const std::string name = entry.first.Scalar();
      declared_.insert(name);
      if (!isIdentifier(name)) {
        report("subsystems." + name, "as name of a subsystem a letter, then letters, digits or _");
      } else if (!entry.second.IsMap()) {
        report("subsystems." + name, "a mapping with the key type and the parameters of that type");
      } else {
        addSubsystem(name);
      }
    }
  }

  void addSubsystem(const std::string& name) {
    Section section(configuration_, "subsystems." + name, problems_);
    std::vector<std::string> types;
    for (const ModelType& type : modelTypes()) types.push_back(type.name);
    if (!section.has("type")) return section.problem("type", "one of " + list(types));
    const std::string word = section.word("type", "", types);
    section.text("initial");  // a known key, read below
    for (const ModelType& type : modelTypes()) {
      if (type.name != word) continue;
      try {
        std::unique_ptr<SubsystemModel> model = type.make(section, {configuration_, settings_, name, problems_});
        section.finish();
        if (model) add(name, std::move(model), section);
      } catch (const std::exception& error) {  // a constructor's own check, CouplingError for ports that do not agree
        problems_.add({configuration_.where(section.path()), section.path(), word, std::string("parameters of which a subsystem can be made: ") + error.what()});
      }
    }
  }

  void add(const std::string& name, std::unique_ptr<SubsystemModel> model, Section& section) {
    Section section_of_initial = section.child("initial");
    std::map<std::string, double> initial;
    for (const State& state : model->states()) {
      const std::string& key = state.initialKey();
      const bool given = section_of_initial.has(key);
      const double value = section_of_initial.number(key, state.initial, state.unit);  // also makes the key known
      if (given) initial[key] = value;
    }
    for (const std::string& key : model->ignoredInitialValues()) section_of_initial.number(key, 0.0, "-");
    section_of_initial.finish();
    const std::vector<OutputPort> outputs = model->outputs();
    const std::vector<InputPort> inputs = model->inputs();
    graph_.add(name, std::move(model), initial);
    built_.insert(name);
    for (const OutputPort& port : outputs) outputs_.push_back({name + "." + port.name, port});
    for (const InputPort& port : inputs) inputs_.emplace(name + "." + port.name, port);
  }

  void addConnections() {
    const YAML::Node connections = findValue(configuration_.root(), "connections");
    if (!connections.IsDefined() || connections.IsNull()) return;
    const std::string shape = "[<subsystem>.<output>, <subsystem>.<input>]";
    if (!connections.IsSequence()) return report("connections", "a list of connections " + shape);
    for (std::size_t i = 0; i < connections.size(); ++i) {
      const YAML::Node pair = connections[i];
      const std::string key = "connections." + std::to_string(i);
      for (std::size_t k = 0; pair.IsSequence() && k < pair.size(); ++k) {
        if (pair[k].IsScalar()) intended_.insert(pair[k].Scalar());  // also when the order is wrong or the list too long
      }
      if (!pair.IsSequence() || pair.size() != 2 || !pair[0].IsScalar() || !pair[1].IsScalar()) {
        report(key, "a connection " + shape);
        continue;
      }
      const std::string &output = pair[0].Scalar(), &input = pair[1].Scalar();
      if (couldNotBeBuilt(output) || couldNotBeBuilt(input)) continue;
      try {
        graph_.connect(output, input);
      } catch (const CouplingError& error) {
        report(key, std::string("ports that fit: ") + error.what());
      }
    }
  }

  void reportUnconnected() {
    for (const std::string& input : graph_.unconnectedInputs()) {
      if (intended_.count(input)) continue;  // there is a connection, whose fault has been reported
      const InputPort& port = inputs_.at(input);
      std::string example = "<subsystem>.<output>";
      for (const auto& [name, output] : outputs_) {
        if (output.size == port.size && output.unit == port.unit && output.name == port.name) example = name;
      }
      const std::string subsystem = input.substr(0, input.find('.'));
      problems_.add({configuration_.where("subsystems." + subsystem), input, "(not connected)",
                     "a connection [" + example + ", " + input + "] to this input (" + std::to_string(port.size) + " values [" + port.unit + "])"});
    }
  }

  bool couldNotBeBuilt(const std::string& path) const {
    const std::string subsystem = path.substr(0, path.find('.'));
    return declared_.count(subsystem) != 0 && built_.count(subsystem) == 0;
  }

  void report(const std::string& key, const std::string& expected) {
    problems_.add({configuration_.where(key), key, asWritten(findValue(configuration_.root(), key)), expected});
  }

  const Configuration& configuration_;
  const SimulationSettings& settings_;
  Problems& problems_;
  CouplingGraph graph_;
  std::set<std::string> declared_, built_;                     // subsystems
  std::set<std::string> intended_;                             // ports that some connection names
  std::vector<std::pair<std::string, OutputPort>> outputs_;    // by "subsystem.port"
  std::map<std::string, InputPort> inputs_;
};

/// A model can turn finite initial values into others (a twist so large that a load overflows).
void checkInitialState(const Configuration& configuration, const CoupledSystem& system, Problems& problems) {
  const Vector x = system.initialState();
  for (const CoupledSystem::Subsystem& subsystem : system.subsystems()) {
    const std::vector<State> states = subsystem.model->states();
    for (Index i = 0; i < subsystem.x_size; ++i) {
      const double value = x[subsystem.x_begin + i];
      if (std::isfinite(value)) continue;
      const State& state = states[static_cast<std::size_t>(i)];
      const std::string key = "subsystems." + subsystem.name + ".initial." + state.initialKey();
      problems.add({configuration.where(key), key, std::to_string(value), "parameters with which the initial value is finite [" + state.unit + "]"});
    }
  }
}

void throwIfAny(const Problems& problems) {
  if (!problems.empty()) throw ConfigurationError(problems);
}

CoupledSystem buildSystem(const Configuration& configuration, const SimulationSettings& settings, Problems& problems) {
  CouplingGraph graph = SystemBuilder(configuration, settings, problems).build();
  throwIfAny(problems);
  CoupledSystem system = std::move(graph).build();
  StartValues start = readStart(configuration, system, problems);
  throwIfAny(problems);
  system.setStart(std::move(start.states), start.command);
  checkInitialState(configuration, system, problems);
  throwIfAny(problems);
  return system;
}

}  // namespace

CoupledSystem buildSystem(const Configuration& configuration) {
  Problems problems;
  const SimulationSettings settings = readSettings(configuration, problems);
  return buildSystem(configuration, settings, problems);
}

std::unique_ptr<Simulation> buildSimulation(const Configuration& configuration) {
  Problems problems;
  const SimulationSettings settings = readSettings(configuration, problems);
  CoupledSystem system = buildSystem(configuration, settings, problems);

  StepOptions options;
  options.step = settings.step;
  options.method = settings.integrator;
  options.paper_tolerance = settings.paper_tolerance;
  options.revolution = settings.revolution();
  options.solver.tolerance = settings.newton_tolerance;
  try {
    return std::make_unique<Simulation>(std::move(system), options);
  } catch (const CouplingError& error) {
    problems.add({configuration.where("connections"), "connections", "an algebraic loop without a unique solution", std::string("an index-1 system: ") + error.what()});
  } catch (const std::invalid_argument& error) {
    problems.add({configuration.where("simulation"), "simulation", "settings that do not work together", error.what()});
  }
  throw ConfigurationError(problems);
}

}  // namespace heerk_rotor
