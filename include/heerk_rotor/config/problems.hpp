#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace heerk_rotor {

/// One thing wrong with a configuration.
struct Problem {
  std::string where;     // "config/bo105.yaml:12" or "--set subsystems.mast.stiffness"
  std::string key;       // full dotted key
  std::string found;     // the value as written
  std::string expected;  // what would be right, with unit and range; may carry "did you mean"
  std::string unit = {};     // of the number expected here; empty for what is no number or has none
  bool unknown_key = false;  // nothing is called so; otherwise the value is wrong
};

/// Collects everything wrong before giving up, so that a user mends a file once.
class Problems {
 public:
  void add(Problem problem) { list_.push_back(std::move(problem)); }
  bool empty() const { return list_.empty(); }
  const std::vector<Problem>& list() const { return list_; }
  /// One line per problem: "WHERE: KEY = FOUND: expected EXPECTED".
  std::string text() const;

 private:
  std::vector<Problem> list_;
};

/// Thrown when a configuration cannot be used; what() holds all problems, one per line.
struct ConfigurationError : std::runtime_error {
  explicit ConfigurationError(const Problems& problems);
  Problems problems;
};

}  // namespace heerk_rotor
