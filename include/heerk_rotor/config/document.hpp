#pragma once
#include <map>
#include <string>

#include <yaml-cpp/yaml.h>

#include "heerk_rotor/config/problems.hpp"

namespace heerk_rotor {

/// A YAML tree that knows where each of its values was written. The tree shares no node with anything else: aliases
/// (`*name`) are written out, so that changing one place changes no other.
struct Document {
  YAML::Node root;
  std::map<std::string, std::string> places;  // dotted key -> "file:line" or "--set key"; "" -> the root

  /// Place of a key, or of its nearest ancestor when the key is absent.
  std::string place(const std::string& dotted_key) const;
};

/// Reads one YAML document; `name` stands for the file. Records as problems, each with its line: syntax errors, control
/// characters, no or several documents, a key given twice in one mapping, a key that is no plain name, tags (`!!float`),
/// and structures too deep or too large to be meant. The root is undefined when nothing could be read.
/// `at` is the dotted key whose value the text is, when it is no whole configuration: the keys of trim.targets are names of
/// signals and may be written with their dot, `rotor.thrust: 1.0` for `rotor: {thrust: 1.0}`.
Document readDocument(const std::string& text, const std::string& name, Problems& problems, const std::string& at = "");

/// Applies one "key=value" of the command line: replaces the value at a dotted key (list elements by index), or adds the
/// key when the mapping around it exists; whether the schema knows it is found out when the section is read. What can be
/// missing without being unknown (`simulation`, `subsystems.<name>.initial`) is created. A key whose surroundings do not
/// exist is a problem that names the nearest known one. simulation.step removes simulation.azimuth_step_deg, and the
/// other way round, because each of them defines the step.
void applyOverride(Document& document, const std::string& assignment, Problems& problems);

/// Where simulation.start names a file (relative to the configuration's folder), puts the file's contents in its place, so
/// that the configuration is complete without it; the values keep their place within that file.
void embedStart(Document& document, const std::string& configuration_file, Problems& problems);

/// Makes `start` the mapping simulation.start.
void replaceStart(Document& document, const Document& start);

}  // namespace heerk_rotor
