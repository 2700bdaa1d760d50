#pragma once
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace heerk_rotor {

/// A folder of its own for one test, removed afterwards.
class TestFolder {
 public:
  TestFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "heerk_rotor_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a folder like " + name);
    path_ = name;
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

  /// Writes a file and returns its name.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }

 private:
  std::filesystem::path path_;
};

inline std::string readText(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file + ": cannot be read");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A CSV file as text cells, header apart.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  std::size_t column(const std::string& cell) const {
    for (std::size_t i = 0; i < header.size(); ++i)
      if (header[i] == cell) return i;
    throw std::out_of_range("no column " + cell);
  }
  double number(std::size_t row, const std::string& cell) const { return std::strtod(rows.at(row).at(column(cell)).c_str(), nullptr); }
};

inline Table parseTable(const std::string& text) {
  const auto cells = [](const std::string& line) {
    std::vector<std::string> result(1);
    bool quoted = false;
    for (const char c : line)
      if (c == '"') quoted = !quoted;
      else if (c == ',' && !quoted) result.emplace_back();
      else result.back() += c;
    return result;
  };
  Table table;
  std::istringstream lines(text);
  std::string line;
  if (std::getline(lines, line)) table.header = cells(line);
  while (std::getline(lines, line)) table.rows.push_back(cells(line));
  return table;
}

}  // namespace heerk_rotor
