#include "heerk_rotor/config/configuration.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "heerk_rotor/config/yaml_value.hpp"
#include "heerk_rotor/core/nearest_name.hpp"

namespace heerk_rotor {
namespace {

const char* const kStep = "simulation.step";
const char* const kAzimuthStep = "simulation.azimuth_step_deg";

void checkSections(const Document& document, Problems& problems) {
  const std::vector<std::string> known = {"description", "simulation", "trim", "subsystems", "connections"};
  for (const auto& entry : document.root) {
    const std::string& name = entry.first.Scalar();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      problems.add({document.place(name), name, asWritten(entry.second),
                    "one of the sections description, simulation, trim, subsystems, connections" + didYouMean(name, known), "", true});
    } else if (name == "description" && !entry.second.IsScalar()) {
      problems.add({document.place(name), name, asWritten(entry.second), "text"});
    }
  }
}

void checkStep(const Document& document, Problems& problems) {
  const YAML::Node step = findValue(document.root, kStep);
  if (step.IsDefined() && findValue(document.root, kAzimuthStep).IsDefined()) {
    problems.add({document.place(kStep), kStep, asWritten(step),
                  "either step or azimuth_step_deg, but azimuth_step_deg is given too (" + document.place(kAzimuthStep) + ")"});
  }
}

[[noreturn]] void fail(Problem problem) {
  Problems problems;
  problems.add(std::move(problem));
  throw ConfigurationError(problems);
}

}  // namespace

Configuration Configuration::load(const std::string& file, const std::vector<std::string>& overrides) {
  const std::string expected = "a YAML configuration file that can be read";
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) fail({file, "", error.message(), expected});
  if (std::filesystem::is_directory(status)) fail({file, "", "a directory", expected});
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  // An empty file sets the failbit of `text`, which readDocument reports better.
  if (!stream || stream.bad()) fail({file, "", errno != 0 ? std::strerror(errno) : "a file that cannot be read", expected});
  return parse(text.str(), file, overrides);
}

Configuration Configuration::parse(const std::string& text, const std::string& name, const std::vector<std::string>& overrides) {
  Problems problems;
  Document document = readDocument(text, name, problems);
  if (!document.root.IsDefined()) throw ConfigurationError(problems);
  if (!document.root.IsMap()) {
    fail({document.place(""), "", asWritten(document.root), "a mapping with the sections simulation, subsystems and connections"});
  }
  checkStep(document, problems);
  const bool step_was_clear = problems.empty();
  for (const std::string& assignment : overrides) applyOverride(document, assignment, problems);
  if (step_was_clear) checkStep(document, problems);  // `--set simulation={...}` can bring both
  checkSections(document, problems);
  embedStart(document, name, problems);
  if (!problems.empty()) throw ConfigurationError(problems);

  Configuration configuration;
  configuration.document_ = std::make_shared<const Document>(std::move(document));
  configuration.file_ = name;
  return configuration;
}

std::string Configuration::where(const std::string& dotted_key) const { return document_->place(dotted_key); }

Configuration Configuration::withStart(const std::string& start_text, const std::string& name) const {
  Problems problems;
  Document document = *document_;
  document.root.reset(YAML::Clone(document_->root));
  Document start = readDocument(start_text, name, problems);
  if (!problems.empty()) throw ConfigurationError(problems);
  for (const auto& subsystem : document.root["subsystems"]) {
    YAML::Node parameters = subsystem.second;
    if (parameters.IsMap()) parameters.remove("initial");
  }
  replaceStart(document, start);
  Configuration configuration;
  configuration.document_ = std::make_shared<const Document>(std::move(document));
  configuration.file_ = file_;
  return configuration;
}

std::string Configuration::resolvedText() const { return yamlText(document_->root); }

}  // namespace heerk_rotor
