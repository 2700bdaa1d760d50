#include "heerk_rotor/config/section.hpp"

#include <algorithm>
#include <locale>
#include <sstream>

#include "heerk_rotor/config/yaml_value.hpp"
#include "heerk_rotor/core/nearest_name.hpp"

namespace heerk_rotor {
namespace {

bool contains(const Range& range, double value) {
  const bool above = range.low_open ? value > range.low : value >= range.low;
  return above && value <= range.high;
}

/// "a number in (0, 0.1] [rad/s]", "a number > 0 [kg]", "a number [m]".
std::string describe(const Range& range, const std::string& unit) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(12);
  const bool has_low = range.low > -std::numeric_limits<double>::infinity();
  const bool has_high = range.high < std::numeric_limits<double>::infinity();
  text << "a number";
  if (has_low && has_high) {
    text << " in " << (range.low_open ? '(' : '[') << range.low << ", " << range.high << ']';
  } else if (has_low) {
    text << (range.low_open ? " > " : " >= ") << range.low;
  } else if (has_high) {
    text << " <= " << range.high;
  }
  if (!unit.empty()) text << " [" << unit << ']';
  return text.str();
}

/// Some number in the range, with which a model can be built after a problem with a required value.
double placeholder(const Range& range) {
  if (contains(range, 1.0)) return 1.0;
  if (range.high < std::numeric_limits<double>::infinity()) return range.high;
  return range.low_open ? range.low + 1.0 : range.low;
}

std::string enumeration(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

Section::Section(const Configuration& configuration, std::string path, Problems& problems)
    : configuration_(&configuration), path_(std::move(path)), problems_(&problems), node_(findValue(configuration.root(), path_)) {
  if (node_.IsDefined() && !node_.IsMap() && !node_.IsNull()) {
    problems_->add({configuration.where(path_), path_, asWritten(node_), "a mapping of keys to values"});
  }
}

YAML::Node Section::lookup(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  return node_.IsDefined() && node_.IsMap() ? findChild(node_, key) : YAML::Node(YAML::NodeType::Undefined);
}

bool Section::has(const std::string& key) const { return node_.IsDefined() && node_.IsMap() && findChild(node_, key).IsDefined(); }

double Section::number(const std::string& key, double fallback, const std::string& unit, Range range) {
  const YAML::Node value = lookup(key);
  double result = fallback;
  if (!value.IsDefined()) return fallback;
  if (readNumber(value, result) && contains(range, result)) return result;
  numberProblem(path_ + "." + key, value, describe(range, unit), unit);
  return fallback;
}

double Section::requiredNumber(const std::string& key, const std::string& unit, Range range) {
  if (!lookup(key).IsDefined()) problem(key, describe(range, unit));
  return number(key, placeholder(range), unit, range);
}

std::vector<double> Section::numbers(const std::string& key, std::size_t size, double fallback, const std::string& unit, Range range) {
  const YAML::Node value = lookup(key);
  std::vector<double> result(size, fallback);
  if (!value.IsDefined()) return result;
  if (value.IsScalar()) return std::vector<double>(size, number(key, fallback, unit, range));
  if (!value.IsSequence() || value.size() != size) {
    const std::string found = value.IsSequence() ? ", not of " + std::to_string(value.size()) : "";
    numberProblem(path_ + "." + key, value, describe(range, unit) + ", or a list of " + std::to_string(size) + " such numbers" + found, unit);
    return result;
  }
  for (std::size_t i = 0; i < size; ++i) {
    double element = 0.0;
    if (readNumber(value[i], element) && contains(range, element)) {
      result[i] = element;
    } else {
      const std::string path = path_ + "." + key + "." + std::to_string(i);
      numberProblem(path, value[i], describe(range, unit), unit);
    }
  }
  return result;
}

std::vector<double> Section::list(const std::string& key, const std::vector<double>& fallback, const std::string& unit, Range range) {
  const YAML::Node value = lookup(key);
  if (!value.IsDefined()) return fallback;
  if (value.IsSequence() && value.size() > 0) return numbers(key, value.size(), 0.0, unit, range);
  if (value.IsScalar()) return {number(key, fallback.empty() ? 0.0 : fallback.front(), unit, range)};
  numberProblem(path_ + "." + key, value, describe(range, unit) + ", or a list of such numbers", unit);
  return fallback;
}

long Section::integer(const std::string& key, long fallback, long low, long high) {
  const YAML::Node value = lookup(key);
  long result = fallback;
  if (!value.IsDefined()) return fallback;
  if (readInteger(value, result) && result >= low && result <= high) return result;
  problem(key, "a whole number in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
  return fallback;
}

bool Section::flag(const std::string& key, bool fallback) {
  const YAML::Node value = lookup(key);
  if (!value.IsDefined()) return fallback;
  if (value.IsScalar() && !isQuoted(value) && (value.Scalar() == "true" || value.Scalar() == "false")) return value.Scalar() == "true";
  problem(key, "true or false");
  return fallback;
}

std::string Section::word(const std::string& key, const std::string& fallback, const std::vector<std::string>& allowed) {
  const YAML::Node value = lookup(key);
  if (!value.IsDefined()) return fallback;
  if (!value.IsScalar() || value.Scalar().empty()) {
    problem(key, allowed.empty() ? "a word" : "one of " + enumeration(allowed));
    return fallback;
  }
  const std::string& word = value.Scalar();
  if (allowed.empty() || std::find(allowed.begin(), allowed.end(), word) != allowed.end()) return word;
  problem(key, "one of " + enumeration(allowed) + didYouMean(word, allowed));
  return fallback;
}

std::vector<std::string> Section::words(const std::string& key) {
  const YAML::Node value = lookup(key);
  if (!value.IsDefined()) return {};
  std::vector<std::string> result;
  bool good = (value.IsSequence() && value.size() > 0) || (value.IsScalar() && !value.Scalar().empty());
  if (good && value.IsScalar()) return {value.Scalar()};
  for (std::size_t i = 0; good && i < value.size(); ++i) {
    good = value[i].IsScalar() && !value[i].Scalar().empty();
    if (good) result.push_back(value[i].Scalar());
  }
  if (good) return result;
  problem(key, "a word, or a list of words");
  return {};
}

std::vector<std::string> Section::keys() const {
  std::vector<std::string> result;
  if (node_.IsDefined() && node_.IsMap())
    for (const auto& entry : node_) result.push_back(entry.first.Scalar());
  return result;
}

std::string Section::text(const std::string& key) {
  const YAML::Node value = lookup(key);
  return value.IsDefined() ? asWritten(value) : "";
}

Section Section::child(const std::string& key) {
  lookup(key);
  return Section(*configuration_, path_ + "." + key, *problems_);
}

void Section::problem(const std::string& key, const std::string& expected) {
  const std::string path = path_ + "." + key;
  problems_->add({configuration_->where(path), path, asWritten(findValue(configuration_->root(), path)), expected});
}

void Section::numberProblem(const std::string& path, const YAML::Node& value, const std::string& expected, const std::string& unit) {
  problems_->add({configuration_->where(path), path, asWritten(value), expected, unit});
}

void Section::finish() {
  if (!node_.IsDefined() || !node_.IsMap()) return;
  std::vector<std::string> unknown;
  for (const auto& entry : node_) {
    const std::string& key = entry.first.Scalar();
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) unknown.push_back(key);
  }
  const std::string nothing_known = known_.empty() ? "no key here" : "one of the keys " + enumeration(known_);
  for (const std::string& key : unknown) {
    const std::string nearest = didYouMean(key, known_);
    const std::string path = path_ + "." + key;
    problems_->add({configuration_->where(path), path, asWritten(findChild(node_, key)), nearest.empty() ? nothing_known : "a known key" + nearest, "", true});
  }
  known_.insert(known_.end(), unknown.begin(), unknown.end());
}

}  // namespace heerk_rotor
