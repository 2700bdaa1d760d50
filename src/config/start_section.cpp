#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "heerk_rotor/config/document.hpp"
#include "heerk_rotor/config/yaml_value.hpp"

namespace heerk_rotor {
namespace {
const char* const kStart = "simulation.start";
}

void replaceStart(Document& document, const Document& start) {
  // Through a node of our own: assigning to what findValue returns would change only the copy.
  YAML::Node simulation = findValue(document.root, "simulation");
  simulation.remove("start");
  simulation.force_insert("start", start.root);
  auto& places = document.places;
  const std::string inside = std::string(kStart) + ".";
  for (auto it = places.lower_bound(inside); it != places.end() && it->first.compare(0, inside.size(), inside) == 0;) it = places.erase(it);
  places[kStart] = start.place("");
  for (const auto& [key, place] : start.places)
    if (!key.empty()) places[inside + key] = place;
}

void embedStart(Document& document, const std::string& configuration_file, Problems& problems) {
  const YAML::Node value = findValue(document.root, kStart);
  if (!value.IsDefined() || value.IsNull() || value.IsMap()) return;
  const std::string expected = "the name of a start file (simulate --save-start), relative to the configuration, or none";
  if (value.IsScalar() && value.Scalar() == "none") {  // an override takes the start file away
    findValue(document.root, "simulation").remove("start");
    return;
  }
  if (!value.IsScalar() || value.Scalar().empty()) {
    problems.add({document.place(kStart), kStart, asWritten(value), expected});
    return;
  }
  const std::filesystem::path file = std::filesystem::path(configuration_file).parent_path() / value.Scalar();
  std::error_code error;
  const bool directory = std::filesystem::is_directory(file, error);
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream && !directory) text << stream.rdbuf();
  if (!stream || directory || stream.bad()) {
    problems.add({document.place(kStart), kStart, value.Scalar(),
                  expected + "; " + file.string() + (directory ? " is a directory" : std::string(" cannot be read: ") + std::strerror(errno != 0 ? errno : EIO))});
    return;
  }
  Problems inside;
  const Document start = readDocument(text.str(), file.string(), inside);
  for (const Problem& problem : inside.list()) problems.add(problem);
  if (!inside.empty()) return;
  if (!start.root.IsMap()) {
    problems.add({start.place(""), kStart, asWritten(start.root), "a mapping with states and commands"});
    return;
  }
  replaceStart(document, start);
}

}  // namespace heerk_rotor
