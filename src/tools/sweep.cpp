#include "heerk_rotor/tools/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "heerk_rotor/config/yaml_value.hpp"
#include "heerk_rotor/tools/sweep_file.hpp"

namespace heerk_rotor {
namespace {

/// Splits at a separator that is in no bracket and in no quotes.
std::vector<std::string> splitOutside(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = '\0';
  for (const char c : text) {
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == separator && depth == 0) {
      parts.emplace_back();
      continue;
    }
    parts.back() += c;
  }
  return parts;
}

bool readNumber(const std::string& word, double& value) { return heerk_rotor::readNumber(YAML::Node(word), value); }

bool readCount(const std::string& word, std::uint64_t& count) {
  if (word.empty() || word.size() > 18 || word.find_first_not_of("0123456789") != std::string::npos) return false;
  count = std::strtoull(word.c_str(), nullptr, 10);
  return true;
}

/// 15 digits: a tenth of 1 reads 0.1, not 0.10000000000000001.
std::string rangeText(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.15g", value);
  return buffer;
}

/// The values of FROM:TO:COUNT[:log]; the ends are as written.
std::vector<std::string> expandRange(const std::string& item, const std::string& where, const std::string& key, Problems& problems) {
  const std::vector<std::string> parts = splitOutside(item, ':');
  const auto complain = [&](const std::string& expected) {
    problems.add({where, key, item, expected});
    return std::vector<std::string>();
  };
  if (parts.size() < 3 || parts.size() > 4) return complain("a range FROM:TO:COUNT or FROM:TO:COUNT:log; a value with a colon in quotes");
  double from = 0.0, to = 0.0;
  std::uint64_t count = 0;
  if (!readNumber(parts[0], from)) return complain("a number as the beginning of the range, not '" + parts[0] + "'");
  if (!readNumber(parts[1], to)) return complain("a number as the end of the range, not '" + parts[1] + "'");
  if (!readCount(parts[2], count) || count < 2 || count > kMostRuns)
    return complain("a whole number of values from 2 to " + std::to_string(kMostRuns) + ", not '" + parts[2] + "'; both ends belong to the range");
  const bool logarithmic = parts.size() == 4;
  if (logarithmic && parts[3] != "log") return complain("nothing or 'log' behind the number of values, not '" + parts[3] + "'");
  if (from == to) return complain("a range with two different ends");
  if (logarithmic && !(from * to > 0.0)) return complain("ends of one sign, neither of them zero, for equal ratios");

  std::vector<std::string> values = {parts[0]};
  for (std::uint64_t i = 1; i + 1 < count; ++i) {
    const double fraction = static_cast<double>(i) / static_cast<double>(count - 1);
    values.push_back(rangeText(logarithmic ? from * std::pow(to / from, fraction) : from + (to - from) * fraction));
  }
  values.push_back(parts[1]);
  return values;
}

/// Whether setting `later` replaces what was set at `earlier`.
bool replaces(const std::string& later, const std::string& earlier) {
  return earlier == later || (earlier.size() > later.size() && earlier[later.size()] == '.' && earlier.compare(0, later.size(), later) == 0);
}

struct SetKey {
  std::string where, key;
};

/// What is set first must not be set again by what comes later, or one of the two would be without effect.
void checkOverlaps(const SimulateOptions& options, const std::vector<SweepAxis>& axes, Problems& problems) {
  std::vector<SetKey> set;
  const auto find = [&set](const auto& condition) { return std::find_if(set.begin(), set.end(), condition); };
  for (const std::string& assignment : options.overrides) {
    const std::string key = assignment.substr(0, assignment.find('='));
    set.push_back({"--set " + key, key});
  }
  const std::size_t fixed = set.size();
  for (const SweepAxis& axis : axes)
    for (const std::string& key : axis.keys) {
      const auto twice = find([&](const SetKey& other) { return replaces(key, other.key); });
      if (twice != set.end()) problems.add({axis.where, key, "set twice", "a key that nothing else sets; " + twice->where + " does"});
      // Either of these removes the other from the configuration (Configuration::load).
      const std::string other_step = key == "simulation.step" ? "simulation.azimuth_step_deg" : key == "simulation.azimuth_step_deg" ? "simulation.step" : "";
      const auto step = std::find_if(set.begin() + static_cast<std::ptrdiff_t>(fixed), set.end(), [&](const SetKey& other) { return other.key == other_step; });
      if (step != set.end()) problems.add({axis.where, key, "swept beside " + other_step, "only one of the two: each defines the step"});
      if (key == "simulation.duration" && (options.duration || options.revolutions))
        problems.add({axis.where, key, "swept", "no --duration or --revolutions beside it, which would be the length of every run"});
      set.push_back({axis.where, key});
    }
}

/// The product of the sizes, without overflow; where it is too large it stays beyond kMostRuns.
std::uint64_t gridSize(const std::vector<SweepAxis>& axes) {
  std::uint64_t size = 1;
  for (const SweepAxis& axis : axes) {
    if (axis.points.empty()) return 0;
    size = size > kMostRuns ? size : size * axis.points.size();  // both at most 1e6: no overflow
  }
  return size;
}

std::string gridText(const std::vector<SweepAxis>& axes) {
  std::string text;
  for (const SweepAxis& axis : axes) text += (text.empty() ? "" : " x ") + std::to_string(axis.points.size());
  return text;
}

}  // namespace

Sweep::Sweep(std::vector<SweepAxis> axes) : axes_(std::move(axes)), size_(gridSize(axes_)) {}

std::vector<std::string> Sweep::keys() const {
  std::vector<std::string> all;
  for (const SweepAxis& axis : axes_) all.insert(all.end(), axis.keys.begin(), axis.keys.end());
  return all;
}

std::vector<std::string> Sweep::values(std::uint64_t run) const {
  std::vector<std::string> all;
  std::uint64_t block = size_;  // runs between two changes of an axis
  for (const SweepAxis& axis : axes_) {
    block /= axis.points.size();
    const std::vector<std::string>& point = axis.points[static_cast<std::size_t>(run / block % axis.points.size())];
    all.insert(all.end(), point.begin(), point.end());
  }
  return all;
}

std::vector<std::string> Sweep::overrides(std::uint64_t run) const {
  const std::vector<std::string> all_keys = keys(), all_values = values(run);
  std::vector<std::string> result;
  for (std::size_t i = 0; i < all_keys.size(); ++i)
    if (!all_values[i].empty()) result.push_back(all_keys[i] + "=" + all_values[i]);
  return result;
}

SimulateOptions Sweep::optionsOf(std::uint64_t run, SimulateOptions common) const {
  const std::vector<std::string> own = overrides(run);
  common.overrides.insert(common.overrides.end(), own.begin(), own.end());
  return common;
}

std::uint64_t Sweep::firstRunWith(std::size_t key) const {
  std::uint64_t block = size_;
  for (const SweepAxis& axis : axes_) {
    block /= axis.points.size();
    if (key >= axis.keys.size()) {
      key -= axis.keys.size();
      continue;
    }
    for (std::size_t i = 0; i < axis.points.size(); ++i)
      if (!axis.points[i][key].empty()) return i * block;
    break;
  }
  return 0;
}

SweepAxis parseSweepAxis(const std::string& text, Problems& problems) {
  const std::size_t equals = text.find('=');
  const std::string key = text.substr(0, equals);
  SweepAxis axis = {"--sweep " + key, {key}, {}};
  if (equals == std::string::npos || key.empty()) {
    problems.add({"--sweep", "", "'" + text + "'", "KEY=VALUE,VALUE,... or KEY=FROM:TO:COUNT, for instance subsystems.mast.stiffness=3e4,3e6,3e8"});
    return axis;
  }
  const std::string written = text.substr(equals + 1);
  if (written.empty()) {
    problems.add({axis.where, key, "(empty)", "at least one value behind '='"});
    return axis;
  }
  for (const std::string& item : splitOutside(written, ',')) {
    if (item.find_first_not_of(" \t") == std::string::npos) {
      problems.add({axis.where, key, shortened(written), "values separated by single commas"});
      return axis;
    }
    if (splitOutside(item, ':').size() == 1) axis.points.push_back({item});
    else
      for (std::string& value : expandRange(item, axis.where, key, problems)) axis.points.push_back({std::move(value)});
  }
  if (axis.points.size() > kMostRuns) problems.add({axis.where, key, std::to_string(axis.points.size()) + " values", "at most " + std::to_string(kMostRuns)});
  return axis;
}

Sweep readSweep(const SimulateOptions& options) {
  Problems problems;
  std::vector<SweepAxis> axes;
  if (!options.sweep_file.empty()) axes.push_back(readSweepFile(options.sweep_file, problems));
  for (const std::string& text : options.sweeps) axes.push_back(parseSweepAxis(text, problems));
  checkOverlaps(options, axes, problems);
  if (problems.empty() && gridSize(axes) > kMostRuns)
    problems.add({"command line", "sweep", "a grid of " + gridText(axes) + " runs", "at most " + std::to_string(kMostRuns) + " runs"});
  if (!problems.empty()) throw ConfigurationError(problems);
  return Sweep(std::move(axes));
}

}  // namespace heerk_rotor
