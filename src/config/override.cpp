#include <algorithm>
#include <sstream>
#include <vector>

#include "heerk_rotor/config/document.hpp"
#include "heerk_rotor/config/yaml_value.hpp"
#include "heerk_rotor/core/nearest_name.hpp"

namespace heerk_rotor {
namespace {

constexpr std::size_t kMaxKeys = 2000;  // a hint need not search tables of any size

std::string join(const std::string& parent, const std::string& name) { return parent.empty() ? name : parent + "." + name; }

/// The names within "a.b.c"; empty when one of them is.
std::vector<std::string> split(const std::string& dotted_key) {
  std::vector<std::string> names(1);
  for (const char c : dotted_key) {
    if (c == '.') {
      names.emplace_back();
    } else {
      names.back() += c;
    }
  }
  const bool hole = std::any_of(names.begin(), names.end(), [](const std::string& name) { return name.empty(); });
  return hole ? std::vector<std::string>{} : names;
}

std::vector<std::string> childNames(const YAML::Node& parent) {
  std::vector<std::string> names;
  if (parent.IsMap()) {
    for (const auto& entry : parent) names.push_back(entry.first.Scalar());
  }
  if (parent.IsSequence()) {
    for (std::size_t i = 0; i < parent.size(); ++i) names.push_back(std::to_string(i));
  }
  return names;
}

void collectKeys(const YAML::Node& value, const std::string& key, std::vector<std::string>& keys) {
  if (!key.empty()) keys.push_back(key);
  if (keys.size() > kMaxKeys) return;
  for (const std::string& name : childNames(value)) collectKeys(findChild(value, name), join(key, name), keys);
}

/// The mappings that a file may leave out although their contents are known.
bool mayBeCreated(const std::vector<std::string>& names) {
  return (names.size() == 1 && (names[0] == "simulation" || names[0] == "trim")) || (names.size() == 2 && names[0] == "trim" && names[1] == "targets") ||
         (names.size() == 3 && names[0] == "trim" && names[1] == "targets") || (names.size() == 3 && names[0] == "subsystems" && names[2] == "initial");
}

/// Says which existing key may be meant, when `name` does not exist within the value at `parent_key`.
std::string hint(const Document& document, const std::string& key, const std::string& parent_key, const YAML::Node& parent, const std::string& name) {
  const std::vector<std::string> siblings = childNames(parent);
  const std::string sibling = nearestName(name, siblings);
  std::vector<std::string> keys;
  if (sibling.empty()) {
    collectKeys(document.root, "", keys);
  } else {
    // The misspelt name decides first: a long common beginning would make keys of any other mapping "near".
    collectKeys(findChild(parent, sibling), join(parent_key, sibling), keys);
  }
  std::string nearest = nearestName(key, keys);
  if (nearest.empty() && !sibling.empty()) nearest = join(parent_key, sibling);
  if (!nearest.empty()) return " (did you mean '" + nearest + "'?)";
  std::string list;
  for (const std::string& known : siblings) list += (list.empty() ? "" : ", ") + known;
  return list.empty() ? "" : "; " + (parent_key.empty() ? std::string("known here") : "known in " + parent_key) + ": " + list;
}

void erasePlaces(Document& document, const std::string& key) {
  auto& places = document.places;
  for (auto it = places.lower_bound(key); it != places.end() && it->first.compare(0, key.size(), key) == 0;) {
    const bool within = it->first.size() == key.size() || it->first[key.size()] == '.';
    it = within ? places.erase(it) : std::next(it);
  }
}

void removeOther(Document& document, const std::string& key) {
  for (const auto& pair : {std::make_pair("step", "azimuth_step_deg"), std::make_pair("azimuth_step_deg", "step")}) {
    if (key != std::string("simulation.") + pair.first) continue;
    document.root["simulation"].remove(pair.second);
    erasePlaces(document, std::string("simulation.") + pair.second);
  }
}

}  // namespace

void applyOverride(Document& document, const std::string& assignment, Problems& problems) {
  const std::size_t equals = assignment.find('=');
  const std::string key = assignment.substr(0, equals);
  const std::vector<std::string> names = split(key);
  const std::string place = "--set " + key;
  const std::string written = equals == std::string::npos ? "" : assignment.substr(equals + 1);
  if (equals == std::string::npos || names.empty()) {
    problems.add({"--set " + assignment, "", "'" + assignment + "'", "KEY=VALUE with a dotted key, for instance simulation.step=1e-3"});
    return;
  }
  Problems inside;
  const Document value = readDocument(written, place, inside, key);
  if (!inside.empty()) {
    const Problem& first = inside.list().front();
    const std::string found = written.empty() ? "(empty)" : shortened(written);
    problems.add({place, key, found, written.empty() ? "a value after '='" : first.expected});
    return;
  }

  // Walk to the mapping or list that holds the last name.
  YAML::Node parent(document.root);
  std::string parent_key;
  for (std::size_t i = 0; i + 1 < names.size(); ++i) {
    YAML::Node child = findChild(parent, names[i]);
    if (!child.IsDefined() && parent.IsMap() && mayBeCreated({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i) + 1})) {
      child.reset(YAML::Node(YAML::NodeType::Map));
      parent[names[i]] = child;
    }
    if (!child.IsDefined()) {
      problems.add({place, key, shortened(written), "a known key" + hint(document, key, parent_key, parent, names[i]), "", true});
      return;
    }
    if (child.IsNull()) child = YAML::Node(YAML::NodeType::Map);  // `initial:` with nothing after it
    parent.reset(child);
    parent_key = join(parent_key, names[i]);
  }

  const std::string& name = names.back();
  if (parent.IsMap()) {
    parent[name] = value.root;
  } else if (parent.IsSequence() && findChild(parent, name).IsDefined()) {
    parent[std::stoul(name)] = value.root;
  } else if (parent.IsSequence()) {
    problems.add({place, key, shortened(written), "an index from 0 to " + std::to_string(parent.size() - 1) + ", because " + parent_key + " is a list of " + std::to_string(parent.size()), "", true});
    return;
  } else {
    problems.add({place, key, shortened(written), "a key within a mapping or list, but " + parent_key + " is one value, " + asWritten(parent), "", true});
    return;
  }
  erasePlaces(document, key);
  document.places[key] = place;
  removeOther(document, key);
}

}  // namespace heerk_rotor
