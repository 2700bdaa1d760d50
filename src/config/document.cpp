#include "heerk_rotor/config/document.hpp"

#include <sstream>
#include <vector>

#include "heerk_rotor/config/yaml_value.hpp"

namespace heerk_rotor {
namespace {

constexpr int kMaxDepth = 32;          // far beyond any real configuration; an alias inside itself would go on for ever
constexpr int kMaxValues = 100000;     // aliases of aliases can unfold to any size

const char* const kSignalMapping = "trim.targets";  // the one mapping whose keys are names of signals, subsystem.name

std::string join(const std::string& key, const std::string& name) { return key.empty() || name.empty() ? key + name : key + "." + name; }

bool isSignalName(const std::string& name) {
  const std::size_t dot = name.find('.');
  return dot != std::string::npos && dot > 0 && dot + 1 < name.size() && name.find('.', dot + 1) == std::string::npos;
}

std::string lineOf(const std::string& name, const YAML::Mark& mark) {
  return mark.is_null() ? name : name + ":" + std::to_string(mark.line + 1);  // yaml-cpp counts from 0
}

std::string lineText(const std::string& text, int line) {
  std::istringstream lines(text);
  std::string result;
  for (int i = 0; i <= line && std::getline(lines, result); ++i) {
  }
  const std::size_t begin = result.find_first_not_of(" \t");
  return begin == std::string::npos ? "(end of text)" : shortened(result.substr(begin));
}

/// YAML allows none, and yaml-cpp silently ends the document at some of them.
bool hasControlCharacters(const std::string& text, const std::string& name, Problems& problems) {
  int line = 0;
  for (const char c : text) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (c == '\n') ++line;
    if ((byte >= 0x20 && byte != 0x7F) || c == '\n' || c == '\r' || c == '\t') continue;
    problems.add({name + ":" + std::to_string(line + 1), "", "control character number " + std::to_string(byte), "text in YAML"});
    return true;
  }
  return false;
}

/// Copies the tree that yaml-cpp built, noting the place of every value and everything that must not be there.
class Copier {
 public:
  Copier(const std::string& name, const std::string& at, Document& document, Problems& problems)
      : name_(name), at_(at), document_(document), problems_(problems) {}

  YAML::Node copy(const YAML::Node& source, const std::string& key, int depth = 0) {
    if (exhausted_ || depth > kMaxDepth || ++values_ > kMaxValues) {
      if (!exhausted_) {
        problems_.add({lineOf(name_, source.Mark()), key, "(nested without end)",
                       "at most " + std::to_string(kMaxDepth) + " levels and " + std::to_string(kMaxValues) + " values, aliases written out"});
      }
      exhausted_ = true;
      return YAML::Node(YAML::NodeType::Null);
    }
    const std::string& tag = source.Tag();
    if (!tag.empty() && tag != "?" && tag != "!") {
      problems_.add({lineOf(name_, source.Mark()), key, "tag " + shortened(tag), "a value without a tag"});
    }
    if (source.IsMap()) return copyMapping(source, key, depth);
    if (source.IsSequence()) return copyList(source, key, depth);
    if (!source.IsScalar()) return YAML::Node(YAML::NodeType::Null);
    YAML::Node result(source.Scalar());
    result.SetTag(tag);  // "!" marks quoted text
    return result;
  }

 private:
  YAML::Node copyMapping(const YAML::Node& source, const std::string& key, int depth) {
    YAML::Node result(YAML::NodeType::Map);
    result.SetStyle(source.Style());
    std::map<std::string, std::string> seen;  // name -> place
    for (const auto& entry : source) {
      const std::string place = lineOf(name_, entry.first.Mark());
      if (join(at_, key) == kSignalMapping && entry.first.IsScalar() && isSignalName(entry.first.Scalar())) {
        copySignalValue(entry, key, result, seen, place, depth);
        continue;
      }
      const bool plain = entry.first.IsScalar() && !entry.first.Scalar().empty() && entry.first.Scalar().find('.') == std::string::npos;
      if (!plain) {
        problems_.add({place, key, asWritten(entry.first), "a name without dots as key"});
        continue;
      }
      const std::string& name = entry.first.Scalar();
      const std::string path = key.empty() ? name : key + "." + name;
      const auto inserted = seen.emplace(name, place);
      if (!inserted.second) {
        problems_.add({place, path, asWritten(entry.second), "this key once; it is given already at " + inserted.first->second});
        continue;
      }
      document_.places[path] = place;
      result.force_insert(name, copy(entry.second, path, depth + 1));
    }
    return result;
  }

  /// `rotor.thrust: 1.0` among names of signals stands for `rotor: {thrust: 1.0}`.
  void copySignalValue(const YAML::detail::iterator_value& entry, const std::string& key, YAML::Node& result, std::map<std::string, std::string>& seen, const std::string& place, int depth) {
    const std::string& signal = entry.first.Scalar();
    const std::size_t dot = signal.find('.');
    const std::string subsystem = signal.substr(0, dot), path = join(key, signal);
    const auto inserted = seen.emplace(signal, place);
    if (!inserted.second) {
      problems_.add({place, path, asWritten(entry.second), "this key once; it is given already at " + inserted.first->second});
      return;
    }
    if (seen.emplace(subsystem, place).second) {
      result.force_insert(subsystem, YAML::Node(YAML::NodeType::Map));
      document_.places[join(key, subsystem)] = place;
    }
    YAML::Node inner = findChild(result, subsystem);
    if (!inner.IsMap()) {
      problems_.add({place, path, asWritten(entry.second), "one way of writing the signals of " + subsystem});
      return;
    }
    document_.places[path] = place;
    inner.force_insert(signal.substr(dot + 1), copy(entry.second, path, depth + 1));
  }

  YAML::Node copyList(const YAML::Node& source, const std::string& key, int depth) {
    YAML::Node result(YAML::NodeType::Sequence);
    result.SetStyle(source.Style());
    int index = 0;
    for (const auto& element : source) {
      const std::string path = (key.empty() ? "" : key + ".") + std::to_string(index++);
      document_.places[path] = lineOf(name_, element.Mark());
      result.push_back(copy(element, path, depth + 1));
    }
    return result;
  }

  const std::string& name_;
  const std::string& at_;  // where the root of this text will be
  Document& document_;
  Problems& problems_;
  int values_ = 0;
  bool exhausted_ = false;
};

}  // namespace

std::string Document::place(const std::string& dotted_key) const {
  std::string key = dotted_key;
  while (true) {
    const auto found = places.find(key);
    if (found != places.end()) return found->second;
    if (key.empty()) return "";
    const std::size_t dot = key.rfind('.');
    key = dot == std::string::npos ? "" : key.substr(0, dot);
  }
}

Document readDocument(const std::string& text, const std::string& name, Problems& problems, const std::string& at) {
  Document document{YAML::Node(YAML::NodeType::Undefined), {{"", name}}};
  if (hasControlCharacters(text, name, problems)) return document;
  std::vector<YAML::Node> roots;
  try {
    for (const YAML::Node& root : YAML::LoadAll(text)) {
      if (root.IsDefined() && !root.IsNull()) roots.push_back(root);
    }
  } catch (const YAML::Exception& error) {
    const std::string found = error.mark.is_null() ? "(unreadable)" : lineText(text, error.mark.line);
    problems.add({lineOf(name, error.mark), "", found, "valid YAML; the parser says: " + error.msg});
    return document;
  }
  if (roots.empty()) {
    problems.add({name, "", "nothing but white space and comments", "a YAML document"});
    return document;
  }
  if (roots.size() > 1) {
    problems.add({lineOf(name, roots[1].Mark()), "", "a second YAML document", "one document"});
  }
  document.places[""] = lineOf(name, roots[0].Mark());
  document.root.reset(Copier(name, at, document, problems).copy(roots[0], ""));
  return document;
}

}  // namespace heerk_rotor
