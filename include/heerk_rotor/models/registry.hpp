#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/config/simulation_settings.hpp"
#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

/// What a model may need to know besides its own parameters.
struct BuildContext {
  const Configuration& configuration;
  const SimulationSettings& simulation;
  std::string name;                      // of the subsystem that is being built
  Problems& problems;

  /// Name of the only subsystem of that type, or "" (a mast finds its rotor this way).
  std::string onlySubsystemOfType(const std::string& type) const;
  /// Whether the configuration connects these ports, "subsystem.output" to "subsystem.input".
  bool connects(const std::string& output, const std::string& input) const;
};

/// A registered type: the word after `type:` in the configuration.
struct ModelType {
  std::string name;
  std::string summary;
  /// Reads the section (all keys but `type` and `initial`), records problems, and returns the model; may return nullptr
  /// only if it recorded a problem.
  std::function<std::unique_ptr<SubsystemModel>(Section&, const BuildContext&)> make;
};

/// All types; a new model is one line here.
const std::vector<ModelType>& modelTypes();

}  // namespace heerk_rotor
