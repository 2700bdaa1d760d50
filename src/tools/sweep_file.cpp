#include "heerk_rotor/tools/sweep_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "heerk_rotor/config/document.hpp"
#include "heerk_rotor/config/yaml_value.hpp"

namespace heerk_rotor {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// Cells of a line; in double quotes a comma is text and "" is one quote. Nothing when quotes stay open.
std::optional<std::vector<std::string>> cells(const std::string& line) {
  std::vector<std::string> result(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') result.back() += line[++i];
    else if (line[i] == '"') quoted = !quoted;
    else if (line[i] == ',' && !quoted) result.emplace_back();
    else result.back() += line[i];
  }
  if (quoted) return {};
  for (std::string& cell : result) cell = trimmed(cell);
  return result;
}

/// Keys of the header; false after a problem.
bool readHeader(const std::string& line, const std::string& where, std::vector<std::string>& keys, Problems& problems) {
  const auto names = cells(line);
  bool good = names.has_value();
  if (!good) problems.add({where, "header", shortened(line), "quotes in pairs"});
  for (std::size_t i = 0; good && i < names->size(); ++i) {
    const std::string key = trimmed((*names)[i].substr(0, (*names)[i].find('[')));
    const std::string column = "column " + std::to_string(i + 1);
    if (key.empty()) problems.add({where, column, "(empty)", "a dotted key of the configuration, for instance subsystems.mast.stiffness"});
    else if (std::find(keys.begin(), keys.end(), key) != keys.end()) problems.add({where, column, key, "a key that no other column has"});
    else if (key.find('=') != std::string::npos) problems.add({where, column, key, "a key alone; the values stand below"});
    else {
      keys.push_back(key);
      continue;
    }
    good = false;
  }
  return good;
}

void parseCsv(const std::string& text, const std::string& name, SweepAxis& axis, Problems& problems) {
  std::istringstream lines(text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? text.substr(3) : text);  // without a byte order mark
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    const std::string where = name + ":" + std::to_string(number), content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    if (axis.keys.empty()) {
      if (!readHeader(content, where, axis.keys, problems)) return;  // rows cannot be understood without it
      continue;
    }
    const auto row = cells(content);
    if (!row) problems.add({where, "row", shortened(content), "quotes in pairs"});
    else if (row->size() != axis.keys.size()) problems.add({where, "row", std::to_string(row->size()) + " cells", std::to_string(axis.keys.size()) + ", one for each key of the header"});
    else axis.points.push_back(*row);
  }
}

/// One value as after `--set KEY=`, on one line.
std::string valueText(YAML::Node value) {
  if (value.IsSequence() || value.IsMap()) value.SetStyle(YAML::EmitterStyle::Flow);
  return trimmed(shortened(yamlText(value), std::string::npos));
}

/// The runs of a YAML list, collected key by key.
class YamlRuns {
 public:
  YamlRuns(const Document& document, SweepAxis& axis, Problems& problems) : document_(document), axis_(axis), problems_(problems) {}

  void read() {
    if (!document_.root.IsSequence() || document_.root.size() == 0) {
      problems_.add({document_.place(""), "runs", asWritten(document_.root), "a list of runs"});
      return;
    }
    for (std::size_t i = 0; i < document_.root.size(); ++i) {
      const std::string place = std::to_string(i);
      axis_.points.emplace_back(axis_.keys.size());
      readRun(document_.root[i], place);
    }
    for (auto& point : axis_.points) point.resize(axis_.keys.size());
  }

 private:
  void readRun(const YAML::Node& run, const std::string& place) {
    if (run.IsMap() && run.size() > 0) return readMapping(run, place, "");
    bool good = run.IsSequence() && run.size() > 0;
    for (std::size_t i = 0; good && i < run.size(); ++i) good = run[i].IsScalar() && run[i].Scalar().find('=') != std::string::npos && run[i].Scalar().front() != '=';
    if (!good) {
      problems_.add({document_.place(place), "run " + std::to_string(axis_.points.size()), asWritten(run), "a list of KEY=VALUE, or a mapping as in the configuration"});
      return;
    }
    for (std::size_t i = 0; i < run.size(); ++i) {
      const std::string& word = run[i].Scalar();
      const std::size_t equals = word.find('=');
      take(word.substr(0, equals), trimmed(word.substr(equals + 1)), place + "." + std::to_string(i));
    }
  }

  void readMapping(const YAML::Node& node, const std::string& place, const std::string& key) {
    for (const auto& entry : node) {
      const std::string& name = entry.first.Scalar();
      const std::string inner = key.empty() ? name : key + "." + name;
      if (entry.second.IsMap() && entry.second.size() > 0) readMapping(entry.second, place + "." + name, inner);
      else take(inner, entry.second.IsNull() ? "" : valueText(entry.second), place + "." + name);
    }
  }

  void take(const std::string& key, const std::string& value, const std::string& place) {
    if (value.empty()) {
      problems_.add({document_.place(place), key, "(empty)", "a value"});
      return;
    }
    const std::size_t column = static_cast<std::size_t>(std::find(axis_.keys.begin(), axis_.keys.end(), key) - axis_.keys.begin());
    if (column == axis_.keys.size()) axis_.keys.push_back(key);
    std::vector<std::string>& point = axis_.points.back();
    point.resize(axis_.keys.size());
    if (!point[column].empty()) problems_.add({document_.place(place), key, value, "this key once in a run"});
    point[column] = value;
  }

  const Document& document_;
  SweepAxis& axis_;
  Problems& problems_;
};

}  // namespace

SweepAxis parseSweepFile(const std::string& text, const std::string& name, Problems& problems) {
  SweepAxis axis = {name, {}, {}};
  const std::size_t before = problems.list().size();
  const std::string extension = std::filesystem::path(name).extension().string();
  if (extension == ".csv") {
    parseCsv(text, name, axis, problems);
  } else if (extension == ".yaml" || extension == ".yml") {
    const Document document = readDocument(text, name, problems);
    if (document.root.IsDefined()) YamlRuns(document, axis, problems).read();
  } else {
    problems.add({"command line", "--sweep-file", name, "a name that ends in .csv, .yaml or .yml"});
  }
  if (problems.list().size() > before) return axis;
  if (axis.points.empty()) problems.add({name, "runs", "nothing", "a header line of keys and at least one line of values"});
  if (axis.points.size() > kMostRuns) problems.add({name, "runs", std::to_string(axis.points.size()), "at most " + std::to_string(kMostRuns)});
  return axis;
}

SweepAxis readSweepFile(const std::string& file, Problems& problems) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();  // inserting nothing sets failbit, which an empty file may do; a directory sets errno
  if (!stream.is_open() || stream.bad() || errno == EISDIR) {
    problems.add({"command line", "--sweep-file", file, std::string("a file that can be read (") + std::strerror(errno) + ")"});
    return {file, {}, {}};
  }
  return parseSweepFile(text.str(), file, problems);
}

}  // namespace heerk_rotor
