#include "heerk_rotor/tools/command_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "heerk_rotor/config/problems.hpp"
#include "heerk_rotor/core/nearest_name.hpp"

namespace heerk_rotor {
namespace {

const std::vector<std::string> kColumns = {"time", "collective", "lateral_cyclic", "longitudinal_cyclic"};

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  std::size_t begin = 0;
  while (begin <= line.size()) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    result.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return result;
}

/// Position of each of kColumns in the file; empty after a problem.
std::vector<std::size_t> readHeader(const std::string& line, const std::string& where, Problems& problems) {
  const std::size_t problems_before = problems.list().size();
  std::vector<std::size_t> position(kColumns.size(), std::string::npos);
  const std::vector<std::string> names = cells(line);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t bracket = names[i].find('[');
    const std::string name = trimmed(names[i].substr(0, bracket));
    const auto known = std::find(kColumns.begin(), kColumns.end(), name);
    if (known == kColumns.end()) {
      problems.add({where, "column " + std::to_string(i + 1), names[i].empty() ? "(empty)" : names[i],
                    "time, collective, lateral_cyclic or longitudinal_cyclic" + didYouMean(name, kColumns)});
      continue;
    }
    const std::string unit = bracket == std::string::npos ? "" : names[i].substr(bracket);
    const std::string right_unit = name == "time" ? "[s]" : "[rad]";
    if (!unit.empty() && unit != right_unit) problems.add({where, name, unit, "the unit " + right_unit});
    std::size_t& entry = position[known - kColumns.begin()];
    if (entry != std::string::npos) problems.add({where, name, "two columns", "one"});
    entry = i;
  }
  for (std::size_t k = 0; k < kColumns.size(); ++k)
    if (position[k] == std::string::npos)
      problems.add({where, kColumns[k], "no such column", "a header line with time, collective, lateral_cyclic, longitudinal_cyclic"});
  if (problems.list().size() > problems_before) position.clear();
  return position;
}

/// Fills one row; false after a problem.
bool readRow(const std::string& line, const std::vector<std::size_t>& position, const std::string& where, CommandRow& row,
             Problems& problems) {
  const std::vector<std::string> words = cells(line);
  if (words.size() != kColumns.size()) {
    problems.add({where, "row", std::to_string(words.size()) + " cells", std::to_string(kColumns.size())});
    return false;
  }
  bool good = true;
  for (std::size_t k = 0; k < kColumns.size(); ++k) {
    const std::string& word = words[position[k]];
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (word.empty() || end != word.c_str() + word.size() || !std::isfinite(value)) {
      problems.add({where, kColumns[k], word.empty() ? "(empty)" : word, std::string("a finite number ") + (k == 0 ? "[s]" : "[rad]")});
      good = false;
    }
    (k == 0 ? row.time : row.commands[k - 1]) = value;
  }
  return good;
}

}  // namespace

std::vector<CommandRow> parseCommandFile(const std::string& text, const std::string& name) {
  Problems problems;
  std::vector<CommandRow> rows;
  std::vector<std::size_t> position;
  bool header_seen = false;
  std::istringstream lines(text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? text.substr(3) : text);  // without a byte order mark
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#') continue;
    const std::string where = name + ":" + std::to_string(number);
    if (!header_seen) {
      header_seen = true;
      position = readHeader(line, where, problems);
      if (position.empty()) break;  // rows cannot be understood without it
      continue;
    }
    CommandRow row;
    if (!readRow(line, position, where, row, problems)) continue;
    if (!rows.empty() && row.time <= rows.back().time) {
      std::ostringstream found, expected;
      found.precision(17);
      expected.precision(17);
      found << row.time;
      expected << "a time after that of the row before (" << rows.back().time << " s)";
      problems.add({where, "time", found.str(), expected.str()});
      continue;
    }
    rows.push_back(row);
  }
  if (problems.empty() && rows.empty())
    problems.add({name, header_seen ? "rows" : "header", "nothing", "a header line and at least one row of commands"});
  if (!problems.empty()) throw ConfigurationError(problems);
  return rows;
}

std::vector<CommandRow> readCommandFile(const std::string& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();  // inserting nothing sets failbit, which an empty file may do; a directory sets errno
  if (!stream.is_open() || stream.bad() || errno == EISDIR) {
    Problems problems;
    problems.add({"command line", "--commands", file, std::string("a file that can be read (") + std::strerror(errno) + ")"});
    throw ConfigurationError(problems);
  }
  return parseCommandFile(text.str(), file);
}

CommandSchedule::CommandSchedule(std::vector<CommandRow> rows, std::array<Index, 3> entries, double slack)
    : rows_(std::move(rows)), entries_(entries), slack_(slack) {}

void CommandSchedule::apply(double t, Vector& w) noexcept {
  const std::size_t before = next_;
  while (next_ < rows_.size() && rows_[next_].time <= t + slack_) ++next_;
  if (next_ == before) return;
  for (std::size_t k = 0; k < entries_.size(); ++k) w[entries_[k]] = rows_[next_ - 1].commands[k];
}

}  // namespace heerk_rotor
