#pragma once
#include <memory>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "heerk_rotor/config/document.hpp"
#include "heerk_rotor/config/problems.hpp"

namespace heerk_rotor {

/// A YAML file with --set overrides applied, that still knows where each value came from.
class Configuration {
 public:
  /// Reads the file and applies "key=value" overrides in order. Throws ConfigurationError (missing file, YAML syntax,
  /// a key given twice, unknown section, unknown or malformed override key with the nearest known one, both
  /// simulation.step and azimuth_step_deg in the file).
  /// An override may address any key the file has, any element of a list by index, and any key that the schema of that
  /// place allows (checked later, when the section is read).
  static Configuration load(const std::string& file, const std::vector<std::string>& overrides = {});

  /// The same from text; `name` stands for the file in messages.
  static Configuration parse(const std::string& text, const std::string& name, const std::vector<std::string>& overrides = {});

  /// The same configuration started from other values: `start_text` (see assembly/start_file.hpp) becomes simulation.start
  /// and every subsystem's `initial` is dropped, since it would take precedence.
  Configuration withStart(const std::string& start_text, const std::string& name) const;

  const YAML::Node& root() const { return document_->root; }
  const std::string& file() const { return file_; }

  /// "file:line" of a key, or "--set key" when it was overridden; of the nearest ancestor when the key is absent.
  std::string where(const std::string& dotted_key) const;

  /// The configuration as YAML text with the start file and all overrides in it: parsing it again gives the same configuration.
  std::string resolvedText() const;

 private:
  // Behind a pointer to const, because assigning one YAML::Node to another changes every copy of the first.
  std::shared_ptr<const Document> document_ = std::make_shared<const Document>();
  std::string file_;
};

}  // namespace heerk_rotor
