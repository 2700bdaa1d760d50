// Format, one item per line, independent of locale and machine:
//   heerk_rotor snapshot 1
//   step 1200
//   step0 0
//   epoch 0
//   t0 0x0p+0                  numbers: C hexadecimal floats, exact; not-a-number as nan:<bit pattern>
//   h 0x1p-9
//   x 14                       then 14 lines of one number each; w and solver_cache alike
//   configuration 20           then 20 lines of text, two blanks before each
//   end 4711 0123456789abcdef  number of bytes before this line and their FNV-1a hash
#include "heerk_rotor/assembly/snapshot.hpp"

#include <locale.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "heerk_rotor/assembly/file_replacement.hpp"

namespace heerk_rotor {
namespace {

const std::string kMagic = "heerk_rotor snapshot ";

[[noreturn]] void fail(const std::string& file, const std::string& what) { throw std::runtime_error("snapshot " + file + ": " + what); }

std::uint64_t fnv1a(const char* text, std::size_t size) {
  std::uint64_t hash = 14695981039346656037ull;
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ static_cast<unsigned char>(text[i])) * 1099511628211ull;
  return hash;
}

std::string hexadecimal(std::uint64_t value) {
  std::string digits(16, '0');
  for (std::size_t i = 16; i-- > 0; value >>= 4) digits[i] = "0123456789abcdef"[value & 15u];
  return digits;
}

// ---- writing ----

class Text {
 public:
  Text() {
    stream_.imbue(std::locale::classic());
    stream_ << std::hexfloat;
  }
  void line(const std::string& key, double value) {
    stream_ << key << ' ';
    number(value);
  }
  template <class Integer>
  std::enable_if_t<std::is_integral_v<Integer>> line(const std::string& key, Integer value) { stream_ << key << ' ' << value << '\n'; }

  template <class Numbers>
  void numbers(const std::string& key, const Numbers& values) {
    line(key, static_cast<std::size_t>(values.size()));
    for (const double value : values) number(value);
  }
  void block(const std::string& key, const std::string& text) {
    std::string indented;
    std::size_t lines = 0;
    std::istringstream source(text + "\n");  // getline then gives every line, also an empty last one
    for (std::string one; std::getline(source, one); ++lines) indented += "  " + one + "\n";
    line(key, lines);
    stream_ << indented;
  }
  std::string complete() const {
    const std::string text = stream_.str();
    return text + "end " + std::to_string(text.size()) + " " + hexadecimal(fnv1a(text.data(), text.size())) + "\n";
  }

 private:
  void number(double value) {
    if (std::isnan(value)) {  // a solver cache may hold entries never used; the continuation must be bitwise equal
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      stream_ << "nan:" << hexadecimal(bits) << '\n';
    } else {
      stream_ << value << '\n';
    }
  }
  std::ostringstream stream_;
};

// ---- reading ----

std::string readAll(const std::string& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) fail(file, "is a directory, expected a snapshot file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, std::string("cannot be opened (") + std::strerror(errno) + ")");
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad()) fail(file, std::string("cannot be read (") + std::strerror(errno) + ")");
  return text.str();
}

/// Takes the lines of a snapshot apart, in the order in which they were written.
class Lines {
 public:
  Lines(const std::string& file, const std::string& text) : file_(file), source_(text) {}

  std::string next(const std::string& what) {
    std::string line;
    if (!std::getline(source_, line)) fail(file_, "ends before " + what);
    ++number_;
    return line;
  }
  /// The rest of a line that begins with `key` and a blank.
  std::string value(const std::string& key) {
    const std::string line = next(key);
    if (line.compare(0, key.size() + 1, key + " ") != 0) wrong(line, key);
    return line.substr(key.size() + 1);
  }
  template <class Integer>
  Integer integer(const std::string& key) {
    const std::string text = value(key);
    Integer result{};
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), result);
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) wrong(text, key + " as a whole number");
    return result;
  }
  double real(const std::string& key) { return number(value(key), key); }

  std::vector<double> numbers(const std::string& key) {
    const std::size_t size = integer<std::size_t>(key);
    std::vector<double> result;
    while (result.size() < size) result.push_back(number(next(key), key));
    return result;
  }
  std::string block(const std::string& key) {
    const std::size_t lines = integer<std::size_t>(key);
    std::string text;
    for (std::size_t i = 0; i < lines; ++i) {
      const std::string line = next(key);
      if (line.compare(0, 2, "  ") != 0) wrong(line, "a line of the " + key);
      text += (i > 0 ? "\n" : "") + line.substr(2);
    }
    return text;
  }
  void end() {
    std::string line;
    if (std::getline(source_, line)) wrong(line, "the end");
  }

 private:
  double number(const std::string& text, const std::string& key) {
    double result = 0.0;
    if (text.compare(0, 4, "nan:") == 0) {
      std::uint64_t bits = 0;
      const auto parsed = std::from_chars(text.data() + 4, text.data() + text.size(), bits, 16);
      if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) wrong(text, key + " as a number");
      std::memcpy(&result, &bits, sizeof result);
      return result;
    }
    // strtod alone would expect the decimal point of the process's locale.
    static const locale_t c_locale = ::newlocale(LC_ALL_MASK, "C", nullptr);
    char* end = nullptr;
    result = ::strtod_l(text.c_str(), &end, c_locale);
    if (text.empty() || end != text.c_str() + text.size()) wrong(text, key + " as a number");
    return result;
  }
  [[noreturn]] void wrong(const std::string& found, const std::string& expected) {
    fail(file_, "line " + std::to_string(number_) + ": found '" + found.substr(0, 60) + "', expected " + expected);
  }
  std::string file_;
  std::istringstream source_;
  int number_ = 1;  // the line with the version has been read
};

/// Checks first line and last line and returns what is between them.
std::string contents(const std::string& file, const std::string& text) {
  if (text.compare(0, kMagic.size(), kMagic) != 0) fail(file, "is not a snapshot: it does not begin with '" + kMagic + "'");
  const std::size_t first_end = text.find('\n');
  if (first_end == std::string::npos) fail(file, "is truncated within its first line");
  const std::string version_text = text.substr(kMagic.size(), first_end - kMagic.size());
  int version = 0;
  const auto parsed = std::from_chars(version_text.data(), version_text.data() + version_text.size(), version);
  if (parsed.ec != std::errc() || parsed.ptr != version_text.data() + version_text.size() || version < 1) {
    fail(file, "line 1: found version '" + version_text.substr(0, 60) + "', expected a whole number");
  }
  if (version > Snapshot::kVersion) {
    fail(file, "has format version " + version_text + ", written by a newer program; this one reads up to version " + std::to_string(Snapshot::kVersion));
  }
  const std::size_t last = text.rfind("\nend ");
  if (last == std::string::npos || text.back() != '\n') fail(file, "is truncated: " + std::to_string(text.size()) + " bytes without the closing line 'end'");
  const std::size_t size = last + 1;
  const std::string expected = "end " + std::to_string(size) + " " + hexadecimal(fnv1a(text.data(), size)) + "\n";
  const std::string found = text.substr(size);
  if (found != expected) {
    fail(file, "is damaged: its contents need the closing line '" + expected.substr(0, expected.size() - 1) + "', found '" + found.substr(0, std::min<std::size_t>(found.find('\n'), 60)) + "'");
  }
  return text.substr(first_end + 1, size - first_end - 1);
}

Vector toVector(const std::vector<double>& values) { return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size())); }

/// A state from which nothing can be continued is refused when saving and when loading.
void checkFinite(const std::string& file, const Simulation::Checkpoint& checkpoint) {
  const auto check = [&](const std::string& name, const double* values, Index size) {
    for (Index i = 0; i < size; ++i) {
      if (!std::isfinite(values[i])) fail(file, name + (size > 1 ? " entry " + std::to_string(i) : "") + " is " + std::to_string(values[i]) + ", expected a finite number");
    }
  };
  check("state x", checkpoint.x.data(), checkpoint.x.size());
  check("command w", checkpoint.w.data(), checkpoint.w.size());
  check("start time t0", &checkpoint.t0, 1);
  check("step h", &checkpoint.h, 1);
}

}  // namespace

void saveSnapshot(const std::string& file, const Snapshot& snapshot) {
  const Simulation::Checkpoint& checkpoint = snapshot.checkpoint;
  checkFinite(file, checkpoint);
  Text text;
  text.line(kMagic.substr(0, kMagic.size() - 1), Snapshot::kVersion);
  text.line("step", checkpoint.step);
  text.line("step0", checkpoint.step0);
  text.line("epoch", checkpoint.epoch);
  text.line("t0", checkpoint.t0);
  text.line("h", checkpoint.h);
  text.numbers("x", checkpoint.x);
  text.numbers("w", checkpoint.w);
  text.numbers("solver_cache", checkpoint.solver_cache);
  text.block("configuration", snapshot.configuration);

  replaceFile(file, text.complete());
}

Snapshot loadSnapshot(const std::string& file) {
  Lines lines(file, contents(file, readAll(file)));
  Snapshot snapshot;
  Simulation::Checkpoint& checkpoint = snapshot.checkpoint;
  checkpoint.step = lines.integer<std::uint64_t>("step");
  checkpoint.step0 = lines.integer<std::int64_t>("step0");
  checkpoint.epoch = lines.integer<std::uint32_t>("epoch");
  checkpoint.t0 = lines.real("t0");
  checkpoint.h = lines.real("h");
  checkpoint.x = toVector(lines.numbers("x"));
  checkpoint.w = toVector(lines.numbers("w"));
  checkpoint.solver_cache = lines.numbers("solver_cache");
  snapshot.configuration = lines.block("configuration");
  lines.end();
  checkFinite(file, checkpoint);
  return snapshot;
}

}  // namespace heerk_rotor
