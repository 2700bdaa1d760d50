#pragma once
#include <limits>
#include <string>
#include <vector>

#include "heerk_rotor/config/configuration.hpp"

namespace heerk_rotor {

/// Allowed values of a number.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  // low itself is not allowed
};
inline Range anyNumber() { return {}; }
inline Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true}; }
inline Range nonNegative() { return {0.0, std::numeric_limits<double>::infinity(), false}; }

/// One mapping of the configuration ("subsystems.rotor"). Each accessor reads one key, records a problem (with file:line,
/// value, unit and allowed range) instead of throwing, and remembers that the key is known; finish() then reports every
/// other key as unknown, with the nearest known one. After a problem the default is returned, so that reading goes on.
class Section {
 public:
  /// The mapping at `path`; an absent one reads as empty, anything else than a mapping is a problem.
  Section(const Configuration& configuration, std::string path, Problems& problems);
  Section(const Section&) = default;
  Section& operator=(const Section&) = delete;  // assigning a YAML::Node would change the tree

  const std::string& path() const { return path_; }
  bool has(const std::string& key) const;
  Problems& problems() { return *problems_; }

  double number(const std::string& key, double fallback, const std::string& unit, Range range = anyNumber());
  double requiredNumber(const std::string& key, const std::string& unit, Range range = anyNumber());
  /// A list of `size` numbers, or one number for all of them.
  std::vector<double> numbers(const std::string& key, std::size_t size, double fallback, const std::string& unit, Range range = anyNumber());
  /// A list of any length of at least one number; a single number is a list of one.
  std::vector<double> list(const std::string& key, const std::vector<double>& fallback, const std::string& unit, Range range = anyNumber());
  long integer(const std::string& key, long fallback, long low, long high);
  bool flag(const std::string& key, bool fallback);
  std::string word(const std::string& key, const std::string& fallback, const std::vector<std::string>& allowed = {});
  /// A list of words; one word alone is a list of one.
  std::vector<std::string> words(const std::string& key);
  /// The keys that are there, in order; does not make them known.
  std::vector<std::string> keys() const;
  /// The value as written ("" when absent), for keys that take a number or a word; never a problem.
  std::string text(const std::string& key);
  /// A nested mapping; empty when absent. The caller must finish() it.
  Section child(const std::string& key);

  /// Records a problem about a key of this section.
  void problem(const std::string& key, const std::string& expected);

  /// Reports unknown keys, each once however often it is called.
  void finish();

 private:
  YAML::Node lookup(const std::string& key);
  void numberProblem(const std::string& path, const YAML::Node& value, const std::string& expected, const std::string& unit);
  const Configuration* configuration_;
  std::string path_;
  Problems* problems_;
  YAML::Node node_;
  std::vector<std::string> known_;
};

}  // namespace heerk_rotor
