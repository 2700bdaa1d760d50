#pragma once
#include <random>
#include <string>

#include "heerk_rotor/models/fe_rotor_parameters.hpp"
#include "heerk_rotor/models/registry.hpp"
#include "heerk_rotor/models/rotor_sections.hpp"
#include "models/rotor_runs.hpp"

namespace heerk_rotor::test {

/// YAML of the Bo105-class blade (sources: config/bo105.yaml) without loads, mount or controls.
inline std::string bo105Rotor(const std::string& more = "") {
  return "{type: fe_rotor, nodes: [0.20, 0.285, 0.37, 0.60, 1.08, 1.7183333333333333, 2.3566666666666667, 2.995, 3.6333333333333333, 4.271666666666667, 4.91], "
         "stations: [0.20, 0.37, 0.60, 4.91], mass: [22.20, 22.20, 5.55, 5.55], EI_flap: [69600, 69600, 8700, 8700], EI_lag: [656000, 656000, 82000, 82000], "
         "GJ: [46400, 46400, 5800, 5800], km1: 0.0075, km2: 0.0730, kA: 0.0730, twist_deg_per_R: -8.0, precone_deg: 2.5, root_cutout: 1.08, "
         "damping_mass: 0.5, damping_stiffness: 1.0e-7" + more + "}";
}

/// What `rotor: <yaml>` says, turning at rotor_speed.
inline FeRotorParameters rotorParameters(const std::string& yaml, double rotor_speed) {
  const Configuration configuration = Configuration::parse("simulation: {rotor_speed: " + std::to_string(rotor_speed) + ", step: 1.0e-3}\nsubsystems:\n  rotor: " + yaml + "\n", "lone", {});
  Problems problems;
  Section section(configuration, "subsystems.rotor", problems);
  section.word("type", "");
  FeRotorParameters p = readFeRotorParameters(section, rotor_speed);
  if (!problems.empty()) throw std::runtime_error(problems.text());
  return p;
}

/// One model by itself, evaluated at chosen states and inputs.
class LoneModel {
 public:
  LoneModel(const std::string& type, const std::string& yaml, double rotor_speed) {
    const Configuration configuration = Configuration::parse("simulation: {rotor_speed: " + std::to_string(rotor_speed) + ", step: 1.0e-3}\nsubsystems:\n  rotor: " + yaml + "\n", "lone", {});
    Problems problems;
    const SimulationSettings settings = readSimulationSettings(configuration, problems);
    Section section(configuration, "subsystems.rotor", problems);
    section.word("type", "");
    for (const ModelType& known : modelTypes())
      if (known.name == type) model_ = known.make(section, {configuration, settings, "rotor", problems});
    if (!problems.empty() || !model_) throw std::runtime_error(problems.text());
    outputs_ = model_->outputs();
    Index begin = 0;
    for (const InputPort& port : model_->inputs()) {
      input_begin_[port.name] = begin;
      begin += port.size;
      for (Index i = 0; i < port.size; ++i) default_input_.push_back(port.default_value.empty() ? 0.0 : port.default_value[static_cast<std::size_t>(i)]);
    }
  }

  SubsystemModel& model() { return *model_; }
  Index stateSize() const { return static_cast<Index>(model_->states().size()); }
  Vector defaultInput() const { return Eigen::Map<const Vector>(default_input_.data(), static_cast<Index>(default_input_.size())); }
  Index inputBegin(const std::string& port) const { return input_begin_.at(port); }

  Vector output(const std::string& name, const Vector& x, const Vector& u) {
    for (std::size_t port = 0; port < outputs_.size(); ++port) {
      if (outputs_[port].name != name) continue;
      Vector y = Vector::Zero(outputs_[port].size);
      model_->evalOutput(static_cast<Index>(port), 0.0, in(x), in(u), view(y));
      return y;
    }
    throw std::runtime_error("no output " + name);
  }
  Vector derivatives(const Vector& x, const Vector& u) {
    Vector xdot = Vector::Zero(x.size());
    model_->evalDerivatives(0.0, in(x), in(u), view(xdot));
    return xdot;
  }

 private:
  std::unique_ptr<SubsystemModel> model_;
  std::vector<OutputPort> outputs_;
  std::map<std::string, Index> input_begin_;
  std::vector<double> default_input_;
};

}  // namespace heerk_rotor::test
