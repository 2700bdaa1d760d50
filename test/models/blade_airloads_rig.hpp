#pragma once
#include <random>
#include <stdexcept>

#include "heerk_rotor/models/blade_airloads.hpp"
#include "heerk_rotor/models/registry.hpp"
#include "models/rotor_runs.hpp"

namespace heerk_rotor::test {

constexpr double kOmega = 44.4;  // nominal speed of all rigs [rad/s]

/// blade_airloads alone, built by its factory from text; the test is the rotor, the mast, the mount and the inflow.
struct AirloadsRig {
  /// rotor: keys of the fe_rotor that decide the sections; airloads: keys of blade_airloads; directory: of the configuration file.
  AirloadsRig(const std::string& rotor, const std::string& airloads, const std::string& directory = "") {
    const Configuration configuration = Configuration::parse("simulation: {rotor_speed: 44.4, step: 1.0e-3}\nsubsystems:\n  rotor: {type: fe_rotor, " + rotor +
                                                                 "}\n  airloads:\n    type: blade_airloads\n" + airloads, directory + "rig.yaml");
    Problems problems;
    const SimulationSettings settings = readSimulationSettings(configuration, problems);
    Section section(configuration, "subsystems.airloads", problems);
    section.word("type", "");
    for (const ModelType& type : modelTypes())
      if (type.name == "blade_airloads") model = type.make(section, {configuration, settings, "airloads", problems});
    complaints = problems.text();
    Section of_rotor(configuration, "subsystems.rotor", problems);
    sections = readRotorSections(of_rotor);
    if (!model) throw std::runtime_error("no model");
    inputs = model->inputs();
    outputs = model->outputs();
    Index size = 0;
    for (const InputPort& port : inputs) {
      begin.push_back(size);
      size += port.size;
    }
    u = Vector::Zero(size);
    x = Vector::Zero(static_cast<Index>(model->states().size()));
  }

  int blades() const { return sections.blades; }
  bool has(const std::string& port) const {
    return std::any_of(inputs.begin(), inputs.end(), [&](const InputPort& input) { return input.name == port; });
  }
  double* port(const std::string& name) {
    for (std::size_t p = 0; p < inputs.size(); ++p)
      if (inputs[p].name == name) return u.data() + begin[p];
    throw std::out_of_range(name);
  }
  /// Component c of a port with `components` per section and blade.
  double& at(const std::string& name, Index section, Index c, Index components, Index blade) {
    return port(name)[sectionEntry(section, c, components, blade, blades())];
  }
  void set(const std::string& name, Index section, Index blade, const std::vector<double>& values) {
    for (std::size_t c = 0; c < values.size(); ++c) at(name, section, static_cast<Index>(c), static_cast<Index>(values.size()), blade) = values[c];
  }
  Vector output(const std::string& name) {
    for (std::size_t p = 0; p < outputs.size(); ++p) {
      if (outputs[p].name != name) continue;
      Vector y = Vector::Zero(outputs[p].size);
      model->evalOutput(static_cast<Index>(p), 0.0, in(x), in(u), view(y));
      return y;
    }
    throw std::out_of_range(name);
  }
  /// (force x, y, z, moment) of one section.
  Eigen::Vector4d loadOf(const Vector& loads, Index section, Index blade) const {
    Eigen::Vector4d load;
    for (Index c = 0; c < 4; ++c) load[c] = loads[sectionEntry(section, c, 4, blade, blades())];
    return load;
  }
  Eigen::Vector4d load(Index section, Index blade) { return loadOf(output("section_loads"), section, blade); }

  double azimuth(Index blade) { return port("hub_motion")[0] + 2.0 * M_PI * static_cast<double>(blade) / blades(); }

  /// Straight level axes and no motion everywhere.
  void level() {
    for (Index j = 0; j < sections.count(); ++j)
      for (Index k = 0; k < blades(); ++k) {
        set("section_axes", j, k, {0, 1, 0, 0, 0, 1});
        set("section_velocity", j, k, {0, 0, 0});
        set("section_pitch", j, k, {0});
        set("section_position", j, k, {sections.r[j], 0, 0});
      }
  }
  /// The rotor turns at `speed`, blades straight and level, all with one pitch.
  void turn(double speed, double pitch = 0.0) {
    level();
    port("hub_motion")[1] = speed;
    for (Index j = 0; j < sections.count(); ++j)
      for (Index k = 0; k < blades(); ++k) {
        at("section_velocity", j, 1, 3, k) = speed * sections.r[j];
        at("section_pitch", j, 0, 1, k) = pitch;
      }
  }
  /// Any plausible flight: every input at random, axes orthonormal.
  void randomize(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (Index i = 0; i < u.size(); ++i) u[i] = unit(random);
    port("hub_motion")[0] = 3.0 * unit(random);
    port("hub_motion")[1] = kOmega * (1.0 + 0.05 * unit(random));
    for (int i = 0; i < 3; ++i) {
      port("hub_wind")[i] = 20.0 * unit(random);
      port("inflow")[i] = 0.05 * unit(random);
      port("mount_velocity")[i] = 30.0 * unit(random);
    }
    for (Index j = 0; j < sections.count(); ++j)
      for (Index k = 0; k < blades(); ++k) {
        Eigen::Vector3d t(0.1 * unit(random), 1.0, 0.1 * unit(random)), n(0.1 * unit(random), 0.0, 1.0);
        t.normalize();
        n = (n - n.dot(t) * t).normalized();
        set("section_axes", j, k, {t.x(), t.y(), t.z(), n.x(), n.y(), n.z()});
        set("section_velocity", j, k, {30.0 * unit(random), kOmega * sections.r[j] + 40.0 * unit(random), 8.0 * unit(random)});
        set("section_pitch", j, k, {0.2 * unit(random)});
        set("section_position", j, k, {sections.r[j] + 0.02 * unit(random), 0.1 * unit(random), 0.3 * unit(random)});
      }
    for (Index i = 0; i < x.size(); ++i) x[i] = 30.0 * unit(random);
  }

  std::unique_ptr<SubsystemModel> model;
  std::string complaints;
  RotorSections sections;
  std::vector<InputPort> inputs;
  std::vector<OutputPort> outputs;
  std::vector<Index> begin;
  Vector u, x;
};

/// Midpoint sections of a rotor with R = 4.91 m.
inline std::string rotorOf(int blades, int sections = 3) { return "blades: " + std::to_string(blades) + ", nodes: [0.2, 4.91], root_cutout: 1.08, sections: " + std::to_string(sections); }

}  // namespace heerk_rotor::test
